#include "twin/diagnosis/elimination.h"

#include <utility>

#include "thermal/threaded_product.h"
#include "twin/parallel.h"

namespace thermotwin::twin {

Elimination::Elimination(Eigen::MatrixXd columns, Eigen::VectorXd mean, Eigen::VectorXd const& deviation,
                         std::vector<Eigen::Index> const& first_rows)
    : columns_(std::move(columns)), mean_(std::move(mean)), precision_(deviation.array().square().inverse()) {
  blocks_.resize(first_rows.size());
  std::vector<Eigen::MatrixXd> squares(blocks_.size());
  in_parallel(blocks_.size(), [&](std::size_t b) {
    auto const end = b + 1 < first_rows.size() ? first_rows[b + 1] : columns_.rows();
    auto const rows = columns_.middleRows(first_rows[b], end - first_rows[b]);
    auto& block = blocks_[b];
    block.first = first_rows[b];
    for (Eigen::Index u = 0; u < rows.cols(); ++u)
      if ((rows.col(u).array() != 0.0).any()) block.acting.push_back(u);
    block.columns = rows(Eigen::all, block.acting);
    squares[b] = thermal::threaded_square(block.columns);
  });
  information_ = precision_.asDiagonal();
  for (std::size_t b = 0; b < blocks_.size(); ++b) information_(blocks_[b].acting, blocks_[b].acting) += squares[b];
  std::erase_if(blocks_, [](Block const& block) { return block.acting.empty(); });
  factor_.compute(information_);
}

Eigen::VectorXd Elimination::best(Eigen::VectorXd const& residual) const {
  return factor_.solve(shared(residual) + precision_.cwiseProduct(mean_));
}

Eigen::VectorXd Elimination::effect_of(Eigen::VectorXd const& b) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(columns_.rows());
  for (auto const& block : blocks_)
    result.segment(block.first, block.columns.rows()).noalias() = block.columns * b(block.acting).eval();
  return result;
}

double Elimination::prior_cost(Eigen::VectorXd const& b) const { return (b - mean_).cwiseAbs2().dot(precision_); }

Eigen::MatrixXd Elimination::shared(Eigen::MatrixXd const& J, Eigen::Index first_row) const {
  std::vector<Block const*> blocks;
  for (auto const& block : blocks_)
    if (block.first >= first_row && block.first < first_row + J.rows()) blocks.push_back(&block);
  std::vector<Eigen::MatrixXd> parts(blocks.size());
  in_parallel(blocks.size(), [&](std::size_t b) {
    auto const& block = *blocks[b];
    parts[b].noalias() = block.columns.transpose() * J.middleRows(block.first - first_row, block.columns.rows());
  });
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(columns_.cols(), J.cols());
  for (std::size_t b = 0; b < blocks.size(); ++b) result(blocks[b]->acting, Eigen::all) += parts[b];
  return result;
}

Eigen::MatrixXd Elimination::curvature(Eigen::MatrixXd const& own, Eigen::MatrixXd const& shared) const {
  Eigen::MatrixXd const followed = factor_.matrixL().solve(shared);
  return own - thermal::threaded_square(followed);
}

}  // namespace thermotwin::twin
