#include "twin/diagnosis/separation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace thermotwin::twin {

Separation::Separation(Estimation const& estimation, Fit const& fit, Eigen::MatrixXd const& signatures) {
  prior_ = fit.jacobian.priors().cwiseAbs2().asDiagonal();
  Eigen::MatrixXd const jacobian = fit.jacobian.of_data();
  auto const& channels = estimation.channels();
  for (std::size_t r = 0; r < estimation.data().size(); ++r) {
    auto const& run = estimation.data()[r];
    auto const rows = run.time.size();
    for (std::size_t c = 0; c < run.run->channels.size(); ++c) {
      auto const first = estimation.first_row(r) + Eigen::Index(c) * rows;
      auto const J = jacobian.middleRows(first, rows);
      auto const s = signatures.middleRows(first, rows);
      auto const channel = std::find(channels.begin(), channels.end(), run.run->channels[c].name) - channels.begin();
      blocks_.push_back({r, std::size_t(channel), J.transpose() * J, J.transpose() * s, s.transpose() * s});
    }
  }
}

Eigen::MatrixXd Separation::products(Blocks const& use) const {
  Eigen::MatrixXd nuisance = prior_;
  Eigen::MatrixXd shared = Eigen::MatrixXd::Zero(blocks_[0].shared.rows(), blocks_[0].shared.cols());
  Eigen::MatrixXd own = Eigen::MatrixXd::Zero(shared.cols(), shared.cols());
  for (auto const& block : blocks_) {
    if (!use.runs[block.run] || !use.channels[block.channel]) continue;
    nuisance += block.nuisance;
    shared += block.shared;
    own += block.own;
  }
  return own - shared.transpose() * nuisance.llt().solve(shared);
}

double seen(Eigen::MatrixXd const& products, Eigen::Index i, double amplitude) {
  return std::abs(amplitude) * std::sqrt(std::max(0.0, products(i, i)));
}

double cosine(Eigen::MatrixXd const& products, Eigen::Index i, Eigen::Index j) {
  double const square = products(i, i) * products(j, j);
  return square > 0.0 ? std::clamp(products(i, j) / std::sqrt(square), -1.0, 1.0) : 0.0;
}

double apart(Eigen::MatrixXd const& products, Eigen::Index i, Eigen::Index j, double amplitude) {
  double const alike = cosine(products, i, j);
  return seen(products, i, amplitude) * std::sqrt(1.0 - alike * alike);
}

}  // namespace thermotwin::twin
