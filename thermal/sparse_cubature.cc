#include "thermal/sparse_cubature.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

namespace thermotwin::thermal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The columns that have weight, with their products.
class Chosen {
 public:
  Chosen(MatrixXd const& columns, VectorXd target) : columns_(columns), target_(std::move(target)) {}

  void add(int column) {
    index_.push_back(column);
    weight_.push_back(0.0);
    auto const n = Index(index_.size());
    gram_.conservativeResize(n, n);
    right_.conservativeResize(n);
    for (Index k = 0; k < n; ++k)
      gram_(n - 1, k) = gram_(k, n - 1) = columns_.col(index_[std::size_t(k)]).dot(columns_.col(column));
    right_[n - 1] = columns_.col(column).dot(target_);
  }

  /// Least squares; columns whose weight would fall below zero leave on the way.
  void settle() {
    while (!index_.empty()) {
      MatrixXd regular = gram_;
      regular.diagonal() *= 1.0 + 1e-12;
      VectorXd const wanted = regular.ldlt().solve(right_);
      double way = 1.0;
      Index first = -1;
      for (Index k = 0; k < wanted.size(); ++k) {
        double const now = weight_[std::size_t(k)];
        if (wanted[k] <= 0.0 && now / (now - wanted[k] + std::numeric_limits<double>::min()) <= way) {
          way = now / (now - wanted[k] + std::numeric_limits<double>::min());
          first = k;
        }
      }
      for (Index k = 0; k < wanted.size(); ++k) weight_[std::size_t(k)] += way * (wanted[k] - weight_[std::size_t(k)]);
      if (first < 0) return;
      remove(first);
    }
  }

  [[nodiscard]] VectorXd residual() const {
    VectorXd left = target_;
    for (std::size_t k = 0; k < index_.size(); ++k) left -= weight_[k] * columns_.col(index_[k]);
    return left;
  }
  [[nodiscard]] std::vector<int> const& index() const { return index_; }
  [[nodiscard]] std::vector<double> const& weight() const { return weight_; }

 private:
  void remove(Index k) {
    Index const last = Index(index_.size()) - 1;
    index_.erase(index_.begin() + k);
    weight_.erase(weight_.begin() + k);
    std::vector<Index> keep;
    for (Index i = 0; i <= last; ++i)
      if (i != k) keep.push_back(i);
    gram_ = MatrixXd(gram_(keep, keep));
    right_ = VectorXd(right_(keep));
  }

  MatrixXd const& columns_;
  VectorXd target_;
  std::vector<int> index_;
  std::vector<double> weight_;
  MatrixXd gram_;
  VectorXd right_;
};

}  // namespace

std::vector<std::pair<int, double>> sparse_cubature(MatrixXd const& columns, double tolerance, int most) {
  VectorXd const target = columns.rowwise().sum();
  Chosen chosen(columns, target);
  std::vector<char> tried(std::size_t(columns.cols()), 0);
  VectorXd left = target;
  while (int(chosen.index().size()) < most && left.norm() > tolerance * target.norm()) {
    VectorXd const slope = columns.transpose() * left;
    int best = -1;
    for (int c = 0; c < int(slope.size()); ++c)
      if (!tried[std::size_t(c)] && slope[c] > 0.0 && (best < 0 || slope[c] > slope[best])) best = c;
    if (best < 0) break;
    tried[std::size_t(best)] = 1;
    chosen.add(best);
    chosen.settle();
    left = chosen.residual();
  }
  std::vector<std::pair<int, double>> result;
  for (std::size_t k = 0; k < chosen.index().size(); ++k) result.emplace_back(chosen.index()[k], chosen.weight()[k]);
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace thermotwin::thermal
