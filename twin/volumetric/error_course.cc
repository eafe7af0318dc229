#include "twin/volumetric/error_course.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace thermotwin::twin {

double ErrorTable::operator()(double q) const {
  auto const last = positions.size() - 1;
  if (q <= positions[0]) return values[0];
  if (q >= positions[last]) return values[last];
  auto const above = std::upper_bound(positions.begin(), positions.end(), q) - positions.begin();
  double const share = (q - positions[above - 1]) / (positions[above] - positions[above - 1]);
  return (1.0 - share) * values[above - 1] + share * values[above];
}

double ErrorCourse::operator()(double q) const {
  double const u = (q - from) / (to - from);
  double sum = 0.0;
  for (auto c = polynomial.rbegin(); c != polynomial.rend(); ++c) sum = sum * u + *c;
  for (auto const& [amplitude, period, phase] : harmonics)
    sum += amplitude * std::sin(2.0 * std::numbers::pi * (q - from) / period + phase);
  for (auto const& table : tables) sum += table(q);
  return sum;
}

}  // namespace thermotwin::twin
