#include "twin/instruments/first_order_lag.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

void check(Eigen::VectorXd const& time, Eigen::VectorXd const& course, double lag) {
  using thermal::InputError;
  if (time.size() == 0 || time.size() != course.size())
    throw InputError(fmt::format("a course has {} times and {} values; as many of both are due, and at least one",
                                 time.size(), course.size()));
  if (!(lag >= 0.0)) throw InputError(fmt::format("lag is {} s; it must not be negative", lag));
  for (Eigen::Index i = 1; i < time.size(); ++i)
    if (!(time[i] > time[i - 1]))
      throw InputError(
          fmt::format("the times of a course must increase strictly, but {} s follows {} s", time[i], time[i - 1]));
}

}  // namespace

FirstOrderLag::FirstOrderLag(Eigen::VectorXd time, Eigen::VectorXd course, double lag)
    : time_(std::move(time)), course_(std::move(course)), lag_(lag) {
  check(time_, course_, lag_);
  state_ = course_;
  for (Eigen::Index i = 1; i < time_.size(); ++i) state_[i] = advance(i - 1, time_[i] - time_[i - 1]);
}

double FirstOrderLag::advance(Eigen::Index piece, double elapsed) const {
  bool const last = piece + 1 == time_.size();
  double const slope = last ? 0.0 : (course_[piece + 1] - course_[piece]) / (time_[piece + 1] - time_[piece]);
  double const loss = lag_ > 0.0 ? std::expm1(-elapsed / lag_) : -1.0;  // e^{−s/τ} − 1
  return course_[piece] + (state_[piece] - course_[piece]) * (1.0 + loss) + slope * (elapsed + lag_ * loss);
}

double FirstOrderLag::at(double t) const {
  if (t <= time_[0]) return course_[0];
  auto const next = std::upper_bound(time_.begin(), time_.end(), t);
  auto const piece = Eigen::Index(next - time_.begin()) - 1;
  return advance(piece, t - time_[piece]);
}

}  // namespace thermotwin::twin
