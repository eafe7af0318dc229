#include "models/gaussian_kernel.h"

namespace thermotwin::models {

using Eigen::MatrixXd;

MatrixXd squared_distances(MatrixXd const& a, MatrixXd const& b) {
  MatrixXd distances = -2.0 * a * b.transpose();
  distances.colwise() += a.rowwise().squaredNorm();
  distances.rowwise() += b.rowwise().squaredNorm().transpose();
  return distances.cwiseMax(0.0);
}

MatrixXd gaussian_kernel(MatrixXd const& distances, double g) { return (-g * distances.array()).exp(); }

}  // namespace thermotwin::models
