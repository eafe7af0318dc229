#include "models/mode_sensors.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

#include "models/candidates.h"
#include "models/placement.h"

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

/// What the modes make of the readings, and what that has to do with the error, or with the amplitudes.
PlacementProblem problem_of(MatrixXd const& shapes, Batch const& all, double resolution) {
  MatrixXd const unit = shapes.colwise().normalized(), readings = centred(all.temperature_rise);
  MatrixXd const amplitude = unit.completeOrthogonalDecomposition().solve(readings.transpose()).transpose();
  MatrixXd const error = centred(all.error), asked = error.norm() > 0 ? error : amplitude;
  auto const degrees = static_cast<double>(std::max<Index>(readings.rows() - 1, 1));
  PlacementProblem problem;
  problem.worlds.push_back({unit * (amplitude.transpose() * amplitude) * unit.transpose() / degrees,
                            unit * (amplitude.transpose() * asked) / degrees, asked.squaredNorm() / degrees});
  double const rounding = std::max(resolution * resolution / 12.0, 1e-12 * readings.squaredNorm() / degrees);
  problem.noise = Eigen::VectorXd::Constant(readings.cols(), rounding);
  return problem;
}

/// How many movements of the readings stand above their rounding; at least one.
Index movements(PlacementProblem const& problem) {
  Eigen::SelfAdjointEigenSolver<MatrixXd> const solver(problem.worlds.front().readings, Eigen::EigenvaluesOnly);
  return std::max<Index>((solver.eigenvalues().array() > problem.noise[0]).count(), 1);
}

/// The same places, each with the first sensors there: what the modes know of these is the same, and rounding decides
/// nothing.
std::vector<Index> first_at_their_places(MatrixXd const& shapes, std::vector<Index> const& chosen) {
  std::vector<Index> firsts;
  for (Index const sensor : chosen) {
    Index first = 0;
    while (shapes.row(first) != shapes.row(sensor) || std::find(firsts.begin(), firsts.end(), first) != firsts.end())
      ++first;
    firsts.push_back(first);
  }
  return firsts;
}

}  // namespace

Selection select_for_modes(std::span<Batch const> batches, SelectionOptions const& options) {
  auto const from = candidates(batches, options);
  MatrixXd const shapes = shapes_at(from, options.mode_shapes);
  auto const problem = problem_of(shapes, from.all, options.resolution);
  Index const seen = movements(problem);
  auto const chosen = place(problem, options.count.value_or(static_cast<int>(seen))).sensors;
  return selection(
      from, first_at_their_places(shapes, chosen), RemainingVariance(problem, 1).gains(),
      fmt::format("{} of {} thermal modes that the sensors tell apart stand above the rounding of the readings", seen,
                  shapes.cols()));
}

}  // namespace thermotwin::models
