#include "models/fuzzy_c_means.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>

#include "models/uniform_draw.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index most_clusters = 10;

/// c different rows, drawn by the first c steps of a Fisher-Yates shuffle.
MatrixXd drawn_rows(MatrixXd const& points, int count, std::mt19937_64& generator) {
  std::vector<Index> rows(static_cast<std::size_t>(points.rows()));
  std::iota(rows.begin(), rows.end(), 0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    std::swap(rows[i], rows[i + index_draw(generator, rows.size() - i)]);
  rows.resize(static_cast<std::size_t>(count));
  return points(rows, Eigen::all);
}

/// d_ik², centres × points.
MatrixXd distances_from_centres(MatrixXd const& centres, MatrixXd const& points) {
  MatrixXd result(centres.rows(), points.rows());
  for (Index i = 0; i < centres.rows(); ++i)
    result.row(i) = (points.rowwise() - centres.row(i)).rowwise().squaredNorm().transpose();
  return result;
}

double largest_square(MatrixXd const& points) { return points.rowwise().squaredNorm().maxCoeff(); }

/// Of squared distances; what is left of a distance where points of this size coincide is none.
MatrixXd memberships(MatrixXd const& squared, double size, double exponent) {
  double const zero = 1e-20 * std::max(size, squared.maxCoeff());
  MatrixXd result(squared.rows(), squared.cols());
  for (Index k = 0; k < squared.cols(); ++k) {
    double const nearest = squared.col(k).minCoeff();
    if (nearest > zero)
      result.col(k) = (squared.col(k).array() / nearest).pow(-1.0 / (exponent - 1.0));
    else
      result.col(k) = (squared.col(k).array() <= zero).cast<double>();
    result.col(k) /= result.col(k).sum();
  }
  return result;
}

FuzzyClusters descend(MatrixXd const& points, MatrixXd const& first_centres, FuzzyOptions const& options) {
  FuzzyClusters clusters{{}, first_centres, {}};
  MatrixXd squared = distances_from_centres(clusters.centres, points);
  double const size = largest_square(points);
  clusters.membership = memberships(squared, size, options.exponent);
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    MatrixXd const weights = clusters.membership.array().pow(options.exponent);
    // A centre that no point belongs to (more centres than different points) stays where it is.
    for (Index i = 0; i < weights.rows(); ++i)
      if (double const sum = weights.row(i).sum(); sum > 0) clusters.centres.row(i) = weights.row(i) * points / sum;
    squared = distances_from_centres(clusters.centres, points);
    MatrixXd membership = memberships(squared, size, options.exponent);
    clusters.descent.push_back((membership.array().pow(options.exponent) * squared.array()).sum());
    double const change = (membership - clusters.membership).cwiseAbs().maxCoeff();
    clusters.membership = std::move(membership);
    if (change <= options.tolerance) break;
  }
  return clusters;
}

void check(MatrixXd const& points, int clusters, FuzzyOptions const& options) {
  if (clusters < 1 || clusters > points.rows())
    throw std::invalid_argument(
        fmt::format("{} clusters of {} points; 1 to {} are possible", clusters, points.rows(), points.rows()));
  if (!points.allFinite()) throw std::invalid_argument("fuzzy c-means: a coordinate is no number");
  if (!(options.exponent > 1))
    throw std::invalid_argument(fmt::format("exponent {}; it must be > 1", options.exponent));
  if (options.starts < 1 || options.iterations < 1)
    throw std::invalid_argument(
        fmt::format("{} starts of {} iterations; both must be at least 1", options.starts, options.iterations));
}

}  // namespace

std::vector<Index> FuzzyClusters::labels() const {
  std::vector<Index> result(static_cast<std::size_t>(membership.cols()));
  for (Index k = 0; k < membership.cols(); ++k) membership.col(k).maxCoeff(&result[static_cast<std::size_t>(k)]);
  return result;
}

FuzzyClusters fuzzy_c_means(MatrixXd const& points, int clusters, FuzzyOptions const& options) {
  check(points, clusters, options);
  std::mt19937_64 generator(options.seed);
  FuzzyClusters best;
  for (int start = 0; start < options.starts; ++start) {
    auto one = descend(points, drawn_rows(points, clusters, generator), options);
    if (start == 0 || one.objective() < best.objective()) best = std::move(one);
  }
  return best;
}

double xie_beni(FuzzyClusters const& clusters, MatrixXd const& points) {
  double const scatter =
      (clusters.membership.array().square() * distances_from_centres(clusters.centres, points).array()).sum();
  MatrixXd between = distances_from_centres(clusters.centres, clusters.centres);
  between.diagonal().setConstant(std::numeric_limits<double>::infinity());
  double const nearest = between.minCoeff();
  if (!(nearest > 1e-20 * largest_square(points)) || clusters.centres.rows() < 2)
    return std::numeric_limits<double>::infinity();
  return scatter / (static_cast<double>(points.rows()) * nearest);
}

FuzzyPartitions::FuzzyPartitions(MatrixXd points, FuzzyOptions const& options)
    : points_(std::move(points)), options_(options) {}

FuzzyClusters const& FuzzyPartitions::clusters(int count) {
  std::lock_guard const alone(finding_);
  auto found = found_.find(count);
  if (found == found_.end()) {
    found = found_.emplace(count, fuzzy_c_means(points_, count, options_)).first;
    ++made_;
  }
  return found->second;
}

int FuzzyPartitions::number() {
  int best = 1;
  double least = std::numeric_limits<double>::infinity();
  for (int c = 2; c <= std::min<Index>(points_.rows() / 2, most_clusters); ++c) {
    double const index = xie_beni(clusters(c), points_);
    if (index < least) {
      least = index;
      best = c;
    }
  }
  return best;
}

}  // namespace thermotwin::models
