#include "thermal/reduced_sums.h"

#include <map>

namespace thermotwin::thermal {

ReducedSums::ReducedSums(ReducedNetwork const& network, std::vector<Weights> const& sums)
    : network_(&network.network()), offset_(Eigen::Index(sums.size())), rows_(offset_.size(), network.size()) {
  std::map<int, SlopedNode> sloped;
  for (std::size_t s = 0; s < sums.size(); ++s) {
    auto const all = network.functional(sums[s]);
    offset_[Eigen::Index(s)] = all.offset;
    rows_.row(Eigen::Index(s)) = all.row;
    for (auto const& [node, weight] : sums[s]) {
      if (network_->capacity_slope()[std::size_t(node)] == 0.0) continue;
      auto const own = network.functional({{node, 1.0}});
      auto& entry = sloped[node];
      entry.node = node;
      entry.start = own.offset;
      entry.row = own.row;
      entry.sums.emplace_back(int(s), weight);
    }
  }
  for (auto& [node, entry] : sloped) sloped_.push_back(std::move(entry));
}

void ReducedSums::evaluate(Eigen::VectorXd const& state, Eigen::VectorXd& result) const {
  result = offset_;
  result.noalias() += rows_ * state;
  for (auto const& node : sloped_) {
    double const y = node.start + node.row.dot(state);
    double const correction = network_->temperature_of_state(node.node, y) - y;
    for (auto const& [sum, weight] : node.sums) result[sum] += weight * correction;
  }
}

}  // namespace thermotwin::thermal
