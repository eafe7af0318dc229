#include "models/gaussian_kernel.h"

#include <fmt/format.h>
#include <stdexcept>

namespace thermotwin::models {

namespace {

constexpr Eigen::Index most_samples = 10'000;  // 0.8 GB a matrix

}  // namespace

using Eigen::MatrixXd;

MatrixXd squared_distances(MatrixXd const& a, MatrixXd const& b) {
  MatrixXd distances = -2.0 * a * b.transpose();
  distances.colwise() += a.rowwise().squaredNorm();
  distances.rowwise() += b.rowwise().squaredNorm().transpose();
  return distances.cwiseMax(0.0);
}

MatrixXd gaussian_kernel(MatrixXd const& distances, double g) { return (-g * distances.array()).exp(); }

void require_kernel_room(Eigen::Index samples) {
  if (samples > most_samples)
    throw std::invalid_argument(fmt::format(
        "{} samples are too many for a kernel of all their pairs, {} at most; take means over a longer time "
        "(--sampling, in a study sampling)",
        samples, most_samples));
}

}  // namespace thermotwin::models
