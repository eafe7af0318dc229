#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "thermal/reduced_network.h"

namespace thermotwin::thermal {

/// Weighted sums of node temperatures of a reduced network, Σ wᵢ Tᵢ = offset + row · ξ; where a capacity depends on
/// temperature, T is found of y node by node.
class ReducedSums {
 public:
  using Weights = std::vector<std::pair<int, double>>;
  ReducedSums(ReducedNetwork const& network, std::vector<Weights> const& sums);

  [[nodiscard]] int size() const { return int(offset_.size()); }
  void evaluate(Eigen::VectorXd const& state, Eigen::VectorXd& result) const;

 private:
  struct SlopedNode {
    int node = 0;
    double start = 0.0;
    Eigen::RowVectorXd row;
    std::vector<std::pair<int, double>> sums;  ///< (sum, weight)
  };
  Network const* network_;
  Eigen::VectorXd offset_;
  Eigen::MatrixXd rows_;
  std::vector<SlopedNode> sloped_;
};

}  // namespace thermotwin::thermal
