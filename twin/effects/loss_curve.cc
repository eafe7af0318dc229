#include <algorithm>
#include <fmt/format.h>

#include "thermal/error.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/part_time_motion.h"

namespace thermotwin::twin {
namespace {

constexpr int most_points = 8;

/// P(ω) linear between points, constant beyond the last; of a screw the mean over motion and rest. c = {factor, ω₁…ω₈,
/// P₁…P₈}, u = {those of part_time_motion.h, flag}.
struct LossCurveHeat {
  static constexpr std::string_view name = "loss over speed";
  static constexpr int ports = 1, coefficients = 1 + 2 * most_points, inputs = 3;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const*, S const* c, double const* u, S* q) {
    q[0] = u[2] * c[0] * mean_over_motion(u, [c](double speed) { return loss_at(c, speed); });
  }

 private:
  template <class S>
  static S loss_at(S const* c, double at) {
    S const *speed = c + 1, *loss = speed + most_points;
    S power = loss[0];
    for (int i = 1; i < most_points; ++i) {
      if (!(S(at) > speed[i - 1])) break;
      S const way = (at - speed[i - 1]) / (speed[i] - speed[i - 1]);
      power = way < S(1.0) ? S(loss[i - 1] + way * (loss[i] - loss[i - 1])) : loss[i];
    }
    return power;
  }
};

struct LossCurve {
  std::string name, at, speed = "spindle.speed", while_on = "spindle.running";
  double factor = 1.0;
  std::vector<double> speeds, losses;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &LossCurve::name, "unique among these");
    f.name("at", &LossCurve::at, "place that receives it: stator, gear box");
    f("factor", &LossCurve::factor, dimension::dimensionless, "of the whole curve", Range{0.2, 2.0});
    f("speeds", &LossCurve::speeds, dimension::angular_speed, "rising, two to eight", plausible_speed);
    f("losses", &LossCurve::losses, dimension::power, "at these speeds", Range{0.0, 1e6});
    f("speed", &LossCurve::speed, "input channel with the speed");
    f("while_on", &LossCurve::while_on, "input channel between 0 and 1 that scales it");
  }

  void add_to(Assembly& assembly) const {
    check();
    std::vector<double> numbers = {factor};
    for (int i = 0; i < most_points; ++i) numbers.push_back(at_point(speeds, i) + extra(i));
    for (int i = 0; i < most_points; ++i) numbers.push_back(at_point(losses, i));
    auto inputs = assembly.friction_channels(speed);
    inputs.push_back(assembly.share(while_on));
    assembly.network().add<LossCurveHeat>(assembly.part(), {assembly.port(at)}, numbers, inputs);
  }

 private:
  void check() const {
    if (speeds.size() < 2 || speeds.size() > most_points || speeds.size() != losses.size())
      throw thermal::InputError(
          fmt::format("loss_curve '{}' has {} speeds and {} losses; as many of both are due, 2 to {}", name,
                      speeds.size(), losses.size(), most_points));
    if (std::adjacent_find(speeds.begin(), speeds.end(), std::greater_equal<>()) != speeds.end())
      throw thermal::InputError("loss_curve '" + name + "': the speeds do not rise");
  }
  static double at_point(std::vector<double> const& values, int i) {
    return values[std::min(std::size_t(i), values.size() - 1)];
  }
  /// Points beyond the last lie ever further out, with its loss [rad/s].
  [[nodiscard]] double extra(int i) const { return std::max(0.0, 1.0 + i - double(speeds.size())); }
};

}  // namespace

Effect const& loss_curve_effect() {
  static Effect const effect = make_effect<LossCurve>(
      {"loss_curve",
       "loss measured over speed: a motor that is hottest below its highest speed",
       "P = k P(ω), linear between the points, constant beyond them",
       "source",
       "stator, gear box, pulley",
       "as its points say; not monotone where the field is weakened",
       "physics.md 1.7, §7 nos. 6, 7",
       {6, 7},
       {"motor_loss", "copper_loss"},
       "steps of the speed without load; a fit of motor_loss shows whether the field is weakened"});
  return effect;
}

}  // namespace thermotwin::twin
