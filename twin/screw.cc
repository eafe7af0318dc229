#include "twin/screw.h"

#include <fmt/format.h>
#include <vector>

namespace thermotwin::twin {

std::string Screw::channel_at(double x) const { return fmt::format("{}_{:g}mm", description.name, x * 1e3); }

bool Screw::is_linear() const { return screw.support != thermal::BallScrew::Support::fixed_fixed || !screw.unilateral; }

NodeWeights Screw::weights_at(double x) const {
  NodeWeights weights;
  std::vector<double> rise(screw.edges.size() - 1, 0.0);
  double const by_seats = screw.position_error(x, rise, 1.0);
  for (std::size_t cell = 0; cell < rise.size(); ++cell) {
    rise[cell] = 1.0;
    weights.emplace_back(first_node + int(cell), screw.position_error(x, rise));
    rise[cell] = 0.0;
  }
  for (auto const& [node, growth] : seat_growth) weights.emplace_back(node, by_seats * growth);
  for (auto const& [node, strain] : reference_strain) weights.emplace_back(node, -x * strain);
  weights.insert(weights.end(), zero_shift.begin(), zero_shift.end());
  return weights;
}

}  // namespace thermotwin::twin
