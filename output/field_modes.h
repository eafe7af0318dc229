#pragma once

#include <Eigen/Core>

namespace thermotwin::output {

/// A field that changes with time, as a few shapes and their courses (proper orthogonal decomposition; Sirovich 1987):
///
///   T(t, x) ≈ T(0, x) + Σₖ cₖ(t) φₖ(x),   φₖ orthonormal over the nodes.
///
/// Diffusion leaves smooth fields: some ten shapes hold hours of ten thousand nodes to a hundredth of a kelvin.
struct FieldModes {
  Eigen::VectorXd start;       ///< T(0, x), per node
  Eigen::MatrixXd shapes;      ///< node × mode
  Eigen::MatrixXd courses;     ///< row × mode
  double largest_error = 0.0;  ///< over all nodes and rows, in the field's unit
};

/// As few modes as keep the largest error within `tolerance`, but no more than `most`. The shapes come from at most 400
/// rows spread evenly, the courses and the error from all.
[[nodiscard]] FieldModes field_modes(Eigen::MatrixXf const& rows_by_node, double tolerance, int most);

}  // namespace thermotwin::output
