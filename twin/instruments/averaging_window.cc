#include "twin/instruments/averaging_window.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

constexpr double rounding_of_time = 1e-6;  ///< of the interval between two conversions

}  // namespace

AveragingWindow::AveragingWindow(double length, double interval) : length_(length), interval_(interval) {
  if (!(interval > 0.0))
    throw thermal::InputError(fmt::format("conversion_interval is {} s; it must be positive", interval));
}

double AveragingWindow::mean(double t, std::function<double(double)> const& convert) {
  while (!kept_.empty() && kept_.front().time <= t - length_ + rounding_of_time * interval_) kept_.pop_front();
  double const span = std::min(length_, t - last_);
  int const fresh = std::max(1, static_cast<int>(std::floor(span / interval_ + 1e-9)));
  for (int i = fresh - 1; i >= 0; --i) {
    double const time = t - i * interval_;
    kept_.push_back({time, convert(time)});
  }
  last_ = t;
  double sum = 0.0;
  for (auto const& conversion : kept_) sum += conversion.value;
  return sum / static_cast<double>(kept_.size());
}

}  // namespace thermotwin::twin
