#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "thermal/evaluation.h"
#include "thermal/parameter_columns.h"

namespace thermotwin::thermal {

/// Whether a parameter moves a place or bends a heat capacity: it has no column then (ParameterColumns).
[[nodiscard]] bool has_no_column(NetworkDerivative const& parameter);

/// d(dy/dt)/dθ_k = (∂f/∂y) dy/dθ_k + ∂f/∂θ_k of many parameters at once: one linearisation serves all of them.
class SensitivityRates {
 public:
  /// InputError for a parameter that has no column.
  SensitivityRates(Network const& network, std::vector<NetworkDerivative> const& parameters);

  /// rates[k] from the state and its derivatives to every parameter.
  void evaluate(Evaluation& evaluation, double const* state, double const* input,
                std::span<double const* const> state_derivatives, std::span<double* const> rates);

 private:
  Network const* network_;
  ParameterColumns columns_;
  Linearisation at_;
  Eigen::MatrixXd forcing_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> temperature_, heat_;  ///< port × parameter
};

}  // namespace thermotwin::thermal
