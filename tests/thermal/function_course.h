#pragma once

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "thermal/operating_point.h"

namespace thermotwin::thermal {

/// A course given by a function of time; `jumps` and `bends` in increasing order.
class FunctionCourse final : public Course {
 public:
  using Function = std::function<void(double, std::span<double>)>;
  FunctionCourse(std::vector<std::string> const& names, Function function, std::vector<double> jumps = {},
                 std::vector<double> bends = {}, double longest_step = std::numeric_limits<double>::infinity())
      : function_(std::move(function)),
        jumps_(std::move(jumps)),
        bends_(std::move(bends)),
        longest_step_(longest_step) {
    for (auto const& name : names) channels_.push_back({name, "1", ""});
  }
  /// No inputs at all.
  FunctionCourse() : FunctionCourse({}, [](double, std::span<double>) {}) {}

  std::vector<InputChannel> const& channels() const override { return channels_; }
  void evaluate(double t, std::span<double> values) const override { function_(t, values); }
  double next_jump(double t) const override { return next_after(t, jumps_); }
  double next_bend(double t) const override { return next_after(t, bends_); }
  double longest_step() const override { return longest_step_; }

 private:
  static double next_after(double t, std::vector<double> const& times) {
    for (double const time : times)
      if (time > t) return time;
    return std::numeric_limits<double>::infinity();
  }

  std::vector<InputChannel> channels_;
  Function function_;
  std::vector<double> jumps_, bends_;
  double longest_step_;
};

}  // namespace thermotwin::thermal
