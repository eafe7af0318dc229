#include "twin/volumetric/identification.h"

#include <Eigen/QR>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <fmt/format.h>

namespace thermotwin::twin {
namespace {

constexpr int unknowns = 14;
constexpr double rare = 1e-3;
constexpr double least_noise = 10e-9;

/// m: increments per diagonal; axis × segment.
std::array<Eigen::Matrix3Xd, 4> increments(StepDiagonals const& measured) {
  std::array<Eigen::Matrix3Xd, 4> result;
  int const n = measured.steps;
  for (int k = 0; k < 4; ++k) {
    auto const& errors = measured.errors[std::size_t(k)];
    auto& own = result[std::size_t(k)];
    own.resize(3, n);
    Eigen::Vector3d const signs = diagonal_signs(k);
    for (int i = 0; i < n; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        int const stop = 3 * i + axis + 1, segment = signs[axis] > 0 ? i : n - 1 - i;
        own(axis, segment) = errors[stop] - errors[stop - 1];
      }
  }
  return result;
}

double by_chance(double sum_of_squares, double variance, double degrees) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(degrees), sum_of_squares / variance));
}

/// Rows M_{k,r}: coefficients of S (xx, yy, zz, xy, xz, yz) and of the two misalignments of each diagonal.
class JointEquations {
 public:
  explicit JointEquations(StepDiagonals const& measured, Eigen::Vector3d const& totals, double linear_noise)
      : travel_(measured.workspace.travel()) {
    // A total is the sum of n increments: 2n readings of noise σ.
    double const diagonal_noise = measured.noise * std::sqrt(2.0 * measured.steps);
    bool const weighted = diagonal_noise > 0.0 && linear_noise > 0.0;
    auto const steps = increments(measured);
    for (int k = 0; k < 4; ++k)
      for (int axis = 0; axis < 3; ++axis)
        add_diagonal(k, axis, measured.workspace, steps[std::size_t(k)].row(axis).sum(),
                     weighted ? 1.0 / diagonal_noise : 1.0);
    for (int axis = 0; axis < 3; ++axis) {
      double const weight = weighted ? 1.0 / linear_noise : 1.0;
      matrix_(row_, axis) = weight * travel_[axis];
      right_[row_++] = weight * totals[axis];
    }
  }

  [[nodiscard]] Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors() const {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix_);
    qr.setThreshold(1e-10);
    return qr;
  }
  [[nodiscard]] Eigen::VectorXd const& right() const { return right_; }

 private:
  void add_diagonal(int k, int axis, Workspace const& workspace, double total, double weight) {
    Eigen::Vector3d const u = diagonal_direction(k, workspace);
    Eigen::Vector3d const first = u.unitOrthogonal(), second = u.cross(first);
    double const factor = weight * diagonal_signs(k)[axis] * travel_[axis];
    constexpr std::array<std::array<int, 3>, 3> strain = {{{0, 3, 4}, {3, 1, 5}, {4, 5, 2}}};
    for (int i = 0; i < 3; ++i) matrix_(row_, strain[std::size_t(i)][std::size_t(axis)]) = factor * u[i];
    matrix_(row_, 6 + 2 * k) = factor * first[axis];
    matrix_(row_, 7 + 2 * k) = factor * second[axis];
    right_[row_++] = weight * total;
  }

  Eigen::Vector3d travel_;
  Eigen::MatrixXd matrix_ = Eigen::MatrixXd::Zero(15, unknowns);
  Eigen::VectorXd right_ = Eigen::VectorXd::Zero(15);
  int row_ = 0;
};

}  // namespace

double Closure::rms() const { return std::sqrt(residuals.squaredNorm() / double(residuals.size())); }

double Closure::mean_by_chance() const {
  double const n = double(residuals.cols());
  return by_chance(n * residuals.rowwise().mean().squaredNorm(), noise * noise, 3.0);
}

double Closure::change_by_chance() const {
  double const sum = (residuals.colwise() - residuals.rowwise().mean()).squaredNorm();
  return by_chance(sum, noise * noise, 3.0 * double(residuals.cols() - 1));
}

PlainIdentification identify_plain(StepDiagonals const& measured) {
  auto const m = increments(measured);
  Eigen::Vector3d const cosines = measured.workspace.travel().normalized();
  PlainIdentification result;
  result.functions.workspace = measured.workspace;
  result.closure.residuals = Eigen::Matrix3Xd::Zero(3, measured.steps);
  result.closure.noise = std::sqrt(8.0) * std::max(measured.noise, least_noise);
  for (int axis = 0; axis < 3; ++axis) {
    auto& own = result.functions.values[std::size_t(axis)];
    own = Eigen::Matrix3Xd::Zero(3, measured.steps + 1);
    for (int k = 0; k < 4; ++k) {
      Eigen::Vector3d const signs = diagonal_signs(k);
      auto const row = m[std::size_t(k)].row(axis);
      own.rightCols(measured.steps) += (signs[axis] * signs.array() / (4.0 * cosines.array())).matrix() * row;
      result.closure.residuals.row(axis) += signs.prod() / signs[axis] * row;
    }
    for (int j = 1; j <= measured.steps; ++j) own.col(j) += own.col(j - 1);
  }
  return result;
}

JointIdentification identify_jointly(StepDiagonals const& measured, Eigen::Vector3d const& linear_totals,
                                     double linear_noise) {
  JointIdentification result{identify_plain(measured).functions, 0, {}};
  JointEquations const equations(measured, linear_totals, linear_noise);
  auto const factors = equations.factors();
  result.rank = int(factors.rank());
  Eigen::VectorXd const x = factors.solve(equations.right());
  Eigen::Matrix3d strain;
  strain << x[0], x[3], x[4], x[3], x[1], x[5], x[4], x[5], x[2];
  for (int axis = 0; axis < 3; ++axis) {
    auto& own = result.functions.values[std::size_t(axis)];
    Eigen::Vector3d const change = measured.workspace.travel()[axis] * strain.col(axis) - own.col(measured.steps);
    own += change * Eigen::RowVectorXd::LinSpaced(measured.steps + 1, 0.0, 1.0);
  }
  for (int k = 0; k < 4; ++k) {
    Eigen::Vector3d const u = diagonal_direction(k, measured.workspace), first = u.unitOrthogonal();
    result.misalignment[std::size_t(k)] = x[6 + 2 * k] * first + x[7 + 2 * k] * u.cross(first);
  }
  return result;
}

std::vector<std::string> limits(Closure const& closure) {
  std::vector<std::string> found;
  double const mean = closure.residuals.rowwise().mean().norm() / std::sqrt(3.0);
  if (closure.mean_by_chance() < rare)
    found.push_back(
        fmt::format("the closures have a mean of {:.2f} µm per step (laser noise alone: {:.2f}): mirrors "
                    "not square to their diagonals, or angular errors; the plain identification takes them "
                    "for squareness and scale",
                    1e6 * mean, 1e6 * closure.noise / std::sqrt(double(closure.residuals.cols()))));
  double const change = std::sqrt((closure.residuals.colwise() - closure.residuals.rowwise().mean()).squaredNorm() /
                                  double(closure.residuals.size()));
  if (closure.change_by_chance() < rare)
    found.push_back(
        fmt::format("the closures change along the axes (rms {:.2f} µm, laser noise alone: {:.2f}): "
                    "angular errors, which nine functions cannot represent off the diagonals",
                    1e6 * change, 1e6 * closure.noise));
  return found;
}

}  // namespace thermotwin::twin
