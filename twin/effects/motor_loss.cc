#include "thermal/motor_loss.h"

#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

/// c = {P₀, P_h, P_e, base speed ratio, rated speed}, u = {ω, flag}.
struct NoLoadLoss {
  static constexpr std::string_view name = "no-load loss of a motor";
  static constexpr int ports = 1, coefficients = 5, inputs = 2;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const*, S const* c, double const* u, S* q) {
    if (u[1] <= 0.0) return;
    S const base = c[3], ratio = u[0] / (c[4] * base);  // in units of the base speed
    q[0] = u[1] * (c[0] + thermal::iron_loss_with_field_weakening<S>(c[1] * base, c[2] * base * base, ratio, 1.0));
  }
};

struct MotorLoss {
  std::string name, at;
  double constant = 0.0, hysteresis = 0.0, eddy = 0.0;
  std::optional<double> rated_speed;
  double base_speed_ratio = 1e3;
  std::string while_on = "spindle.running";

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &MotorLoss::name, "unique among these");
    f.name("at", &MotorLoss::at, "place that receives it: stator, rotor");
    f("constant", &MotorLoss::constant, dimension::power, "P0, magnetising and copper loss without load",
      Range{0, 300});
    f("hysteresis", &MotorLoss::hysteresis, dimension::power, "Ph at rated speed, proportional to it", Range{0, 600});
    f("eddy", &MotorLoss::eddy, dimension::power, "Pe at rated speed, with its square", Range{0, 600});
    f("rated_speed", &MotorLoss::rated_speed, dimension::angular_speed, "default: the spindle's maximum",
      plausible_speed);
    f("base_speed_ratio", &MotorLoss::base_speed_ratio, dimension::dimensionless,
      "above this share of the rated speed the field is weakened: eddy loss constant, hysteresis falling", above_zero);
    f("while_on", &MotorLoss::while_on, "input channel that enables the motor");
  }

  void add_to(Assembly& assembly) const {
    assembly.network().add<NoLoadLoss>(
        assembly.part(), {assembly.port(at)},
        {constant, hysteresis, eddy, base_speed_ratio, assembly.rated_speed(rated_speed, while_on)},
        {assembly.channel("spindle.speed"), assembly.share(while_on)});
  }
};

}  // namespace

Effect const& motor_loss_effect() {
  static Effect const effect = make_effect<MotorLoss>(
      {"motor_loss",
       "no-load loss of the spindle motor: magnetising, hysteresis and eddy currents",
       "P = P0 + Ph r + Pe r²,  r = ω/ω_rated; above the base speed Ph r_b²/r and Pe r_b²",
       "source",
       "stator or rotor",
       "power of speed 0 to 2 below the base speed; first seen at the motor, 20…40 min; ends when the motor is "
       "disabled",
       "physics.md 1.7, §7 nos. 6, 7",
       {6, 7},
       {"copper_loss", "belt", "rotor_windage", "radiation"},
       "no load against load; coast-down; the spindle turned by another motor"},
      {{.amplitude = "eddy",
        .largest = 300.0,
        .needs_spindle = true,
        .sites = {{"at", "motor"}},
        .shapes = {{}, {{"base_speed_ratio", "0.3"}}}},
       {.amplitude = "hysteresis",
        .largest = 300.0,
        .needs_spindle = true,
        .sites = {{"at", "motor"}},
        .shapes = {{}, {{"base_speed_ratio", "0.3"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
