#include "scenarios/signal.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace thermotwin::scenarios {

Signal::Signal(double constant) : Signal({0.0}, {constant}, Interpolation::step) {}

Signal::Signal(std::vector<double> times, std::vector<double> values, Interpolation interpolation)
    : times_(std::move(times)), values_(std::move(values)), interpolation_(interpolation) {
  areas_.reserve(times_.size());
  areas_.push_back(0.0);
  for (std::size_t k = 1; k < times_.size(); ++k) areas_.push_back(areas_.back() + area(k - 1, times_[k]));
}

std::size_t Signal::piece(double t) const {
  auto const next = std::upper_bound(times_.begin(), times_.end(), t);
  return next == times_.begin() ? 0 : static_cast<std::size_t>(next - times_.begin()) - 1;
}

double Signal::at(double t) const {
  std::size_t const k = piece(t);
  if (interpolation_ == Interpolation::step || t <= times_[k] || k + 1 == times_.size()) return values_[k];
  double const share = (t - times_[k]) / (times_[k + 1] - times_[k]);
  return std::lerp(values_[k], values_[k + 1], share);
}

double Signal::area(std::size_t piece, double t) const {
  bool const sloped = interpolation_ == Interpolation::linear && t > times_[piece] && piece + 1 < times_.size();
  double const mean = sloped ? 0.5 * (values_[piece] + at(t)) : values_[piece];
  return mean * (t - times_[piece]);
}

double Signal::since_first(double t) const {
  std::size_t const k = piece(t);
  return areas_[k] + area(k, t);
}

double Signal::integral(double t) const { return since_first(t) - since_first(0.0); }

std::vector<double> Signal::jumps() const {
  std::vector<double> jumps;
  if (interpolation_ == Interpolation::linear) return jumps;
  for (std::size_t k = 1; k < times_.size(); ++k) {
    if (values_[k] != values_[k - 1]) jumps.push_back(times_[k]);
  }
  return jumps;
}

/// From the last bend on, the slopes that meet all breakpoints since within the tolerance (Sklansky & Gonzalez, Pattern
/// Recognition 12 (1980) 327): a bend is the last one before a breakpoint that none of them leads to.
std::vector<double> Signal::bends() const {
  if (interpolation_ == Interpolation::step || times_.size() < 2) return {};
  auto const [lowest, highest] = std::minmax_element(values_.begin(), values_.end());
  double const tolerance = std::max(0.05 * (*highest - *lowest), 3e-4 * largest_magnitude());
  std::vector<double> bends = {times_.front()};
  double least = -INFINITY, most = INFINITY;
  for (std::size_t last = 0, k = 1; k < times_.size(); ++k) {
    auto const slope_to = [&](double value) { return (value - values_[last]) / (times_[k] - times_[last]); };
    if (slope_to(values_[k]) < least || slope_to(values_[k]) > most) {
      last = k - 1;
      bends.push_back(times_[last]);
      least = -INFINITY, most = INFINITY;
    }
    least = std::max(least, slope_to(values_[k] - tolerance));
    most = std::min(most, slope_to(values_[k] + tolerance));
  }
  bends.push_back(times_.back());
  return bends;
}

Signal Signal::running() const {
  std::vector<double> times;
  std::vector<double> states;
  for (std::size_t k = 0; k < times_.size(); ++k) {
    bool const rising = interpolation_ == Interpolation::linear && k + 1 < times_.size() && values_[k + 1] != 0.0;
    double const state = values_[k] != 0.0 || rising ? 1.0 : 0.0;
    if (!states.empty() && states.back() == state) continue;
    times.push_back(times_[k]);
    states.push_back(state);
  }
  return {times, states, Interpolation::step};
}

double Signal::piece_start(double t) const {
  auto const k = piece(t);
  return k == 0 ? 0.0 : std::max(0.0, times_[k]);  // the first value holds before its breakpoint, too
}

double Signal::largest_magnitude() const {
  double largest = 0.0;
  for (double const value : values_) largest = std::max(largest, std::abs(value));
  return largest;
}

Signal Signal::scaled(double factor) const {
  std::vector<double> values = values_;
  for (double& value : values) value *= factor;
  return {times_, values, interpolation_};
}

Signal Signal::magnitude() const {
  std::vector<double> values = values_;
  for (double& value : values) value = std::abs(value);
  return {times_, values, interpolation_};
}

Signal Signal::with_piece(double from, double to, double value) const {
  std::vector<double> times, values;
  auto const add = [&](double t, double v) {
    times.push_back(t);
    values.push_back(v);
  };
  for (std::size_t k = 0; k < times_.size() && times_[k] < from; ++k) add(times_[k], values_[k]);
  add(from, value);
  add(to, at(to));
  for (std::size_t k = 0; k < times_.size(); ++k)
    if (times_[k] > to) add(times_[k], values_[k]);
  return {times, values, interpolation_};
}

Signal schedule(std::vector<Block> const& blocks, int cycles, double afterwards, double until) {
  std::vector<double> times;
  std::vector<double> values;
  double t = 0.0;
  for (int cycle = 0; cycle < cycles && t < until; ++cycle) {
    for (Block const& block : blocks) {
      if (t >= until) break;
      times.push_back(t);
      values.push_back(block.value);
      t += block.duration;
    }
  }
  if (t < until) {
    times.push_back(t);
    values.push_back(afterwards);
  }
  return {times, values, Interpolation::step};
}

}  // namespace thermotwin::scenarios
