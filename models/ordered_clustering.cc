#include "models/ordered_clustering.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

#include "models/ranking.h"

namespace thermotwin::models {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Sums that differ by less, relative to ψ*(1, l), are equal: rounding breaks no tie.
constexpr double tie_below = 1e-12;

MatrixXd ranged(MatrixXd const& x) {
  VectorXd const least = x.colwise().minCoeff();
  VectorXd const range = x.colwise().maxCoeff().transpose() - least;
  MatrixXd z = x.rowwise() - least.transpose();
  for (Index i = 0; i < z.cols(); ++i)
    if (range(i) > 0) z.col(i) /= range(i);
  return z;
}

MatrixXd scored(MatrixXd const& x) {
  MatrixXd z = x.rowwise() - x.colwise().mean();
  for (Index i = 0; i < z.cols(); ++i) z.col(i) /= z.col(i).norm() / std::sqrt(static_cast<double>(z.rows()));
  return z;
}

/// Objects × instants, without the instants at which all objects are the same.
MatrixXd with_range(MatrixXd const& temperature_rise) {
  std::vector<Index> kept;
  for (Index i = 0; i < temperature_rise.rows(); ++i)
    if (temperature_rise.row(i).maxCoeff() > temperature_rise.row(i).minCoeff()) kept.push_back(i);
  return temperature_rise(kept, Eigen::all).transpose();
}

}  // namespace

MatrixXd normalised(MatrixXd const& temperature_rise, Normalisation how) {
  MatrixXd const objects = with_range(temperature_rise);
  switch (how) {
    case Normalisation::across_sensors:
      return ranged(objects);
    case Normalisation::over_time:
      return ranged(objects.transpose()).transpose();
    case Normalisation::z_score:
      return scored(objects);
  }
  throw std::logic_error("a normalisation without its formula");
}

std::vector<Index> ascending(MatrixXd const& temperature_rise) {
  return ranked(-temperature_rise.colwise().mean().transpose(), first_numbers(temperature_rise.cols()));
}

MatrixXd class_diameters(MatrixXd const& objects) {
  Index const count = objects.rows();
  MatrixXd diameters = MatrixXd::Zero(count, count);
  for (Index a = 0; a < count; ++a) {
    VectorXd mean = objects.row(a);
    for (Index c = a + 1; c < count; ++c) {
      VectorXd const away = objects.row(c).transpose() - mean;
      auto const size = static_cast<double>(c - a + 1);
      mean += away / size;
      diameters(a, c) = diameters(a, c - 1) + away.squaredNorm() * (size - 1) / size;
    }
  }
  return diameters;
}

OrderedPartitions::OrderedPartitions(MatrixXd const& diameters)
    : loss_(diameters.rows()), last_begin_(Eigen::MatrixXi::Zero(diameters.rows(), diameters.rows())) {
  if (diameters.rows() == 0 || diameters.rows() != diameters.cols())
    throw std::invalid_argument(fmt::format("diameters of {} by {}", diameters.rows(), diameters.cols()));
  Index const count = diameters.rows();
  double const tie = tie_below * diameters(0, count - 1);
  VectorXd before = diameters.row(0);  // ψ*(k − 1, m + 1) at index m
  loss_(0) = before(count - 1);
  for (Index k = 1; k < count; ++k) {
    VectorXd now = VectorXd::Constant(count, std::numeric_limits<double>::infinity());
    for (Index m = k; m < count; ++m)
      for (Index j = k; j <= m; ++j)
        if (double const sum = before(j - 1) + diameters(j, m); sum < now(m) - tie) {
          now(m) = sum;
          last_begin_(k, m) = static_cast<int>(j);
        }
    loss_(k) = now(count - 1);
    before = now;
  }
}

std::vector<std::vector<Index>> OrderedPartitions::classes(int k) const {
  if (k < 1 || k > loss_.size())
    throw std::invalid_argument(fmt::format("{} classes of {} objects: 1 to {}", k, loss_.size(), loss_.size()));
  std::vector<std::vector<Index>> classes(static_cast<std::size_t>(k));
  Index end = loss_.size();
  for (int c = k - 1; c >= 0; --c) {
    Index const begin = last_begin_(c, end - 1);
    for (Index i = begin; i < end; ++i) classes[static_cast<std::size_t>(c)].push_back(i);
    end = begin;
  }
  return classes;
}

}  // namespace thermotwin::models
