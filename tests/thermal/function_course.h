#pragma once

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "thermal/operating_point.h"

namespace thermotwin::thermal {

/// A course given by a function of time; `jumps` in increasing order.
class FunctionCourse final : public Course {
 public:
  using Function = std::function<void(double, std::span<double>)>;
  FunctionCourse(std::vector<std::string> const& names, Function function, std::vector<double> jumps = {})
      : function_(std::move(function)), jumps_(std::move(jumps)) {
    for (auto const& name : names) channels_.push_back({name, "1", ""});
  }
  /// No inputs at all.
  FunctionCourse() : FunctionCourse({}, [](double, std::span<double>) {}) {}

  std::vector<InputChannel> const& channels() const override { return channels_; }
  void evaluate(double t, std::span<double> values) const override { function_(t, values); }
  double next_jump(double t) const override {
    for (double jump : jumps_)
      if (jump > t) return jump;
    return std::numeric_limits<double>::infinity();
  }

 private:
  std::vector<InputChannel> channels_;
  Function function_;
  std::vector<double> jumps_;
};

}  // namespace thermotwin::thermal
