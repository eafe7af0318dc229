#include "twin/placement/snapshot_moments.h"

#include <Eigen/Cholesky>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using SiteSpan = std::span<Index const>;

int members_of(Ensemble const& ensemble) { return ensemble.runs.back().member + 1; }

/// The rows of a member: its runs stand one after another.
Rows rows_of(Ensemble const& ensemble, int member) {
  Rows rows{-1, 0};
  for (auto const& run : ensemble.runs) {
    if (run.member != member) continue;
    if (rows.first < 0) rows.first = run.first;
    rows.count += run.rows;
  }
  return rows;
}

MatrixXd centred(MatrixXd values) {
  values.rowwise() -= values.colwise().mean().eval();
  return values;
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

  [[nodiscard]] LinearEstimate estimate(SiteSpan sites, double noise_variance) const {
    RowVectorXd const mean_x = x / rows, mean_y = y / rows;
    MatrixXd readings = xx / rows - mean_x.transpose() * mean_x;
    readings.diagonal().array() += noise_variance;
    MatrixXd const cross = xy / rows - mean_x.transpose() * mean_y;
    return {{sites.begin(), sites.end()}, mean_x, mean_y, readings.llt().solve(cross)};
  }
};

MatrixXd readings_of(Ensemble const& ensemble, SiteSpan sites, Rows rows) {
  MatrixXd readings(rows.count, Index(sites.size()));
  for (std::size_t s = 0; s < sites.size(); ++s)
    readings.col(Index(s)) = ensemble.rise.col(sites[s]).segment(rows.first, rows.count);
  return readings;
}

Sums sums_of(Ensemble const& ensemble, SiteSpan sites, Rows rows) {
  return {readings_of(ensemble, sites, rows), ensemble.displacement.middleRows(rows.first, rows.count)};
}

/// Mean square per channel over some rows.
RowVectorXd error_on_rows(Ensemble const& ensemble, LinearEstimate const& estimate, double noise_variance, Rows rows) {
  MatrixXd const rise = readings_of(ensemble, estimate.sites, rows).rowwise() - estimate.mean_reading;
  MatrixXd const error =
      (ensemble.displacement.middleRows(rows.first, rows.count).rowwise() - estimate.mean_displacement) -
      rise * estimate.weights;
  return error.colwise().squaredNorm() / double(rows.count) + noise_variance * estimate.weights.colwise().squaredNorm();
}

/// Adds the errors of one member to those of all.
class ErrorSum {
 public:
  explicit ErrorSum(Ensemble const& ensemble)
      : ensemble_(ensemble),
        sum_(Eigen::VectorXd::Zero(ensemble.displacement.cols())),
        members_(Eigen::VectorXd::Zero(members_of(ensemble))) {}

  /// Of some rows of a member.
  void add(int member, RowVectorXd const& mean_square, Rows rows) {
    sum_ += double(rows.count) * mean_square.transpose();
    rows_ += double(rows.count);
    members_[member] += mean_square.sum() * double(rows.count) / double(rows_of(ensemble_, member).count);
  }
  [[nodiscard]] EstimateError result() const { return {sum_ / rows_, members_}; }

 private:
  Ensemble const& ensemble_;
  Eigen::VectorXd sum_, members_;
  double rows_ = 0.0;
};

/// Every run of every member by what its other runs teach.
EstimateError by_other_runs(Ensemble const& ensemble, SiteSpan sites, double noise_variance) {
  ErrorSum sum(ensemble);
  for (auto const& run : ensemble.runs) {
    Rows const rows{run.first, run.rows};
    Sums others = sums_of(ensemble, sites, rows_of(ensemble, run.member));
    others -= sums_of(ensemble, sites, rows);
    auto const estimate = others.estimate(sites, noise_variance);
    sum.add(run.member, error_on_rows(ensemble, estimate, noise_variance, rows), rows);
  }
  return sum.result();
}

std::vector<Rows> groups_of(Ensemble const& ensemble, Teacher teacher) {
  if (teacher == Teacher::family) return {{0, ensemble.rise.rows()}};
  std::vector<Rows> groups;
  for (int member = 0; member < members_of(ensemble); ++member) groups.push_back(rows_of(ensemble, member));
  return groups;
}

}  // namespace

SnapshotMoments::SnapshotMoments(Ensemble const& ensemble, double noise, Teacher teacher)
    : ensemble_(&ensemble), noise_(noise), teacher_(teacher), groups_(groups_of(ensemble, teacher)) {
  if (teacher == Teacher::machine && ensemble.runs.size() < 2 * groups_.size())
    throw thermal::InputError(
        "a model that is trained on the machine itself needs two spectra at least: one to train on, one to judge by");
}

models::PlacementProblem SnapshotMoments::problem(Index sites) const {
  models::PlacementProblem problem;
  for (auto const& [first, count] : groups_) {
    MatrixXd const x = centred(ensemble_->rise.middleRows(first, count).leftCols(sites));
    MatrixXd const y = centred(ensemble_->displacement.middleRows(first, count));
    problem.worlds.push_back(
        {x.transpose() * x / double(count), x.transpose() * y / double(count), y.squaredNorm() / double(count)});
  }
  problem.noise = Eigen::VectorXd::Constant(sites, noise_variance());
  return problem;
}

LinearEstimate SnapshotMoments::estimate(SiteSpan sites) const {
  return sums_of(*ensemble_, sites, {0, ensemble_->rise.rows()}).estimate(sites, noise_variance());
}

EstimateError SnapshotMoments::cross_validated(SiteSpan sites) const {
  if (teacher_ == Teacher::machine) return by_other_runs(*ensemble_, sites, noise_variance());
  Sums const all = sums_of(*ensemble_, sites, {0, ensemble_->rise.rows()});
  ErrorSum sum(*ensemble_);
  for (int member = 0; member < members_of(*ensemble_); ++member) {
    auto const rows = rows_of(*ensemble_, member);
    Sums others = all;
    others -= sums_of(*ensemble_, sites, rows);
    auto const estimate = others.estimate(sites, noise_variance());
    sum.add(member, error_on_rows(*ensemble_, estimate, noise_variance(), rows), rows);
  }
  return sum.result();
}

EstimateError error_on(Ensemble const& ensemble, LinearEstimate const& estimate, double noise_variance) {
  ErrorSum sum(ensemble);
  for (int member = 0; member < members_of(ensemble); ++member) {
    auto const rows = rows_of(ensemble, member);
    sum.add(member, error_on_rows(ensemble, estimate, noise_variance, rows), rows);
  }
  return sum.result();
}

EstimateError SnapshotMoments::unseen(Ensemble const& others, SiteSpan sites) const {
  if (teacher_ == Teacher::family) return error_on(others, estimate(sites), noise_variance());
  return SnapshotMoments(others, noise_, teacher_).cross_validated(sites);
}

}  // namespace thermotwin::twin
