#include <string>

#include "thermal/ball_conductance.h"
#include "thermal/bearing_friction.h"
#include "thermal/error.h"
#include "thermal/feed_drive.h"
#include "thermal/laws.h"
#include "thermal/lubricant.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/feed_torque.h"
#include "twin/effects/part_time_motion.h"

namespace thermotwin::twin {
namespace {

/// Port 0 nut, port 1 screw under the stroke. c = torque coefficients (feed_torque.h), nut share; u as
/// of part_time_motion.h.
struct NutHeat {
  static constexpr std::string_view name = "friction of a ball nut";
  static constexpr int ports = 2, coefficients = NutTorque::coefficients + 1, inputs = 2;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    if (u[0] == 0.0) return;
    S const heat = thermal::friction_heat<S>(NutTorque::at<S>(T[0], T[1], c, moving_speed(u)), S(u[0]));
    q[0] = c[NutTorque::coefficients] * heat;
    q[1] = (1.0 - c[NutTorque::coefficients]) * heat;
  }
};

/// q = w G (T₁ − T₀), G = G₀ + G₁ √(ω/ω_ref): port 0 nut, port 1 a cell of the screw, over which the nut stands for the
/// share w of the time. While the nut rests G is G₀. c = {G₀, G₁, ω_ref}, u = {those of part_time_motion.h, w}.
struct NutConductance {
  static constexpr std::string_view name = "conduction through the balls of a nut";
  static constexpr int ports = 2, coefficients = 3, inputs = 3;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    S const conductance = thermal::rolling_conductance<S>(c[0], share_of_motion(u) * c[1], c[2], moving_speed(u));
    thermal::exchange<S>(u[2] * conductance * (T[1] - T[0]), q);
  }
};

struct BallNut {
  std::string name, nut, screw, axis = "z";
  double nut_length = required, nominal_diameter = required, lead = required;
  double preload = required, axial_load = 0.0, efficiency = 0.92;
  double viscous_share = 0.6;
  int oil = 68;
  double reference_speed = 125.66370614359172;  // 1200 rpm
  double nut_share = 0.5;
  double conductance_rest = 1.0, conductance_speed = 1.2;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &BallNut::name, "unique among the nuts");
    f.name("nut", &BallNut::nut, "body of the nut");
    f.name("screw", &BallNut::screw, "bar along which it runs");
    f("axis", &BallNut::axis, "whose feed moves it");
    f("nut_length", &BallNut::nut_length, dimension::length, "over which the balls run", plausible_length.above_zero());
    f("nominal_diameter", &BallNut::nominal_diameter, dimension::length, "of the screw",
      plausible_diameter.above_zero());
    f("lead", &BallNut::lead, dimension::length, "travel per revolution", plausible_lead.above_zero());
    f("preload", &BallNut::preload, dimension::force, "of the nut", Range{0.0, 2e4});
    f("axial_load", &BallNut::axial_load, dimension::force, "mean of its magnitude", Range{0.0, 5e4});
    f("efficiency", &BallNut::efficiency, dimension::dimensionless, "of the screw under load",
      Range{0.88, 0.95}.above_zero().up_to(1.0));
    f("viscous_share", &BallNut::viscous_share, dimension::dimensionless, "of the preload torque",
      Range{0.4, 0.8}.up_to(1.0));
    f("oil", &BallNut::oil, "ISO viscosity grade of the base oil", Range{10, 100});
    f("reference_speed", &BallNut::reference_speed, dimension::angular_speed, "for which the torque is stated",
      plausible_speed.above_zero());
    f("nut_share", &BallNut::nut_share, dimension::dimensionless, "of the heat, into the nut", share_range);
    f("conductance_rest", &BallNut::conductance_rest, dimension::conductance, "nut to screw at standstill",
      Range{0.5, 3.0});
    f("conductance_speed", &BallNut::conductance_speed, dimension::conductance,
      "added at the reference speed, with the root of the speed", Range{0.0, 5.0});
  }

  void add_to(Assembly& assembly) const {
    auto const& track = assembly.body(screw);
    if (track.shape != thermal::Body::Shape::axial || track.count(1) > 1)
      throw thermal::InputError("the nut's screw '" + screw + "' is not a bar");
    thermal::Average under;
    under.name = name + " on " + screw;
    for (int i = 0; i < track.nodes(); ++i) under.nodes.push_back(assembly.first_node(screw) + i);
    under.from_channel = assembly.channel(axis + ".stroke_from");
    under.to_channel = assembly.channel(axis + ".stroke_to");
    under.window = nut_length;
    under.edges = track.edges[0];
    auto const nut_port = assembly.port(nut), screw_port = assembly.network().add_average(std::move(under));
    auto const speeds = assembly.friction_channels(axis + ".speed");

    auto torque = NutTorque::coefficients_of(preload, lead, nominal_diameter, axial_load, efficiency, viscous_share,
                                             thermal::mineral_oil_viscosity(oil), reference_speed);
    assembly.announce(name, {{nut_port, screw_port}, torque});
    torque.push_back(nut_share);
    assembly.network().add<NutHeat>(assembly.part(), {nut_port, screw_port}, torque, speeds);
    for (int i = 0; i < track.nodes(); ++i)
      assembly.network().add<NutConductance>(assembly.part(),
                                             {nut_port, {thermal::Port::Kind::node, assembly.first_node(screw) + i}},
                                             {conductance_rest, conductance_speed, reference_speed},
                                             {speeds[0], speeds[1], assembly.network().weight_channel(screw_port, i)});
  }
};

}  // namespace

Effect const& ball_nut_effect() {
  static Effect const effect = make_effect<BallNut>(
      {"ball_nut",
       "friction of a ball nut that travels along its screw, and conduction between them",
       "Q = T_nut |ω|, n that while moving;  T_nut = T_pre (1 − φ + φ √(νn/(ν40 n_r))) + |F_ax| l/2π (1/η − 1);  T_pre "
       "= 0.05 (tan "
       "β)^(−1/2) F_a0 "
       "l/2π;  G = G0 + d G1 √(n/n_r), d the share of the time in motion;  spread over the screw by the exact overlap "
       "with the nut along its stroke",
       "source, link",
       "nut and screw",
       "power of feed 1 to 1.5; first seen at screw and nut, 10…14 min; slope of the "
       "position error; ends at stop",
       "physics.md 1.8, 2.4, (2.10); catalogues of NSK, THK, HIWIN",
       {17},
       {"guide", "nut_preload", "nut_reversal"},
       "sensors on nut and rail; the same mean feed with another stroke; torque of the axis"});
  return effect;
}

}  // namespace thermotwin::twin
