#pragma once

#include <Eigen/Core>
#include <random>

namespace thermotwin::twin::tests {

/// Independent entries of N(0, 1).
[[nodiscard]] inline Eigen::MatrixXd normal(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> draw;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return draw(random); });
}

}  // namespace thermotwin::twin::tests
