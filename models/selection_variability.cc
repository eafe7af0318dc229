#include "models/selection_variability.h"

#include <set>

namespace thermotwin::models {

SelectionVariability selection_variability(SelectionMethod const& method, std::span<Batch const> batches,
                                           SelectionOptions const& options) {
  auto const sensors = stacked(batches).temperature_rise.cols();
  SelectionVariability variability{{}, 0, 0, Eigen::VectorXd::Zero(sensors)};
  std::set<std::set<Eigen::Index>> sets;
  std::set<Eigen::Index> before;
  int switches = 0;
  for (auto const& batch : batches) {
    auto const& chosen = variability.selections.emplace_back(method.select({&batch, 1}, options)).sensors;
    for (auto const sensor : chosen) variability.chosen_share(sensor) += 1.0 / static_cast<double>(batches.size());
    std::set<Eigen::Index> const now(chosen.begin(), chosen.end());
    if (variability.selections.size() > 1 && now != before) ++switches;
    sets.insert(now);
    before = now;
  }
  variability.different_sets = static_cast<int>(sets.size());
  if (batches.size() > 1) variability.switch_frequency = switches / static_cast<double>(batches.size() - 1);
  return variability;
}

}  // namespace thermotwin::models
