#include "twin/study/figure.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <fmt/format.h>

namespace thermotwin::twin {

Interval interval(std::vector<double> const& values) {
  Interval result;
  for (double const x : values)
    if (std::isfinite(x)) {
      result.mean += x;
      ++result.values;
    }
  if (result.values == 0) return {std::nan(""), 0, 0};
  result.mean /= result.values;
  if (result.values < 2) return result;
  double squares = 0;
  for (double const x : values)
    if (std::isfinite(x)) squares += (x - result.mean) * (x - result.mean);
  double const freedom = result.values - 1;
  double const t = boost::math::quantile(boost::math::students_t(freedom), 0.975);
  result.half = t * std::sqrt(squares / freedom / result.values);
  return result;
}

std::vector<double> ratio_of_means(std::vector<double> const& a, std::vector<double> const& b) {
  std::vector<double> parts(std::min(a.size(), b.size()), std::nan(""));
  double sum_a = 0, sum_b = 0;
  int both = 0;
  for (std::size_t r = 0; r < parts.size(); ++r)
    if (std::isfinite(a[r]) && std::isfinite(b[r])) {
      sum_a += a[r];
      sum_b += b[r];
      ++both;
    }
  double const ratio = sum_a / sum_b;
  for (std::size_t r = 0; r < parts.size(); ++r)
    if (std::isfinite(a[r]) && std::isfinite(b[r])) parts[r] = ratio + (a[r] - ratio * b[r]) / (sum_b / both);
  return parts;
}

bool more_is_better(std::string_view figure) {
  return figure == "improvement" || figure.ends_with(".r_squared") || figure == "selection.found" ||
         figure == "selection.rank_correlation";
}

std::vector<double> values_of(Figures const& figures, std::string const& name) {
  auto const it = figures.find(name);
  return it == figures.end() ? std::vector<double>() : it->second;
}

std::string text_of(Interval const& interval, int decimals) {
  if (interval.values == 0) return "-";
  auto mean = fmt::format("{:.{}f}", interval.mean, decimals);
  if (std::stod(mean) == 0.0) mean = fmt::format("{:.{}f}", 0.0, decimals);
  if (interval.values == 1) return mean;
  return fmt::format("{} ± {:.{}f}", mean, interval.half, decimals);
}

}  // namespace thermotwin::twin
