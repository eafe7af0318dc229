#pragma once

#include <Eigen/Core>

namespace thermotwin::models {

/// x_ij = (X_ij − offset_j)/scale_j. A column that does not move has scale 1.
struct Scaling {
  Eigen::VectorXd offset, scale;
};

/// To mean 0 and variance 1 (divisor N); to exact zeros where a column does not move.
Scaling standard_scaling(Eigen::MatrixXd const& columns);

/// From [min, max] to [low, high].
Scaling range_scaling(Eigen::MatrixXd const& columns, double low, double high);

Eigen::MatrixXd scaled(Eigen::MatrixXd const& columns, Eigen::VectorXd const& offset, Eigen::VectorXd const& scale);
Eigen::MatrixXd scaled(Eigen::MatrixXd const& columns, Scaling const& scaling);

}  // namespace thermotwin::models
