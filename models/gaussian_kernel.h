#pragma once

#include <Eigen/Core>

namespace thermotwin::models {

/// D_ij = ‖a_i − b_j‖² of the rows of a and b.
Eigen::MatrixXd squared_distances(Eigen::MatrixXd const& a, Eigen::MatrixXd const& b);

/// K_ij = exp(−g D_ij).
Eigen::MatrixXd gaussian_kernel(Eigen::MatrixXd const& distances, double g);

/// Refuses more samples than a matrix of all their pairs has room for in memory (std::invalid_argument).
void require_kernel_room(Eigen::Index samples);

}  // namespace thermotwin::models
