#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "thermal/evaluation.h"
#include "thermal/parameter_columns.h"

namespace thermotwin::thermal {

/// d(dy/dt)/dθ_k = (∂f/∂y) dy/dθ_k + ∂f/∂θ_k of many parameters at once: one linearisation serves all of them, except
/// those that move a place or bend a heat capacity, which have no column (ParameterColumns).
class SensitivityRates {
 public:
  /// `parameters` must outlive this.
  SensitivityRates(Network const& network, std::vector<NetworkDerivative> const& parameters);

  /// rates[k] from the state and its derivatives to every parameter.
  void evaluate(Evaluation& evaluation, double const* state, double const* input,
                std::span<double const* const> state_derivatives, std::span<double* const> rates);

 private:
  struct Parts {
    std::vector<std::size_t> together, apart;  ///< of the parameters
  };
  SensitivityRates(Network const& network, std::vector<NetworkDerivative> const& parameters, Parts parts);
  [[nodiscard]] static Parts parts_of(std::vector<NetworkDerivative> const& parameters);

  Network const* network_;
  std::vector<NetworkDerivative> const* parameters_;
  Parts parts_;
  ParameterColumns columns_;
  Linearisation at_;
  Eigen::MatrixXd forcing_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> temperature_, heat_;  ///< port × parameter
};

}  // namespace thermotwin::thermal
