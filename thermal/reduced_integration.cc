#include "thermal/reduced_integration.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "thermal/course_inputs.h"
#include "thermal/error.h"
#include "thermal/exponential_step.h"

namespace thermotwin::thermal {
namespace {

constexpr double first_step = 2.0, shortest_step = 1e-6, longest_step = 1800.0;

class ReducedRun {
 public:
  ReducedRun(ReducedNetwork const& network, Course const& course, double tolerance, long most_steps)
      : evaluation_(network),
        inputs_(network.network(), course),
        step_(network.decay(),
              [this](double t, Eigen::VectorXd const& state, Eigen::VectorXd& result) {
                ++summary_.rate_evaluations;
                evaluation_.rest(state, inputs_.at(t).data(), result);
              }),
        tolerance_(tolerance),
        most_steps_(most_steps) {}

  ReducedSummary operator()(Eigen::VectorXd const& initial, std::span<double const> times,
                            ReducedObserver const& observe);

 private:
  double try_step(double end, bool is_bend);

  ReducedEvaluation evaluation_;
  CourseInputs inputs_;
  ExponentialStep step_;
  double tolerance_, h_ = first_step;
  long most_steps_;
  double longest_ = std::min(longest_step, inputs_.longest_step());
  ReducedSummary summary_;
};

/// Attempts until a step is good; returns its length. One that a bend of the inputs cuts short says nothing against a
/// longer one behind it.
double ReducedRun::try_step(double end, bool is_bend) {
  while (true) {
    if (summary_.steps + summary_.rejected >= most_steps_)
      throw IntegrationError(fmt::format("the reduced run took {} steps until t = {:.6g} s, its last {:.3g} s",
                                         most_steps_, step_.time(), h_));
    double const left = end - step_.time();
    double const h = h_ > 0.999 * left ? left : h_ > 0.5 * left ? 0.5 * left : h_;
    step_.attempt(h);
    double const error = evaluation_.port_change(step_.error()) / tolerance_;
    double const factor = std::isfinite(error) ? 0.9 * std::pow(std::max(error, 1e-10), -0.25) : 0.1;
    bool const cut = is_bend && h < h_ && error <= 1.0;
    h_ = std::min(std::max(h * std::clamp(factor, 0.2, 4.0), cut ? h_ : 0.0), longest_);
    if (error <= 1.0) return h;
    ++summary_.rejected;
    if (!(h_ > shortest_step))
      throw IntegrationError(
          fmt::format("the reduced run stopped at t = {:.6g} s: its step became {:.3g} s", step_.time(), h_));
  }
}

ReducedSummary ReducedRun::operator()(Eigen::VectorXd const& initial, std::span<double const> times,
                                      ReducedObserver const& observe) {
  Eigen::VectorXd seen = initial;
  double piece_end = inputs_.enter_piece(times.front());
  observe({times.front(), seen, inputs_.at(times.front())});
  step_.restart(times.front(), initial);
  auto next = times.begin() + 1;
  double reached = times.front();
  while (next != times.end()) {
    double const bend = inputs_.next_bend(reached), end = std::min({piece_end, bend, times.back()});
    double const h = try_step(end, end == bend);
    reached = h == end - step_.time() ? end : step_.time() + h;
    for (; next != times.end() && *next <= reached && *next < piece_end; ++next) {
      step_.interpolate(*next - step_.time(), seen);
      observe({*next, seen, inputs_.at(*next)});
    }
    step_.accept();
    ++summary_.steps;
    if (reached < piece_end) continue;
    piece_end = inputs_.enter_piece(reached);
    if (next != times.end() && *next <= reached) {
      seen = step_.state();
      observe({*next++, seen, inputs_.at(reached)});
    }
    step_.restart(reached, Eigen::VectorXd(step_.state()));
    h_ = std::min(h_, first_step);
  }
  return summary_;
}

}  // namespace

ReducedSummary integrate(ReducedNetwork const& network, Course const& course, Eigen::VectorXd const& initial,
                         std::span<double const> output_times, double tolerance, ReducedObserver const& observe,
                         long most_steps) {
  if (output_times.empty()) throw InputError("there is no output time");
  return ReducedRun(network, course, tolerance, most_steps)(initial, output_times, observe);
}

}  // namespace thermotwin::thermal
