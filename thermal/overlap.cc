#include "thermal/overlap.h"

#include <algorithm>
#include <cmath>

namespace thermotwin::thermal {
namespace {

/// Area of the disc of radius r inside the corner (−∞, x] × (−∞, y], up to a constant in x and one in y:
/// ∫₀ˣ∫₀ʸ of the disc's indicator, odd in x and in y.
double corner(double r, double x, double y) {
  double const sign = std::copysign(1.0, x) * std::copysign(1.0, y);
  x = std::min(std::abs(x), r);
  y = std::min(std::abs(y), r);
  if (x * x + y * y <= r * r) return sign * x * y;
  // Left of x* = √(r² − y²) the height is y, right of it √(r² − t²).
  double const start = std::sqrt(r * r - y * y);
  auto const under_arc = [r](double t) {
    return 0.5 * (t * std::sqrt(std::max(0.0, r * r - t * t)) + r * r * std::asin(std::min(1.0, t / r)));
  };
  return sign * (start * y + under_arc(x) - under_arc(start));
}

}  // namespace

double overlap(double low_a, double high_a, double low_b, double high_b) {
  return std::max(0.0, std::min(high_a, high_b) - std::max(low_a, low_b));
}

double disc_in_rectangle(double r, double x0, double x1, double y0, double y1) {
  if (r <= 0.0) return 0.0;
  return corner(r, x1, y1) - corner(r, x0, y1) - corner(r, x1, y0) + corner(r, x0, y0);
}

}  // namespace thermotwin::thermal
