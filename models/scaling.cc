#include "models/scaling.h"

namespace thermotwin::models {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Scaling standard_scaling(MatrixXd const& columns) {
  VectorXd const moves = columns.colwise().maxCoeff() - columns.colwise().minCoeff();
  VectorXd const mean = (moves.array() > 0).select(columns.colwise().mean().transpose(), columns.row(0).transpose());
  MatrixXd const centred = columns.rowwise() - mean.transpose();
  VectorXd const deviation = (centred.colwise().squaredNorm() / static_cast<double>(columns.rows())).cwiseSqrt();
  return {mean, (moves.array() > 0).select(deviation, 1.0)};
}

Scaling range_scaling(MatrixXd const& columns, double low, double high) {
  VectorXd const least = columns.colwise().minCoeff();
  VectorXd const range = columns.colwise().maxCoeff().transpose() - least;
  VectorXd const scale = (range.array() > 0).select(range / (high - low), 1.0);
  return {least - low * scale, scale};
}

MatrixXd scaled(MatrixXd const& columns, VectorXd const& offset, VectorXd const& scale) {
  return (columns.rowwise() - offset.transpose()).array().rowwise() / scale.transpose().array();
}

MatrixXd scaled(MatrixXd const& columns, Scaling const& scaling) {
  return scaled(columns, scaling.offset, scaling.scale);
}

}  // namespace thermotwin::models
