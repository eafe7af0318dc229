#include "models/quantile.h"

#include <algorithm>

namespace thermotwin::models {

double quantile(std::span<double const> ordered, double share) {
  double const place = share * static_cast<double>(ordered.size() - 1);
  auto const below = static_cast<std::size_t>(place);
  double const above = ordered[std::min(below + 1, ordered.size() - 1)];
  return ordered[below] + (place - static_cast<double>(below)) * (above - ordered[below]);
}

double upper_median(std::vector<double> values) {
  auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace thermotwin::models
