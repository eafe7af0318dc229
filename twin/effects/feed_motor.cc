#include "thermal/error.h"
#include "thermal/motor_loss.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/feed_torque.h"
#include "twin/effects/part_time_motion.h"

namespace thermotwin::twin {
namespace {

/// Ports: motor, nut, screw, rings of two support bearings. u as of part_time_motion.h.
/// c = nut torque, two support torques, {resistance, peak factor, k_T, constant torque, P_h, P_e, ω_r}.
struct FeedMotorLoss {
  static constexpr std::string_view name = "loss of a feed motor";
  static constexpr int nut = 0, upper = NutTorque::coefficients, lower = upper + SupportTorque::coefficients,
                       own = lower + SupportTorque::coefficients;
  static constexpr int ports = 5, coefficients = own + 7, inputs = 2;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    if (u[0] == 0.0) return;
    double const speed = moving_speed(u);
    S const torque = NutTorque::at<S>(T[1], T[2], c + nut, speed) + SupportTorque::at<S>(T[3], c + upper, speed) +
                     SupportTorque::at<S>(T[4], c + lower, speed) + c[own + 3];
    S const current = thermal::permanent_magnet_current<S>(torque, c[own + 2]);
    S const ratio = speed / c[own + 6];
    q[0] = share_of_motion(u) * (c[own + 1] * thermal::copper_loss<S>(S(3.0), c[own], T[0], current) +
                                 thermal::iron_loss<S>(c[own + 4], c[own + 5], ratio));
  }
};

struct FeedMotor {
  std::string name, at, axis = "z", nut;
  std::vector<std::string> bearings;
  double resistance = required, torque_constant = required;
  double constant_torque = 0.0, peak_factor = 1.0;
  double hysteresis = 0.0, eddy = 0.0;
  double reference_speed = 125.66370614359172;  // 1200 rpm

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &FeedMotor::name, "unique among these");
    f.name("at", &FeedMotor::at, "body of the motor");
    f("axis", &FeedMotor::axis, "that it drives");
    f.name("nut", &FeedMotor::nut, "ball_nut whose friction it overcomes");
    f("bearings", &FeedMotor::bearings, "support_bearings whose friction it overcomes, at most two");
    f("resistance", &FeedMotor::resistance, dimension::resistance, "of a phase at 20 degC", Range{0.01, 20});
    f("torque_constant", &FeedMotor::torque_constant, dimension::torque_constant, "per effective phase current",
      Range{0.1, 5}.above_zero());
    f("constant_torque", &FeedMotor::constant_torque, dimension::torque,
      "of seals, guides and a weight, as if it were friction: the same both ways, none at rest", Range{-50, 50});
    f("peak_factor", &FeedMotor::peak_factor, dimension::dimensionless,
      "mean square of the torque over its squared mean", Range{1.0, 4.0});
    f("hysteresis", &FeedMotor::hysteresis, dimension::power, "iron loss at reference speed, proportional to it",
      Range{0, 100});
    f("eddy", &FeedMotor::eddy, dimension::power, "iron loss at reference speed, with its square", Range{0, 100});
    f("reference_speed", &FeedMotor::reference_speed, dimension::angular_speed, "of the iron losses",
      plausible_speed.above_zero());
  }

  void add_to(Assembly& assembly) const {
    if (bearings.size() > 2) throw thermal::InputError("feed_motor '" + name + "' drives at most two support bearings");
    if (bearings.size() == 2 && bearings[0] == bearings[1])
      throw thermal::InputError("the support bearing '" + bearings[0] + "' would count twice");
    auto const motor = assembly.port(at);
    auto const& load = assembly.torque_of(nut);
    std::vector<thermal::Port> ports = {motor, load.ports[0], load.ports[1]};
    std::vector<double> numbers = load.coefficients;
    for (std::size_t k = 0; k < 2; ++k) {
      bool const given = k < bearings.size();
      Assembly::Torque const none{{motor, motor}, {0.0, 1e-7, 800.0, reference_speed}};
      auto const& torque = given ? assembly.torque_of(bearings[k]) : none;
      ports.push_back(torque.ports[1]);
      numbers.insert(numbers.end(), torque.coefficients.begin(), torque.coefficients.end());
    }
    numbers.insert(numbers.end(),
                   {resistance, peak_factor, torque_constant, constant_torque, hysteresis, eddy, reference_speed});
    assembly.network().add<FeedMotorLoss>(assembly.part(), ports, numbers, assembly.friction_channels(axis + ".speed"));
  }
};

}  // namespace

Effect const& feed_motor_effect() {
  static Effect const effect = make_effect<FeedMotor>(
      {"feed_motor", "copper and iron loss of a feed motor that overcomes the friction of its axis",
       "P = d [k_p 3R(1 + 0.0039 (T − 20 °C)) (M/k_T)² + Ph r + Pe r²];  M = M_nut + Σ M_bearing + M_0,  r = n/n_r, n "
       "while moving, for the share d of the time",
       "source", "feed motor", "power of feed 1 to 2; first seen at the motor, 36…39 min; ends at stop",
       "physics.md 1.7, 2.11"});
  return effect;
}

}  // namespace thermotwin::twin
