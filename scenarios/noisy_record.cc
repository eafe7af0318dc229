#include "scenarios/noisy_record.h"

#include <cmath>

namespace thermotwin::scenarios {
namespace {

/// Kalman filter with q = 1 and this r [s].
struct LevelFilter {
  std::vector<double> level, variance;  ///< of each sample, from those up to it
  double misfit = 0.0;                  ///< −2 ln likelihood at its best q, but for a constant

  LevelFilter(std::vector<double> const& times, std::vector<double> const& values, double r)
      : level{values[0]}, variance{r} {
    double squares = 0.0, logarithms = 0.0;
    for (std::size_t k = 1; k < values.size(); ++k) {
      double const before = variance.back() + times[k] - times[k - 1];
      double const innovation = values[k] - level.back(), expected = before + r;
      squares += innovation * innovation / expected;
      logarithms += std::log(expected);
      level.push_back(level.back() + before / expected * innovation);
      variance.push_back(before * r / expected);
    }
    misfit = double(values.size() - 1) * std::log(squares) + logarithms;
  }
};

}  // namespace

std::vector<double> without_noise(std::vector<double> const& times, std::vector<double> const& values) {
  if (values.size() < 3) return values;
  double const interval = (times.back() - times.front()) / double(times.size() - 1);
  LevelFilter best(times, values, 0.0);
  for (double r = interval / 8.0; r < 1e6 * interval; r *= 2.0)
    if (LevelFilter filter(times, values, r); filter.misfit < best.misfit) best = std::move(filter);
  std::vector<double> smooth = best.level;
  for (std::size_t k = smooth.size() - 1; k-- > 0;) {
    double const weight = best.variance[k] / (best.variance[k] + times[k + 1] - times[k]);
    smooth[k] += weight * (smooth[k + 1] - smooth[k]);
  }
  return smooth;
}

}  // namespace thermotwin::scenarios
