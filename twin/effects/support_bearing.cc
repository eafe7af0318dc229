#include <string>
#include <vector>

#include "thermal/bearing_friction.h"
#include "thermal/lubricant.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/feed_torque.h"
#include "twin/effects/part_time_motion.h"

namespace thermotwin::twin {
namespace {

/// Port 0 shaft, port 1 outer ring. c = torque coefficients, inner share; u as of part_time_motion.h.
struct SupportHeat {
  static constexpr std::string_view name = "friction of screw support bearings";
  static constexpr int ports = 2, coefficients = SupportTorque::coefficients + 1, inputs = 2;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    if (u[0] == 0.0) return;
    S const torque = SupportTorque::at<S>(0.5 * (T[0] + T[1]), c, moving_speed(u));
    S const heat = thermal::friction_heat<S>(torque, S(u[0]));
    q[0] = c[SupportTorque::coefficients] * heat;
    q[1] = (1.0 - c[SupportTorque::coefficients]) * heat;
  }
};

struct SupportBearing {
  std::string name, shaft, ring, axis = "z";
  double drag_torque = required;
  int oil = 32;
  double reference_speed = 125.66370614359172;  // 1200 rpm
  double inner_share = 0.5;
  double conductance = required;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &SupportBearing::name, "unique among these");
    f.name("shaft", &SupportBearing::shaft, "place on the screw");
    f.name("ring", &SupportBearing::ring, "body of the outer rings");
    f("axis", &SupportBearing::axis, "whose screw it carries");
    f("drag_torque", &SupportBearing::drag_torque, dimension::torque, "catalogue, at reference speed and 40 degC",
      Range{0.05, 1.0});
    f("oil", &SupportBearing::oil, "ISO viscosity grade of the base oil", Range{10, 100});
    f("reference_speed", &SupportBearing::reference_speed, dimension::angular_speed, "of the drag torque",
      plausible_speed.above_zero());
    f("inner_share", &SupportBearing::inner_share, dimension::dimensionless, "of the heat, into the shaft",
      share_range);
    f("conductance", &SupportBearing::conductance, dimension::conductance, "shaft to outer rings", Range{0.5, 20.0});
  }

  void add_to(Assembly& assembly) const {
    auto const viscosity = thermal::mineral_oil_viscosity(oil);
    auto const inner = assembly.port(shaft), outer = assembly.port(ring);
    std::vector<double> torque = {drag_torque, viscosity.scale, viscosity.temperature, reference_speed};
    assembly.announce(name, {{inner, outer}, torque});
    torque.push_back(inner_share);
    assembly.network().add<SupportHeat>(assembly.part(), {inner, outer}, torque,
                                        assembly.friction_channels(axis + ".speed"));
    assembly.network().connect(assembly.part(), inner, outer, conductance);
  }
};

}  // namespace

Effect const& support_bearing_effect() {
  static Effect const effect = make_effect<SupportBearing>(
      {"support_bearing",
       "friction of the thrust bearings of a ball screw, and conduction through them",
       "Q = M |ω|;  M = M_b (0.3 + 0.7 (νn/(ν40 n_r))^(2/3));  q = G (T_ring − T_shaft)",
       "source, link",
       "end of a screw and its bearing ring",
       "power of feed 1 to 1.7; offset of the position error, equal at all "
       "positions; ends at stop",
       "physics.md 1.9 (1.15), §7 no. 20; NSK catalogue",
       {20},
       {"ball_nut"},
       "error of position at the ends of the stroke against its middle; torque without the nut"});
  return effect;
}

}  // namespace thermotwin::twin
