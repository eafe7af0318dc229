#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "thermal/error.h"
#include "thermal/units.h"
#include "twin/file/schema.h"

/// What a machine file says, as plain structs: bodies, displacement channels, sensors. The parts that carry or make
/// heat (joints, films, sources) are entries of the effect catalogue and stand in twin/effects.
namespace thermotwin::twin {

namespace dimension = thermal::dimension;
inline constexpr double required = std::numeric_limits<double>::quiet_NaN();
inline constexpr Range positive{0.0, std::numeric_limits<double>::infinity()};
inline constexpr Range above_zero = positive.above_zero();
inline constexpr Range share_range = Range{0.0, 1.0}.up_to(1.0);  ///< of what is shared out, and cannot be more

constexpr double rpm(double number) { return number * (2.0 * std::numbers::pi) / 60.0; }  ///< [rad/s]

/// Ranges so wide that what lies outside is a slip of the unit: from foam and plastics to silver and ceramics, from a
/// watch's spindle to a heavy lathe.
inline constexpr Range plausible_conductivity{0.01, 3000.0}, plausible_density{10.0, 25000.0},
    plausible_specific_heat{50.0, 15000.0}, plausible_expansion{-1e-5, 3e-4}, plausible_modulus{5e8, 1.5e12},
    plausible_spindle{rpm(50.0), rpm(300000.0)}, plausible_speed{0.0, rpm(300000.0)},
    plausible_rapid_feed{0.5 / 60.0, 5.0}, plausible_lead{0.5e-3, 0.5}, plausible_length{0.0, 100.0},
    plausible_diameter{0.0, 10.0}, plausible_area{0.0, 1000.0}, plausible_mass{0.0, 1e5},
    plausible_heat_capacity{0.0, 1e8}, plausible_stiffness{0.0, 1e11};

/// `[spindle]`
struct SpindleDescription {
  double maximum_speed = required;  ///< [rad/s]

  template <class Fields>
  static void fields(Fields& f) {
    f("maximum_speed", &SpindleDescription::maximum_speed, dimension::angular_speed, "100 % of a spectrum",
      plausible_spindle);
  }
};

/// `[[axis]]`: a linear axis driven by a screw.
struct AxisDescription {
  std::string name;
  double rapid_feed = required;  ///< [m/s]
  double lead = required;        ///< travel per revolution of the screw [m]
  double stroke_from = 0.0;      ///< ends of the nut's stroke, from the start of the screw [m]
  double stroke_to = required;
  std::string friction_at = "moving speed";

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &AxisDescription::name, "x, y, z or another");
    f("rapid_feed", &AxisDescription::rapid_feed, dimension::speed, "100 % of a feed programme", plausible_rapid_feed);
    f("lead", &AxisDescription::lead, dimension::length, "travel per revolution of the screw",
      plausible_lead.above_zero());
    f("stroke_from", &AxisDescription::stroke_from, dimension::length, "first end of the nut's stroke on the screw",
      plausible_length);
    f("stroke_to", &AxisDescription::stroke_to, dimension::length, "other end of the nut's stroke", plausible_length);
    f.choice("friction_at", &AxisDescription::friction_at, {"moving speed", "mean speed"},
             "speed at which nut, bearings and motor have their torques: that while the axis moves, or, as in the "
             "reference machines of physics.md, the mean over its dwells");
  }
};

/// `[[material]]`: a solid of this machine; whatever is not given comes from the known material `like`.
struct MaterialDescription {
  std::string name, like;
  std::optional<double> conductivity, density, specific_heat, expansion, youngs_modulus, poisson_ratio;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &MaterialDescription::name, "how bodies refer to it");
    f.name("like", &MaterialDescription::like, "known material that gives what is not stated here");
    f("conductivity", &MaterialDescription::conductivity, dimension::conductivity, "at 20 degC",
      plausible_conductivity);
    f("density", &MaterialDescription::density, dimension::density, "density", plausible_density);
    f("specific_heat", &MaterialDescription::specific_heat, dimension::specific_heat, "at 20 degC",
      plausible_specific_heat);
    f("expansion", &MaterialDescription::expansion, dimension::expansion, "coefficient of linear expansion",
      plausible_expansion);
    f("youngs_modulus", &MaterialDescription::youngs_modulus, dimension::stress, "Young's modulus", plausible_modulus);
    f("poisson_ratio", &MaterialDescription::poisson_ratio, dimension::dimensionless, "Poisson's ratio",
      Range{-1.0, 0.5});
  }
};

/// What solids share: how they hang on one another, for the displacements that fields show (thermal/growth_field.h),
/// and whether a sensor could sit on them.
struct CarriedDescription {
  std::string carried_by;
  bool turns = false;
  std::optional<Eigen::Vector3d> held_at;

  template <class Owner, class Fields>
  static void fields_of(Fields& f) {
    f("carried_by", &Owner::carried_by, "body that carries it, in fields that show displacements; none: the floor");
    f("held_at", &Owner::held_at, dimension::length, "where; default: the middle of what both share");
    f("turns", &Owner::turns,
      "no place for a sensor; shafts in bearings, screws, rotating surfaces and what they carry are known to turn");
  }
};

/// `[[lump]]`: a body of one temperature.
struct LumpDescription : CarriedDescription {
  std::string name, material;
  std::optional<double> mass;           ///< [kg]
  std::optional<double> heat_capacity;  ///< [J/K], instead of mass and material
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();
  Eigen::Vector3d size = Eigen::Vector3d::Constant(0.1);

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &LumpDescription::name, "unique among the bodies");
    f("material", &LumpDescription::material, "known material, or one of this file");
    f("mass", &LumpDescription::mass, dimension::mass, "with the material's specific heat", plausible_mass);
    f("heat_capacity", &LumpDescription::heat_capacity, dimension::heat_capacity, "instead of mass",
      plausible_heat_capacity);
    f("corner", &LumpDescription::corner, dimension::length, "lowest corner of the box that it fills");
    f("size", &LumpDescription::size, dimension::length, "edges of that box");
    CarriedDescription::fields_of<LumpDescription>(f);
  }
};

/// What bars, cylinders and channels share: a line in space.
struct LineDescription {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::string direction = "z";
  double length = required;

  Eigen::Vector3d axis() const {
    double const sign = direction[0] == '-' ? -1.0 : 1.0;
    return sign * Eigen::Vector3d::Unit(direction.back() - 'x');
  }
  template <class Owner, class Fields>
  static void fields_of(Fields& f) {
    f("origin", &Owner::origin, dimension::length, "centre of the start face");
    f.choice("direction", &Owner::direction, {"x", "y", "z", "-x", "-y", "-z"}, "from start to end");
    f("length", &Owner::length, dimension::length, "from start to end", plausible_length);
  }
};

inline constexpr char const* capacity_factor_means =
    "of what the drawing gives, for what it does not show: bores, nuts, a clamped tool";
inline constexpr Range plausible_capacity_factor = Range{0.3, 3.0}.above_zero();

/// `[[bar]]`: heat flows along it only: a shaft, a screw, a test bar.
struct BarDescription : LineDescription, CarriedDescription {
  std::string name, material;
  double outer_diameter = required, inner_diameter = 0.0;
  std::optional<double> section_diameter;
  double capacity_factor = 1.0;
  int cells = 10;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &BarDescription::name, "unique among the bodies");
    f.name("material", &BarDescription::material, "known material, or one of this file");
    LineDescription::fields_of<BarDescription>(f);
    f("outer_diameter", &BarDescription::outer_diameter, dimension::length, "of the surface", plausible_diameter);
    f("inner_diameter", &BarDescription::inner_diameter, dimension::length, "of a bore", plausible_diameter);
    f("section_diameter", &BarDescription::section_diameter, dimension::length,
      "solid section of equal area, for threads; default: from outer and inner diameter",
      plausible_diameter.above_zero());
    f("capacity_factor", &BarDescription::capacity_factor, dimension::dimensionless, capacity_factor_means,
      plausible_capacity_factor);
    f("cells", &BarDescription::cells, "along the bar", Range{1, 1e6});
    CarriedDescription::fields_of<BarDescription>(f);
  }
};

/// `[[hollow_cylinder]]`: axial × radial cells.
struct HollowCylinderDescription : LineDescription, CarriedDescription {
  std::string name, material;
  double outer_diameter = required, inner_diameter = 0.0;
  double capacity_factor = 1.0;
  int axial_cells = 20, radial_cells = 4;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &HollowCylinderDescription::name, "unique among the bodies");
    f.name("material", &HollowCylinderDescription::material, "known material, or one of this file");
    LineDescription::fields_of<HollowCylinderDescription>(f);
    f("outer_diameter", &HollowCylinderDescription::outer_diameter, dimension::length, "outer diameter",
      plausible_diameter);
    f("inner_diameter", &HollowCylinderDescription::inner_diameter, dimension::length, "inner diameter; 0: solid",
      plausible_diameter);
    f("capacity_factor", &HollowCylinderDescription::capacity_factor, dimension::dimensionless, capacity_factor_means,
      plausible_capacity_factor);
    f("axial_cells", &HollowCylinderDescription::axial_cells, "along the axis", Range{1, 1e5});
    f("radial_cells", &HollowCylinderDescription::radial_cells, "from inside to outside", Range{1, 1e4});
    CarriedDescription::fields_of<HollowCylinderDescription>(f);
  }
};

/// `[[block]]`: a box along the machine's axes, cells in three directions.
struct BlockDescription : CarriedDescription {
  std::string name, material;
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();
  Eigen::Vector3d size = Eigen::Vector3d::Constant(required);
  std::vector<double> cells = {10, 10, 10};

  /// InputError where they are not three whole numbers.
  [[nodiscard]] std::array<int, 3> cell_counts() const {
    if (cells.size() != 3)
      throw thermal::InputError(fmt::format("'{}': cells has {} entries; three are due", name, cells.size()));
    for (double const n : cells)
      if (!(n >= 1.0 && n <= 1e4 && n == std::floor(n)))
        throw thermal::InputError(
            fmt::format("'{}': {:g} cells; whole numbers from 1 to 10000 are due, for example [10, 10, 10]", name, n));
    return {int(cells[0]), int(cells[1]), int(cells[2])};
  }
  double solidity = 1.0;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &BlockDescription::name, "unique among the bodies");
    f.name("material", &BlockDescription::material, "known material, or one of this file");
    f("corner", &BlockDescription::corner, dimension::length, "lowest corner");
    f("size", &BlockDescription::size, dimension::length, "edges");
    f("cells", &BlockDescription::cells, dimension::dimensionless, "along x, y and z", positive);
    f("solidity", &BlockDescription::solidity, dimension::dimensionless,
      "share of metal in a ribbed casting; scales conductivity and density", Range{0.0, 1.0});
    CarriedDescription::fields_of<BlockDescription>(f);
  }
};

/// `[[channel]]`: a fluid that moves along a line.
struct ChannelDescription : LineDescription {
  std::string name;
  std::string fluid = "water";
  double diameter = required;
  int cells = 50;
  std::string flow;
  std::string inlet;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &ChannelDescription::name, "unique among the bodies");
    f("fluid", &ChannelDescription::fluid, "known fluid");
    LineDescription::fields_of<ChannelDescription>(f);
    f("diameter", &ChannelDescription::diameter, dimension::length, "hydraulic diameter of a round channel",
      plausible_diameter);
    f("cells", &ChannelDescription::cells, "along the flow", Range{1, 1e6});
    f("flow", &ChannelDescription::flow, "input channel with the mass flow [kg/s]; none: part of a circuit");
    f("inlet", &ChannelDescription::inlet, "input channel with the temperature at the inlet; none: part of a circuit");
  }
};

/// One step along the structural loop, from the table to the tool: what its warming does to a displacement channel.
///
///   ΔE = weight · ∫ α θ ds over the place `of` (a stretch of a bar, a cylinder or a block, along its axis);
///   for a lump, weight · α · length · θ;
///   with `rotation`, lever · Δ(rotation channel);
///   with `against`, weight · ½ α (θ_of − θ_against) length²/height: bending of a bed or column;
///   in a rotation the angle of its end, weight · α (θ_of − θ_against) length/height.
struct LoopSegment {
  std::string of, against, rotation;
  double weight = 1.0;
  double growth_factor = 1.0;
  std::optional<double> length, height, lever, expansion;

  template <class Fields>
  static void fields(Fields& f) {
    f("of", &LoopSegment::of, "place whose growth counts");
    f("against", &LoopSegment::against, "place on the cold side, for bending; in a rotation, the angle of the end");
    f("rotation", &LoopSegment::rotation, "rotation channel that moves the tool by its lever");
    f("weight", &LoopSegment::weight, dimension::dimensionless, "sign along the loop, or share");
    f("growth_factor", &LoopSegment::growth_factor, dimension::dimensionless,
      "of what it does, against the computed; the loop's closure does not count it", Range{0.3, 3.0});
    f("length", &LoopSegment::length, dimension::length, "of a lump, or over which it bends", plausible_length);
    f("height", &LoopSegment::height, dimension::length, "between the warm and the cold side", above_zero);
    f("lever", &LoopSegment::lever, dimension::length, "of the rotation");
    f("expansion", &LoopSegment::expansion, dimension::expansion, "default: the material's", plausible_expansion);
  }
};

/// A block whose growth acts through influence weights from an elastic solution (physics.md 3.6).
struct InfluenceDescription {
  std::string body, fixed, loaded;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double weight = 1.0;
  std::string solution = "solid";

  template <class Fields>
  static void fields(Fields& f) {
    f.name("body", &InfluenceDescription::body, "block");
    f.name("fixed", &InfluenceDescription::fixed, "face by which the loop enters it, from the table");
    f.name("loaded", &InfluenceDescription::loaded, "face by which the loop leaves it, to the tool");
    f("point", &InfluenceDescription::point, dimension::length,
      "that moves with the loaded face: tool tip or table point");
    f("weight", &InfluenceDescription::weight, dimension::dimensionless, "sign along the loop");
    f.choice("solution", &InfluenceDescription::solution, {"solid", "beam"},
             "solid: by CalculiX, see `thermotwin weights`; beam: sections between two opposite faces");
  }
};

/// `[[displacement]]` and `[[rotation]]`: a channel of the tool relative to the workpiece (signs: physics.md §0).
struct DisplacementDescription {
  std::string name, title;
  std::string direction = "z";
  std::vector<LoopSegment> segment, beyond;
  std::vector<InfluenceDescription> influence;
  std::optional<double> base;     ///< rotations: distance by which the difference of growth is divided
  std::optional<double> closure;  ///< sum of weight · length around the loop: the offset from table to tool [m]

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &DisplacementDescription::name, "E_X, E_Y, E_Z, or A, B, C for rotations");
    f("title", &DisplacementDescription::title, "one line for people");
    f.choice("direction", &DisplacementDescription::direction, {"x", "y", "z", "-x", "-y", "-z"},
             "in which influence weights are taken");
    f("segment", &DisplacementDescription::segment, "steps along the structural loop");
    f("beyond", &DisplacementDescription::beyond,
      "what the castings do besides, as so much more of them in the loop; neither closure nor levers count it");
    f("influence", &DisplacementDescription::influence, "blocks with influence weights");
    f("base", &DisplacementDescription::base, dimension::length,
      "of a rotation: distance between the two ends that grow; bending has its height", above_zero);
    f("closure", &DisplacementDescription::closure, dimension::length,
      "signed length around the loop; checked, so that a wrong sign is found");
  }
};

/// `[[ball_screw]]`: error of position of a semi-closed loop along a stroke (physics.md 3.8).
struct BallScrewDescription {
  std::string name = "E_P";
  std::string axis = "z", body;
  std::string support = "fixed-supported";
  std::string seats, reference;
  double preload_temperature = 3.0;
  double stiffness_fixed = 0.9e9, stiffness_far = 0.9e9;
  double youngs_modulus = 2.06e11;
  bool unilateral = true;
  double released_stiffness = 0.0;
  double growth_factor = 1.0;
  std::vector<double> positions;

  template <class Fields>
  static void fields(Fields& f) {
    f("name", &BallScrewDescription::name, "prefix of the channels, one per position");
    f("axis", &BallScrewDescription::axis, "the axis that it drives");
    f.name("body", &BallScrewDescription::body, "bar; its start is the fixed bearing");
    f.choice("support", &BallScrewDescription::support, {"fixed-free", "fixed-supported", "fixed-fixed"}, "its ends");
    f("seats", &BallScrewDescription::seats,
      "place of the structure that carries both bearings; its growth over the screw's length parts them");
    f("reference", &BallScrewDescription::reference,
      "place of what the position is measured against, from the fixed bearing on: bed, scale; default: rigid");
    f("preload_temperature", &BallScrewDescription::preload_temperature, dimension::temperature_difference,
      "fixed-fixed: warming that the pretension takes up", Range{0.0, 20.0});
    f("stiffness_fixed", &BallScrewDescription::stiffness_fixed, dimension::stiffness, "of the fixed bearing and seat",
      plausible_stiffness);
    f("stiffness_far", &BallScrewDescription::stiffness_far, dimension::stiffness, "of the far bearing and seat",
      plausible_stiffness);
    f("youngs_modulus", &BallScrewDescription::youngs_modulus, dimension::stress, "of the screw", plausible_modulus);
    f("unilateral", &BallScrewDescription::unilateral, "the far bearing can only pull; false: holds both ways");
    f("released_stiffness", &BallScrewDescription::released_stiffness, dimension::dimensionless,
      "stiffness left when the pretension is gone, as a share", Range{0.0, 1.0});
    f("growth_factor", &BallScrewDescription::growth_factor, dimension::dimensionless,
      "of the screw's own growth: what it was seen to grow, of what its material does", Range{0.3, 3.0});
    f("positions", &BallScrewDescription::positions, dimension::length, "of the nut, from the start of the screw");
  }
};

}  // namespace thermotwin::twin
