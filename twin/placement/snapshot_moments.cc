#include "twin/placement/snapshot_moments.h"

#include <Eigen/Cholesky>

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Sites = std::span<Index const>;

int members_of(Ensemble const& ensemble) { return ensemble.runs.back().member + 1; }

/// The rows of a member: its runs stand one after another.
std::pair<Index, Index> rows_of(Ensemble const& ensemble, int member) {
  Index first = -1, count = 0;
  for (auto const& run : ensemble.runs) {
    if (run.member != member) continue;
    if (first < 0) first = run.first;
    count += run.rows;
  }
  return {first, count};
}

/// Sums over rows, from which means and covariances follow.
struct Sums {
  double rows = 0.0;
  RowVectorXd x, y;
  MatrixXd xx, xy;

  Sums(MatrixXd const& readings, MatrixXd const& displacements)
      : rows(double(readings.rows())),
        x(readings.colwise().sum()),
        y(displacements.colwise().sum()),
        xx(readings.transpose() * readings),
        xy(readings.transpose() * displacements) {}
  Sums& operator-=(Sums const& other) {
    rows -= other.rows;
    x -= other.x, y -= other.y;
    xx -= other.xx, xy -= other.xy;
    return *this;
  }

  [[nodiscard]] LinearEstimate estimate(Sites sites, double noise_variance) const {
    RowVectorXd const mean_x = x / rows, mean_y = y / rows;
    MatrixXd readings = xx / rows - mean_x.transpose() * mean_x;
    readings.diagonal().array() += noise_variance;
    MatrixXd const cross = xy / rows - mean_x.transpose() * mean_y;
    return {{sites.begin(), sites.end()}, mean_x, mean_y, readings.llt().solve(cross)};
  }
};

MatrixXd readings_of(Ensemble const& ensemble, Sites sites, Index first, Index rows) {
  MatrixXd readings(rows, Index(sites.size()));
  for (std::size_t s = 0; s < sites.size(); ++s)
    readings.col(Index(s)) = ensemble.rise.col(sites[s]).segment(first, rows);
  return readings;
}

Sums sums_of(Ensemble const& ensemble, Sites sites, Index first, Index rows) {
  return {readings_of(ensemble, sites, first, rows), ensemble.displacement.middleRows(first, rows)};
}

/// Mean square per channel over some rows.
RowVectorXd error_on_rows(Ensemble const& ensemble, LinearEstimate const& estimate, double noise_variance, Index first,
                          Index rows) {
  MatrixXd const rise = readings_of(ensemble, estimate.sites, first, rows).rowwise() - estimate.mean_reading;
  MatrixXd const error =
      (ensemble.displacement.middleRows(first, rows).rowwise() - estimate.mean_displacement) - rise * estimate.weights;
  return error.colwise().squaredNorm() / double(rows) + noise_variance * estimate.weights.colwise().squaredNorm();
}

/// Adds the errors of one member to those of all.
class ErrorSum {
 public:
  explicit ErrorSum(Ensemble const& ensemble)
      : sum_(Eigen::VectorXd::Zero(ensemble.displacement.cols())), members_(members_of(ensemble)) {}

  void add(int member, RowVectorXd const& mean_square, Index rows) {
    sum_ += double(rows) * mean_square.transpose();
    rows_ += double(rows);
    members_[member] = mean_square.sum();
  }
  [[nodiscard]] EstimateError result() const { return {sum_ / rows_, members_}; }

 private:
  Eigen::VectorXd sum_, members_;
  double rows_ = 0.0;
};

}  // namespace

SnapshotMoments::SnapshotMoments(Ensemble const& ensemble, double noise) : ensemble_(&ensemble), noise_(noise) {}

models::PlacementProblem SnapshotMoments::problem(Index sites) const {
  auto const rows = double(ensemble_->rise.rows());
  MatrixXd const x = ensemble_->rise.leftCols(sites).rowwise() - ensemble_->rise.leftCols(sites).colwise().mean();
  MatrixXd const y = ensemble_->displacement.rowwise() - ensemble_->displacement.colwise().mean();
  models::PlacementProblem problem;
  problem.readings = x.transpose() * x / rows;
  problem.cross = x.transpose() * y / rows;
  problem.prior = y.squaredNorm() / rows;
  problem.noise = Eigen::VectorXd::Constant(sites, noise_variance());
  return problem;
}

LinearEstimate SnapshotMoments::estimate(Sites sites) const {
  return sums_of(*ensemble_, sites, 0, ensemble_->rise.rows()).estimate(sites, noise_variance());
}

EstimateError SnapshotMoments::cross_validated(Sites sites) const {
  Sums const all = sums_of(*ensemble_, sites, 0, ensemble_->rise.rows());
  ErrorSum sum(*ensemble_);
  for (int member = 0; member < members_of(*ensemble_); ++member) {
    auto const [first, rows] = rows_of(*ensemble_, member);
    Sums others = all;
    others -= sums_of(*ensemble_, sites, first, rows);
    auto const estimate = others.estimate(sites, noise_variance());
    sum.add(member, error_on_rows(*ensemble_, estimate, noise_variance(), first, rows), rows);
  }
  return sum.result();
}

EstimateError error_on(Ensemble const& ensemble, LinearEstimate const& estimate, double noise_variance) {
  ErrorSum sum(ensemble);
  for (int member = 0; member < members_of(ensemble); ++member) {
    auto const [first, rows] = rows_of(ensemble, member);
    sum.add(member, error_on_rows(ensemble, estimate, noise_variance, first, rows), rows);
  }
  return sum.result();
}

}  // namespace thermotwin::twin
