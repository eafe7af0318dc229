#include <cmath>

#include "thermal/laws.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/part_time_motion.h"

namespace thermotwin::twin {
namespace {

/// q = G (ω/ω_r)^m (T_air − T). Ports: surface, air. c = {G, m, ω_r}, u as of part_time_motion.h.
struct FanConductance {
  static constexpr std::string_view name = "cooling by a rotating part's own draught";
  static constexpr int ports = 2, coefficients = 3, inputs = 2;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    if (u[0] == 0.0) return;
    using std::pow;
    S const while_moving = c[0] * pow(S(moving_speed(u) / c[2]), c[1]);
    thermal::exchange<S>(share_of_motion(u) * while_moving * (T[1] - T[0]), q);
  }
};

struct FanCooling {
  std::string name, at;
  double conductance = required;
  double exponent = 0.8;
  std::string speed = "spindle.speed";
  std::optional<double> rated_speed;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &FanCooling::name, "unique among these");
    f.name("at", &FanCooling::at, "place that the draught cools");
    f("conductance", &FanCooling::conductance, dimension::conductance, "to the room air at rated speed",
      Range{0.2, 5.0});
    f("exponent", &FanCooling::exponent, dimension::dimensionless, "of the speed: laminar 0.5, turbulent 0.8",
      Range{0.5, 0.8});
    f("speed", &FanCooling::speed, "input channel with the speed");
    f("rated_speed", &FanCooling::rated_speed, dimension::angular_speed, "default: the spindle's maximum",
      plausible_speed);
  }

  void add_to(Assembly& assembly) const {
    Place const place = assembly.place(at);
    for (auto const& contact : place.site.contacts)
      assembly.network().add<FanConductance>(
          assembly.part(), {assembly.node(place, contact.node), assembly.air(contact.centre)},
          {conductance * contact.share, exponent, assembly.rated_speed(rated_speed, speed)},
          assembly.friction_channels(speed));
  }
};

}  // namespace

Effect const& fan_cooling_effect() {
  static Effect const effect = make_effect<FanCooling>(
      {"fan_cooling",
       "a flange, pulley or chuck cools its surroundings like a fan while it turns",
       "q = (hA)_r (ω/ω_r)^m (T_air − T),  m = 0.5…0.8",
       "film",
       "nose, flange, front of the cartridge, pulley",
       "sink with speed^0.5…0.8 times T − T_air: nothing at a cold start, lowers the steady temperature at high speed; "
       "nothing at stop, so that temperatures fall more slowly than while running",
       "physics.md 2.5 (2.7), §7 no. 2",
       {2},
       {"bearing", "preload", "rotor_windage", "purge_air"},
       "cooling at standstill against cooling at idle speed; a shroud; the same run in a warmer room"},
      {{.amplitude = "conductance",
        .largest = 5.0,
        .sites = {{"at", "shaft"}},
        .shapes = {{{"exponent", "0.8"}}, {{"exponent", "0.5"}}}},
       {.amplitude = "conductance",
        .largest = 5.0,
        .sites = {{"at", "ring"}},
        .shapes = {{{"exponent", "0.8"}}, {{"exponent", "0.5"}}}},
       {.amplitude = "conductance",
        .largest = 5.0,
        .sites = {{"at", "room surface"}},
        .shapes = {{{"exponent", "0.8"}}, {{"exponent", "0.5"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
