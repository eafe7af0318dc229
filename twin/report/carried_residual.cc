#include "twin/report/carried_residual.h"

#include <Eigen/QR>
#include <cmath>
#include <limits>

namespace thermotwin::twin {

ResidualCarrier::ResidualCarrier(thermal::Geometry const& geometry, std::vector<NodeWeights> const& sensors)
    : body_(Eigen::VectorXi::Constant(thermal::count_nodes(geometry), -1)), n_bodies_(int(geometry.size())) {
  auto const count = Eigen::Index(sensors.size());
  variogram_ = Eigen::MatrixXd::Zero(body_.size(), count);
  weights_ = Eigen::MatrixXd::Zero(count, body_.size());
  for (Eigen::Index s = 0; s < count; ++s)
    for (auto const& [node, weight] : sensors[std::size_t(s)])
      if (node < body_.size()) weights_(s, node) += weight;
  for (int b = 0; b < n_bodies_; ++b) {
    auto const& body = geometry[std::size_t(b)];
    auto const n = Eigen::Index(body.cells.size());
    Eigen::Matrix3Xd centres(3, n);
    for (Eigen::Index i = 0; i < n; ++i) centres.col(i) = thermal::centre(body.cells[std::size_t(i)]);
    body_.segment(body.first_node, n).setConstant(b);
    for (Eigen::Index s = 0; s < count; ++s)
      for (Eigen::Index k = 0; k < n; ++k)
        if (double const weight = weights_(s, body.first_node + k); weight != 0.0)
          variogram_.col(s).segment(body.first_node, n) +=
              weight * (centres.colwise() - centres.col(k)).colwise().norm().transpose();
  }
}

Eigen::VectorXd ResidualCarrier::operator()(Eigen::VectorXd const& shown) const {
  Eigen::VectorXd field = Eigen::VectorXd::Constant(body_.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<Eigen::Index> speaking;
  for (Eigen::Index s = 0; s < shown.size(); ++s)
    if (std::isfinite(shown[s]) && weights_.row(s).any()) speaking.push_back(s);
  if (speaking.empty()) return field;

  auto const n = Eigen::Index(speaking.size());
  Eigen::MatrixXd const weights = weights_(speaking, Eigen::all), variogram = variogram_(Eigen::all, speaking);
  Eigen::MatrixXd share = Eigen::MatrixXd::Zero(n, n_bodies_);  // of a sensor on a body
  for (Eigen::Index node = 0; node < body_.size(); ++node)
    if (body_[node] >= 0) share.col(body_[node]) += weights.col(node);
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + n_bodies_, n + n_bodies_);
  system.topLeftCorner(n, n) = weights * variogram;
  system.topRightCorner(n, n_bodies_) = share;
  system.bottomLeftCorner(n_bodies_, n) = share.transpose();

  Eigen::VectorXd const values = shown(speaking);
  double const mean = values.mean();
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + n_bodies_);
  right.head(n) = values.array() - mean;
  Eigen::VectorXd const solved = system.completeOrthogonalDecomposition().solve(right);
  Eigen::VectorXd const bent = variogram * solved.head(n);
  for (Eigen::Index node = 0; node < body_.size(); ++node) {
    int const body = body_[node];
    if (body >= 0 && share.col(body).any()) field[node] = mean + solved[n + body] + bent[node];
  }
  return field;
}

}  // namespace thermotwin::twin
