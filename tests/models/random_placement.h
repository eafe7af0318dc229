#pragma once

#include <Eigen/Core>
#include <random>

#include "models/remaining_variance.h"

namespace thermotwin::models {

/// Readings and quantities that follow `modes` hidden variables of falling size, 0.8 per mode, and quantities that
/// follow them with an error of their own; the same seed, the same problem.
inline PlacementProblem random_placement(unsigned seed, Eigen::Index sites, Eigen::Index modes = 12,
                                         Eigen::Index quantities = 3, double noise = 0.01) {
  std::mt19937_64 engine(seed);
  auto const even = [&] { return 2.0 * double(engine() >> 11) * 0x1p-53 - 1.0; };
  auto const matrix = [&](Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return even(); }));
  };
  Eigen::VectorXd const size = Eigen::VectorXd::NullaryExpr(modes, [](auto i) { return 3.0 * std::pow(0.8, i); });
  Eigen::MatrixXd const seen = matrix(sites, modes) * size.asDiagonal(), wanted = matrix(quantities, modes) * 4.0;
  PlacementProblem problem;
  problem.worlds = {{seen * seen.transpose(), seen * wanted.transpose(), wanted.squaredNorm() + 0.1}};
  problem.noise = Eigen::VectorXd::Constant(sites, noise);
  return problem;
}

}  // namespace thermotwin::models
