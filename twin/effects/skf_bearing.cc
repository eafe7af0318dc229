#include <string>

#include "thermal/bearing_friction.h"
#include "thermal/lubricant.h"
#include "thermal/skf_friction.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/part_time_motion.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

/// Ports: shaft, outer ring; the lubricant has their mean temperature. u as of part_time_motion.h.
/// c = {count, A, B, F_r, F_a, d, D, K_rs, μ_bl, μ_EHL, centrifugal factor, inner share}.
struct SkfHeat {
  static constexpr std::string_view name = "bearing friction after SKF";
  static constexpr int ports = 2, coefficients = 12, inputs = 2;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    if (u[0] == 0.0) return;
    thermal::SkfBearingOf<S> bearing;
    bearing.bore = c[5];
    bearing.outer_diameter = c[6];
    bearing.replenishment = c[7];
    bearing.boundary_friction = c[8];
    bearing.elastohydrodynamic_friction = c[9];
    bearing.r3 *= c[10];
    bearing.s3 *= c[10];
    S const viscosity = thermal::vogel_cameron_viscosity<S>(c[1], c[2], 0.5 * (T[0] + T[1]));
    S const torque = thermal::skf_torque<S>(bearing, c[3], c[4], viscosity, S(moving_speed(u)));
    S const heat = c[0] * thermal::friction_heat<S>(torque, S(u[0]));
    q[0] = c[11] * heat;
    q[1] = (1.0 - c[11]) * heat;
  }
};

struct SkfBearingPart {
  std::string name, shaft, ring, speed = "z.speed";
  double count = 1.0;
  int oil = 32;
  double bore = required, outer_diameter = required;
  double axial_load = required, radial_load = 0.0;
  double replenishment = 6e-8;
  double boundary_friction = 0.15, film_friction = 0.05;
  double centrifugal_factor = 1.0;
  double inner_share = 0.5;
  double conductance = 0.0;

  template <class Fields>
  static void fields(Fields& f) {
    using P = SkfBearingPart;
    f.name("name", &P::name, "unique among these");
    f.name("shaft", &P::shaft, "place on the screw or shaft");
    f.name("ring", &P::ring, "place of the outer rings");
    f("speed", &P::speed, "input channel with the speed");
    f("count", &P::count, dimension::dimensionless, "bearings in the set", Range{1, 6}.above_zero());
    f("oil", &P::oil, "ISO viscosity grade of the base oil", Range{10, 100});
    f("bore", &P::bore, dimension::length, "d of each", Range{0.005, 0.5}.above_zero());
    f("outer_diameter", &P::outer_diameter, dimension::length, "D of each", Range{0.01, 1.0}.above_zero());
    f("axial_load", &P::axial_load, dimension::force, "of each, preload included", Range{0.0, 2e4});
    f("radial_load", &P::radial_load, dimension::force, "of each", Range{0.0, 2e4});
    f("replenishment", &P::replenishment, dimension::dimensionless,
      "K_rs: grease and oil-air 6e-8, low oil bath and jet 3e-8", Range{3e-8, 6e-8});
    f("boundary_friction", &P::boundary_friction, dimension::dimensionless, "catalogue of 2013: 0.15, later 0.12",
      Range{0.1, 0.15});
    f("film_friction", &P::film_friction, dimension::dimensionless, "mineral oil 0.05, synthetic 0.04",
      Range{0.02, 0.1});
    f("centrifugal_factor", &P::centrifugal_factor, dimension::dimensionless,
      "of the published centrifugal terms, which overpredict super-precision bearings", Range{0.0, 1.0});
    f("inner_share", &P::inner_share, dimension::dimensionless, "of the heat, into the shaft", share_range);
    f("conductance", &P::conductance, dimension::conductance, "shaft to outer rings", Range{0.0, 20.0});
  }

  void check(Value const& table) const {
    if (outer_diameter <= bore)
      throw FileError(where_of(table, "outer_diameter"),
                      fmt::format("'outer_diameter' is {}; it must be more than the bore, {}",
                                  thermal::format_quantity(outer_diameter, dimension::length),
                                  thermal::format_quantity(bore, dimension::length)));
  }

  void add_to(Assembly& assembly) const {
    auto const viscosity = thermal::mineral_oil_viscosity(oil);
    auto const inner = assembly.port(shaft), outer = assembly.port(ring);
    assembly.network().add<SkfHeat>(
        assembly.part(), {inner, outer},
        {count, viscosity.scale, viscosity.temperature, radial_load, axial_load, bore, outer_diameter, replenishment,
         boundary_friction, film_friction, centrifugal_factor, inner_share},
        assembly.friction_channels(speed));
    assembly.network().connect(assembly.part(), inner, outer, conductance);
  }
};

}  // namespace

Effect const& skf_bearing_effect() {
  static Effect const effect = make_effect<SkfBearingPart>(
      {"skf_bearing",
       "friction of angular contact ball bearings after SKF: screw supports, or a bound",
       "Q = n (M_rr + M_sl) ω;  M_rr = Φ_ish Φ_rs R1 d_m^1.97 (F_r + R3 d_m⁴ n² + R2 F_a)^0.54 (νn)^0.6;  M_sl = μ S1 "
       "d_m^0.26 [(F_r + S3 d_m⁴ n²)^(4/3) + S2 F_a^(4/3)];  in N mm, mm, 1/min, mm²/s",
       "source, link",
       "end of a screw and its bearing ring; n d_m below 4e5 mm/min",
       "power of speed 1.3 to 1.6, less in the steady state; offset of the position error, equal at all positions; "
       "ends "
       "at stop",
       "physics.md 1.2 (1.5), §7 no. 20; SKF General Catalogue 2003, Rolling bearings 2013",
       {20},
       {"ball_nut"},
       "error of position at the ends of the stroke against its middle; torque without the nut"});
  return effect;
}

}  // namespace thermotwin::twin
