#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace thermotwin::twin {

/// Mean of n values and the half-width of its 95 % interval, t_{0.975, n−1} s/√n; without an interval for n < 2 (0).
struct Interval {
  double mean = 0, half = 0;
  int values = 0;
};

/// Of the values that are numbers; without any, the mean is NaN.
[[nodiscard]] Interval interval(std::vector<double> const& values);

/// Ratio of the means of a and b over the repetitions that have both, R = ā/b̄, as what each repetition makes of it:
/// R + (a_r − R b_r)/b̄. Their mean is R, and their interval the ratio's, of paired values in first order: half-width
/// t_{0.975, n−1} s/√n with s² = Σ (a_r − R b_r)²/((n − 1) b̄²) (Cochran, Sampling Techniques, 1977, § 6.4, 6.5). NaN
/// where a repetition lacks one of the two.
[[nodiscard]] std::vector<double> ratio_of_means(std::vector<double> const& a, std::vector<double> const& b);

/// Figures by name ("cross.rmse"), each once per repetition; NaN where there is none.
using Figures = std::map<std::string, std::vector<double>>;

/// Whether a combination with more of this figure is the better one: of r_squared, improvement, found and
/// rank_correlation. Of all others it is the one with less.
[[nodiscard]] bool more_is_better(std::string_view figure);

/// The values of a figure; empty when the figures have none of that name.
[[nodiscard]] std::vector<double> values_of(Figures const& figures, std::string const& name);

/// "3.21 ± 0.04", "3.21" without an interval, "-" without a value. What rounds to zero has no sign.
[[nodiscard]] std::string text_of(Interval const& interval, int decimals = 2);

}  // namespace thermotwin::twin
