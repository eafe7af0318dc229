#include "twin/diagnosis/discretisation.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

namespace thermotwin::twin {
namespace {

/// Halvings of the interval after which no state changes by more than about a half of itself.
int halvings(Eigen::MatrixXd const& dynamics, double interval) {
  double const change = dynamics.cwiseAbs().colwise().sum().maxCoeff() * interval;
  return std::max(0, int(std::ceil(std::log2(std::max(change, 0.5)))) + 1);
}

}  // namespace

Discretisation discretise(Eigen::MatrixXd const& dynamics, Eigen::VectorXd const& intensity, double interval) {
  Eigen::Index const n = dynamics.rows();
  int const doublings = halvings(dynamics, interval);
  double const step = std::ldexp(interval, -doublings);

  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  block.topLeftCorner(n, n) = -step * dynamics;
  block.topRightCorner(n, n).diagonal() = step * intensity.cwiseAbs2();
  block.bottomRightCorner(n, n) = step * dynamics.transpose();
  Eigen::MatrixXd const exponential = block.exp();

  Discretisation result;
  result.transition = exponential.bottomRightCorner(n, n).transpose();
  result.noise = result.transition * exponential.topRightCorner(n, n);
  for (int i = 0; i < doublings; ++i) {
    result.noise += result.transition * result.noise * result.transition.transpose();
    result.transition *= result.transition;
  }
  result.noise = (0.5 * (result.noise + result.noise.transpose())).eval();
  return result;
}

}  // namespace thermotwin::twin
