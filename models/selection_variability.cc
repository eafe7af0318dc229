#include "models/selection_variability.h"

#include <set>

namespace thermotwin::models {

std::optional<double> switch_share(std::span<std::vector<Eigen::Index> const> sets) {
  if (sets.size() < 2) return std::nullopt;
  auto const as_set = [](std::vector<Eigen::Index> const& of) { return std::set<Eigen::Index>(of.begin(), of.end()); };
  int switches = 0;
  for (std::size_t i = 1; i < sets.size(); ++i) switches += as_set(sets[i]) != as_set(sets[i - 1]) ? 1 : 0;
  return double(switches) / double(sets.size() - 1);
}

}  // namespace thermotwin::models
