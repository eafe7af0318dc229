#pragma once

#include <map>
#include <string>
#include <vector>

namespace thermotwin::twin {

/// Mean of n values and the half-width of its 95 % interval, t_{0.975, n−1} s/√n; without an interval for n < 2 (0).
struct Interval {
  double mean = 0, half = 0;
  int values = 0;
};

/// Of the values that are numbers; without any, the mean is NaN.
[[nodiscard]] Interval interval(std::vector<double> const& values);

/// Figures by name ("cross.rmse"), each once per repetition; NaN where there is none.
using Figures = std::map<std::string, std::vector<double>>;

/// The values of a figure; empty when the figures have none of that name.
[[nodiscard]] std::vector<double> values_of(Figures const& figures, std::string const& name);

/// "3.21 ± 0.04", "3.21" without an interval, "-" without a value.
[[nodiscard]] std::string text_of(Interval const& interval, int decimals = 2);

}  // namespace thermotwin::twin
