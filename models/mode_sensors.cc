#include "models/mode_sensors.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <stdexcept>

#include "models/candidates.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// What a shape at the sensors differs from those of other modes, of 1: with less, its amplitude multiplies the
/// readings' errors by more than ten.
constexpr double least_difference = 0.1;

/// Of sensors at the same place, one.
std::vector<Index> places_of(MatrixXd const& shapes) {
  std::vector<Index> places;
  for (Index i = 0; i < shapes.rows(); ++i)
    if (std::none_of(places.begin(), places.end(), [&](Index p) { return shapes.row(p) == shapes.row(i); }))
      places.push_back(i);
  return places;
}

/// The modes that sensors there tell apart, slowest first.
MatrixXd told_apart(MatrixXd const& shapes) {
  MatrixXd unit = shapes(places_of(shapes), Eigen::all);
  for (auto column : unit.colwise()) column.normalize();
  Eigen::ColPivHouseholderQR<MatrixXd> factors;
  factors.setThreshold(least_difference);
  factors.compute(unit);
  auto const& order = factors.colsPermutation().indices();
  std::vector<Index> modes(order.begin(), order.begin() + factors.rank());
  std::sort(modes.begin(), modes.end());
  return shapes(Eigen::all, modes);
}

MatrixXd shapes_at(Candidates const& from, MatrixXd const& shapes) {
  if (shapes.rows() != from.sensors || shapes.cols() == 0)
    throw std::invalid_argument(fmt::format(
        "the mode shapes are {} × {}; thermal modes need a row for each of the {} sensors and a column for each mode",
        shapes.rows(), shapes.cols(), from.sensors));
  if (!shapes.allFinite()) throw std::invalid_argument("a mode shape has a value that is no number");
  MatrixXd const distinct = told_apart(shapes(from.columns, Eigen::all));
  if (distinct.cols() == 0) throw std::invalid_argument("no sensor sees any thermal mode");
  return distinct;
}

/// Rows of W that are pivots above `least`, in the order of pivoting.
std::vector<Index> spanning_rows(MatrixXd const& W, std::vector<Index> const& rows, double least) {
  Eigen::ColPivHouseholderQR<MatrixXd> const factors(W(rows, Eigen::all).transpose());
  std::vector<Index> pivots;
  for (Index i = 0; i < std::min<Index>(W.cols(), static_cast<Index>(rows.size())); ++i)
    if (std::abs(factors.matrixQR()(i, i)) > least)
      pivots.push_back(rows[static_cast<std::size_t>(factors.colsPermutation().indices()(i))]);
  return pivots;
}

/// All rows, round after round.
std::vector<Index> pivot_rounds(MatrixXd const& W, double least) {
  std::vector<Index> rest(static_cast<std::size_t>(W.rows())), order;
  std::iota(rest.begin(), rest.end(), 0);
  while (!rest.empty()) {
    auto round = spanning_rows(W, rest, least);
    if (round.empty()) round = rest;
    for (auto row : round) std::erase(rest, row);
    order.insert(order.end(), round.begin(), round.end());
  }
  return order;
}

}  // namespace

ModeParticipation participation(MatrixXd const& mode_shapes, MatrixXd const& temperature_rise,
                                Eigen::VectorXd const& error) {
  Eigen::VectorXd const lengths = mode_shapes.colwise().norm();
  MatrixXd const unit = mode_shapes.colwise().normalized();
  MatrixXd const readings = centred(temperature_rise);
  MatrixXd const amplitude = unit.completeOrthogonalDecomposition().solve(readings.transpose()).transpose();
  Eigen::VectorXd const deviation =
      amplitude.colwise().norm() / std::sqrt(static_cast<double>(std::max<Index>(readings.rows() - 1, 1)));
  Eigen::VectorXd const centred_error = error.array() - error.mean();
  if (centred_error.norm() == 0) return {deviation, Eigen::VectorXd::Ones(deviation.size())};
  return {deviation, amplitude.colwise().normalized().transpose() * centred_error.normalized()};
}

Selection select_for_modes(std::span<Batch const> batches, SelectionOptions const& options) {
  auto const from = candidates(batches, options);
  MatrixXd const shapes = shapes_at(from, options.mode_shapes);
  auto const share = participation(shapes, from.all.temperature_rise, from.all.error);
  MatrixXd const W =
      shapes.colwise().normalized() * share.deviation.cwiseProduct(share.correlation.cwiseAbs()).asDiagonal();
  double const least = std::max(options.resolution / std::sqrt(12.0), 1e-9 * W.norm());
  auto order = pivot_rounds(W, least);
  std::vector<Index> all(static_cast<std::size_t>(from.count()));
  std::iota(all.begin(), all.end(), 0);
  auto const seen = std::max<std::size_t>(spanning_rows(W, all, least).size(), 1);
  order.resize(options.count ? static_cast<std::size_t>(*options.count) : seen);
  return selection(
      from, order, W.rowwise().norm(),
      fmt::format("{} of {} thermal modes that the sensors tell apart stand above the rounding of the readings", seen,
                  W.cols()));
}

}  // namespace thermotwin::models
