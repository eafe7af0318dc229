#include "thermal/drive_loss.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/feed_torque.h"
#include "twin/effects/part_time_motion.h"

namespace thermotwin::twin {
namespace {

/// P = d P_r (ω/ω_r)^m (ν(T)/ν₄₀)^0.2 + u (1 − η) P_t, ω while moving, for the share d of the time. Port: gear box.
/// c = {P_r, m, ω_r, A, B, (1 − η) P_t}, u = {those of part_time_motion.h, flag}.
struct GearHeat {
  static constexpr std::string_view name = "loss of a gear stage";
  static constexpr int ports = 1, coefficients = 6, inputs = 3;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    q[0] = u[2] * c[5];
    if (u[0] == 0.0) return;
    using std::pow;
    S const viscosity = flow_ratio<S>(c[3], c[4], T[0], 1.0, S(1.0));
    q[0] += share_of_motion(u) * c[0] * pow(S(moving_speed(u) / c[2]), c[1]) * pow(viscosity, 0.2);
  }
};

struct Gear {
  std::string name, at, speed = "spindle.speed", while_loaded = "spindle.running";
  double churning = required, exponent = 2.0;
  std::optional<double> rated_speed;
  int oil = 68;
  double efficiency = 0.985, transmitted_power = 0.0;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Gear::name, "unique among these");
    f.name("at", &Gear::at, "body of gears and oil");
    f("churning", &Gear::churning, dimension::power, "without load, at rated speed and 40 degC", Range{5, 2000});
    f("exponent", &Gear::exponent, dimension::dimensionless, "of the speed", Range{1.7, 2.5});
    f("rated_speed", &Gear::rated_speed, dimension::angular_speed, "default: the spindle's maximum", plausible_speed);
    f("speed", &Gear::speed, "input channel with the speed");
    f("oil", &Gear::oil, "ISO viscosity grade", Range{10, 100});
    f("efficiency", &Gear::efficiency, dimension::dimensionless, "of the stage under load",
      Range{0.98, 0.99}.up_to(1.0));
    f("transmitted_power", &Gear::transmitted_power, dimension::power, "mean, under load", Range{0.0, 1e5});
    f("while_loaded", &Gear::while_loaded, "input channel between 0 and 1 that scales the load");
  }

  void add_to(Assembly& assembly) const {
    auto const viscosity = thermal::mineral_oil_viscosity(oil);
    auto inputs = assembly.friction_channels(speed);
    inputs.push_back(assembly.share(while_loaded));
    assembly.network().add<GearHeat>(
        assembly.part(), {assembly.port(at)},
        {churning, exponent, assembly.rated_speed(rated_speed, speed), viscosity.scale, viscosity.temperature,
         thermal::transmission_loss<double>(efficiency, transmitted_power)},
        inputs);
  }
};

}  // namespace

Effect const& gear_effect() {
  static Effect const effect = make_effect<Gear>(
      {"gear", "churning and load loss of a gear stage",
       "P = d P_r (ω/ω_r)^m (ν(T)/ν40)^0.2 + (1 − η) P_t,  m = 1.7…2.5", "source", "gear box of spindle or axis",
       "power of speed 1.7 to 2.5 without load, little less when warm; ends at stop", "physics.md 1.10"});
  return effect;
}

}  // namespace thermotwin::twin
