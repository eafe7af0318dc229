#include "models/subset_validation.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

#include "models/contiguous_folds.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
constexpr double round_off = 1e-9;  // of the error's own size

MatrixXd triangle(MatrixXd const& rows) {
  if (rows.rows() <= rows.cols()) return rows;
  Eigen::HouseholderQR<MatrixXd> const factors(rows);
  return factors.matrixQR().topRows(rows.cols()).triangularView<Eigen::Upper>();
}

/// [1 X y], X centred and of unit deviation, y centred.
MatrixXd system_of(Batch const& data) {
  auto const& X = data.temperature_rise;
  MatrixXd system(X.rows(), X.cols() + 2);
  system << Eigen::VectorXd::Ones(X.rows()), X.rowwise() - X.colwise().mean(), data.error.array() - data.error.mean();
  for (Index j = 1; j <= X.cols(); ++j)
    if (double const size = system.col(j).norm(); size > 0)
      system.col(j) *= std::sqrt(static_cast<double>(X.rows())) / size;
  return system;
}

MatrixXd stacked_without(std::vector<MatrixXd> const& blocks, std::size_t left_out) {
  MatrixXd all(0, blocks.front().cols());
  for (std::size_t f = 0; f < blocks.size(); ++f) {
    if (f == left_out) continue;
    all.conservativeResize(all.rows() + blocks[f].rows(), Eigen::NoChange);
    all.bottomRows(blocks[f].rows()) = blocks[f];
  }
  return all;
}

}  // namespace

SubsetValidation::SubsetValidation(std::span<Batch const> batches, int folds) {
  Batch const data = stacked(batches);
  instants_ = shortest_training_ = data.time.size();
  sensors_ = data.temperature_rise.cols();
  MatrixXd const system = system_of(data);
  size_of_error_ = std::sqrt(system.rightCols<1>().squaredNorm() / static_cast<double>(instants_));
  for (auto const& fold : folds_of_runs(run_lengths(batches), folds)) {
    test_.push_back(triangle(system.middleRows(fold.first, fold.count)));
    shortest_training_ = std::min(shortest_training_, instants_ - fold.count);
  }
  for (std::size_t f = 0; f < test_.size(); ++f) training_.push_back(triangle(stacked_without(test_, f)));
}

double SubsetValidation::rmse(std::span<Index const> sensors) const {
  if (static_cast<int>(sensors.size()) > largest_set())
    throw std::invalid_argument(
        fmt::format("{} instants are too few to validate {} sensors: {} remain for training, and {} are needed",
                    instants_, sensors.size(), shortest_training_, sensors.size() + 2));
  std::vector<Index> columns{0};
  for (auto sensor : sensors) columns.push_back(sensor + 1);
  double sum = 0;
  for (std::size_t f = 0; f < test_.size(); ++f) {
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> factors;
    factors.setThreshold(1e-10);
    factors.compute(training_[f](Eigen::all, columns));
    Eigen::VectorXd const coefficients = factors.solve(training_[f].rightCols<1>());
    sum += (test_[f](Eigen::all, columns) * coefficients - test_[f].rightCols<1>()).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(instants_));
}

bool SubsetValidation::less(double rmse, double other) const { return rmse < other - round_off * size_of_error_; }

bool SubsetValidation::worthwhile(double before, double after) const {
  return after < 0.99 * before && before > round_off * size_of_error_;
}

}  // namespace thermotwin::models
