#pragma once

#include <Eigen/Core>
#include <span>

#include "models/batch.h"
#include "models/selection.h"

namespace thermotwin::models {

/// How series are made dimensionless before they are compared. (Scaling by the initial value fails, since ΔT(0) = 0.)
enum class GreyScaling {
  range,  ///< (x − min)/(max − min)
  mean,   ///< x / mean
};

struct GreyRelationOptions {
  double resolution = 0.5;  ///< ρ of (0, 1]: weight of the largest difference
  GreyScaling scaling = GreyScaling::range;
  bool align_signs = false;  ///< turn round the series that, dimensionless, move against the reference
};

/// Grey relational grade of each column with the reference (Deng 1982; methods.md §3.8), both scaled:
///
///     Δ_i(k) = |x₀(k) − x_i(k)|,   ξ_i(k) = (Δmin + ρ Δmax) / (Δ_i(k) + ρ Δmax),   r_i = ⟨ξ_i(k)⟩_k
///
/// Δmin and Δmax are those of all columns: grades depend on the set of columns and on ρ. All 1 where Δmax is but
/// rounding. Throws std::invalid_argument for different lengths, numbers that are none, ρ outside (0, 1], series that
/// cannot be scaled (constant; of mean 0).
Eigen::VectorXd grey_relational_grades(Eigen::MatrixXd const& columns, Eigen::VectorXd const& reference,
                                       GreyRelationOptions const& options = {});

/// Paper 004's choice for its lagged principal components (methods.md §7.4): the sensors of the highest grade over all
/// batches; two without a count.
Selection select_by_grey_relation(std::span<Batch const> batches, SelectionOptions const& options);

}  // namespace thermotwin::models
