#include "models/grey_relation.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

#include "models/candidates.h"
#include "models/ranking.h"

namespace thermotwin::models {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int strategies_b_and_c = 2;    // main factor, fewest sensors
constexpr double no_difference = 1e-12;  // of series of range 1

VectorXd dimensionless(VectorXd const& x, GreyScaling scaling) {
  double const low = scaling == GreyScaling::range ? x.minCoeff() : 0.0;
  double const unit = scaling == GreyScaling::range ? x.maxCoeff() - low : x.mean();
  if (unit == 0)
    throw std::invalid_argument(scaling == GreyScaling::range
                                    ? "grey relation of a series that never moves"
                                    : "grey relation of a series of mean 0 dimensionless by its mean");
  return (x.array() - low) / unit;
}

double co_movement(VectorXd const& x, VectorXd const& y) {
  return (x.array() - x.mean()).matrix().dot((y.array() - y.mean()).matrix());
}

/// Up for down about the middle of what is dimensionless.
VectorXd turned_round(VectorXd const& series, GreyScaling scaling) {
  return (scaling == GreyScaling::range ? 1.0 : 2.0) - series.array();
}

}  // namespace

VectorXd grey_relational_grades(MatrixXd const& columns, VectorXd const& reference,
                                GreyRelationOptions const& options) {
  if (columns.rows() != reference.size() || columns.rows() == 0)
    throw std::invalid_argument(fmt::format("grey relation of {} rows with {}", columns.rows(), reference.size()));
  if (!columns.allFinite() || !reference.allFinite())
    throw std::invalid_argument("grey relation of a value that is no number");
  if (!(options.resolution > 0 && options.resolution <= 1))
    throw std::invalid_argument(
        fmt::format("grey relation with resolution {}: above 0, at most 1", options.resolution));
  VectorXd const target = dimensionless(reference, options.scaling);
  MatrixXd difference(columns.rows(), columns.cols());
  for (Index i = 0; i < columns.cols(); ++i) {
    VectorXd series = dimensionless(columns.col(i), options.scaling);
    if (options.align_signs && co_movement(series, target) < 0) series = turned_round(series, options.scaling);
    difference.col(i) = (series - target).cwiseAbs();
  }
  double const least = difference.minCoeff(), largest = difference.maxCoeff();
  if (largest < no_difference) return VectorXd::Ones(columns.cols());
  double const bound = options.resolution * largest;
  return ((least + bound) / (difference.array() + bound)).colwise().mean().transpose();
}

Selection select_by_grey_relation(std::span<Batch const> batches, SelectionOptions const& options) {
  auto const from = candidates(batches, options);
  require_error_that_moves(from);
  VectorXd const grades = grey_relational_grades(from.all.temperature_rise, from.all.error, {.align_signs = true});
  auto const usual = std::min<Index>(strategies_b_and_c, from.count());
  return selection(from, completed({}, options.count ? *options.count : usual, grades), grades);
}

}  // namespace thermotwin::models
