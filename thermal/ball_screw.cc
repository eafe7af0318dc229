#include "thermal/ball_screw.h"

#include <algorithm>

namespace thermotwin::thermal {

double BallScrew::free_growth(double x, std::span<double const> rise) const {
  double growth = 0.0;
  for (std::size_t i = 0; i < rise.size() && edges[i] < x; ++i)
    growth += expansion * rise[i] * (std::min(x, edges[i + 1]) - edges[i]);
  return growth;
}

double BallScrew::pretension() const {
  if (support != Support::fixed_fixed) return 0.0;
  double const compliance = length() / (youngs_modulus * section_area) + 1.0 / stiffness_fixed + 1.0 / stiffness_far;
  return expansion * length() * preload_temperature / compliance;
}

double BallScrew::force_change(double growth) const {
  if (support != Support::fixed_fixed) return 0.0;
  double const inner = length() / (youngs_modulus * section_area) + 1.0 / stiffness_fixed;
  double const change = -growth / (inner + 1.0 / stiffness_far);
  double const relief = -pretension();
  if (!unilateral || change >= relief) return change;
  double const growth_at_relief = expansion * length() * preload_temperature;
  double const remaining = released_stiffness * stiffness_far;
  double const pushed = remaining > 0.0 ? (growth - growth_at_relief) / (inner + 1.0 / remaining) : 0.0;
  return relief - pushed;
}

double BallScrew::position_error(double x, std::span<double const> rise, double seat_growth) const {
  double const change = force_change(free_growth(length(), rise) - seat_growth);
  return change / stiffness_fixed + free_growth(x, rise) + change * x / (youngs_modulus * section_area);
}

}  // namespace thermotwin::thermal
