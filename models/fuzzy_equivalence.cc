#include "models/fuzzy_equivalence.h"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <stdexcept>

#include "models/candidates.h"
#include "models/grey_relation.h"
#include "models/ranking.h"

namespace thermotwin::models {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Classes = std::vector<std::vector<Index>>;

namespace {

constexpr double same_level = 1e-12, significance = 0.05;

void check_similarity(MatrixXd const& r) {
  if (r.rows() != r.cols() || r.rows() == 0)
    throw std::invalid_argument(fmt::format("a similarity of {} by {}: square, at least 1 by 1", r.rows(), r.cols()));
  bool const in_range = (r.array() >= 0).all() && (r.array() <= 1).all();
  if (!in_range || r != r.transpose() || (r.diagonal().array() != 1).any())
    throw std::invalid_argument("a similarity is symmetric, within 0 and 1, and 1 on its diagonal");
}

MatrixXd squared(MatrixXd const& r) {
  MatrixXd result(r.rows(), r.cols());
  for (Index i = 0; i < r.rows(); ++i)
    for (Index j = 0; j < r.cols(); ++j) result(i, j) = r.col(i).cwiseMin(r.col(j)).maxCoeff();
  return result;
}

MatrixXd unit_columns(MatrixXd const& columns) {
  MatrixXd unit = columns.rowwise() - columns.colwise().mean();
  for (Index i = 0; i < unit.cols(); ++i)
    if (double const length = unit.col(i).norm(); length > 0) unit.col(i) /= length;
  return unit;
}

/// F − F_α; the least of all where nothing differs within classes: their number would then be judged by a division by
/// 0.
double excess_of_F(Classes const& classes, MatrixXd const& objects) {
  auto const members = static_cast<double>(objects.rows()), groups = static_cast<double>(classes.size());
  VectorXd const centre = objects.colwise().mean();
  double between = 0, within = 0;
  for (auto const& group : classes) {
    MatrixXd const part = objects(group, Eigen::all);
    VectorXd const own = part.colwise().mean();
    between += static_cast<double>(group.size()) * (own - centre).squaredNorm();
    within += (part.rowwise() - own.transpose()).squaredNorm();
  }
  if (within <= same_level * between) return -std::numeric_limits<double>::infinity();
  double const F = between / (groups - 1) / (within / (members - groups));
  return F - quantile(complement(boost::math::fisher_f(groups - 1, members - groups), significance));
}

}  // namespace

MatrixXd correlation_similarity(MatrixXd const& columns) {
  MatrixXd const unit = unit_columns(columns);
  MatrixXd similarity = (unit.transpose() * unit).cwiseAbs().cwiseMin(1.0);
  similarity = similarity.cwiseMax(similarity.transpose().eval());
  similarity.diagonal().setOnes();
  return similarity;
}

MatrixXd transitive_closure(MatrixXd similarity) {
  check_similarity(similarity);
  for (;;) {
    MatrixXd next = squared(similarity);
    if (next == similarity) return similarity;
    similarity = std::move(next);
  }
}

Classes classes_at(MatrixXd const& closure, double lambda) {
  Classes classes;
  for (Index i = 0; i < closure.rows(); ++i) {
    auto const own = std::find_if(classes.begin(), classes.end(), [&](auto const& members) {
      return closure(members.front(), i) >= lambda - same_level;
    });
    if (own == classes.end())
      classes.push_back({i});
    else
      own->push_back(i);
  }
  return classes;
}

std::vector<double> levels_of(MatrixXd const& closure) {
  std::vector<double> values;
  for (Index i = 0; i < closure.rows(); ++i)
    for (Index j = 0; j < i; ++j) values.push_back(closure(i, j));
  std::sort(values.rbegin(), values.rend());
  std::vector<double> levels;
  for (double const value : values)
    if (levels.empty() || value < levels.back() - same_level) levels.push_back(value);
  return levels;
}

namespace {

/// All partitions that some λ gives, from the finest to the coarsest.
std::vector<Classes> partitions(MatrixXd const& closure) {
  std::vector<Classes> all{classes_at(closure, 2.0)};
  for (double const level : levels_of(closure)) all.push_back(classes_at(closure, level));
  return all;
}

}  // namespace

Classes classes_nearest(MatrixXd const& closure, int count) {
  auto const all = partitions(closure);
  return *std::min_element(all.begin(), all.end(), [&](auto const& a, auto const& b) {
    return std::abs(std::ssize(a) - count) < std::abs(std::ssize(b) - count);
  });
}

Classes classes_by_F(MatrixXd const& closure, MatrixXd const& objects) {
  if (objects.rows() != closure.rows())
    throw std::invalid_argument(fmt::format("{} objects, a closure of {}", objects.rows(), closure.rows()));
  auto const all = partitions(closure);
  auto best = all.back();
  std::optional<double> largest;
  for (auto classes = all.rbegin(); classes != all.rend(); ++classes) {
    if (classes->size() < 2 || std::ssize(*classes) >= closure.rows()) continue;
    double const excess = excess_of_F(*classes, objects);
    if (largest && excess <= *largest) continue;
    largest = excess;
    best = *classes;
  }
  return best;
}

Selection select_by_grey_fuzzy_clustering(std::span<Batch const> batches, SelectionOptions const& options) {
  auto const from = candidates(batches, options);
  require_error_that_moves(from);
  auto const& rise = from.all.temperature_rise;
  VectorXd const grades = grey_relational_grades(rise, from.all.error, {.align_signs = true});
  MatrixXd const closure = transitive_closure(correlation_similarity(rise));

  MatrixXd objects = unit_columns(rise).transpose();
  VectorXd const with_error = objects * from.all.error;
  for (Index i = 0; i < objects.rows(); ++i)
    if (with_error(i) < 0) objects.row(i) *= -1;
  auto const classes = options.count ? classes_nearest(closure, *options.count) : classes_by_F(closure, objects);

  std::vector<Index> chosen;
  for (auto const& members : classes) chosen.push_back(best(grades, members));
  chosen = ranked(grades, chosen);
  auto remark = fmt::format("{} classes by {}", classes.size(), options.count ? "count" : "F");
  if (options.count && std::ssize(classes) != *options.count) {
    remark += fmt::format(", the nearest to {} that a level gives; the rest by grade", *options.count);
    chosen = completed(chosen, *options.count, grades);
  }
  return selection(from, chosen, grades, remark);
}

}  // namespace thermotwin::models
