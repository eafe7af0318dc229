#include "twin/diagnosis/jumping_sensor.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <string>
#include <vector>

#include "models/quantile.h"

namespace thermotwin::twin {
namespace {

constexpr double least_off = 0.3;  // [K]
constexpr Eigen::Index side = 3;   // rows on each side whose median is where a reading stands
constexpr Eigen::Index turn = 1;   // rows that it may take

/// A step of a sensor's residual between two rows.
struct Jump {
  std::string sensor, run;
  double time = 0.0;       ///< [s]
  double by = 0.0;         ///< [K]
  double statistic = 0.0;  ///< T
};

double median(Eigen::VectorXd const& values) { return models::upper_median({values.begin(), values.end()}); }

/// How much higher a residual stands after a row than before the one before it.
double step_at(Eigen::VectorXd const& residual, Eigen::Index row) {
  return median(residual.segment(row + turn, side)) - median(residual.segment(row - turn - side, side));
}

/// The clearest one of a sensor in a run; T 0: none. `residual`: NaN where nothing was measured.
Jump clearest(Eigen::VectorXd const& residual, Whitening const& whitening, Eigen::VectorXd const& time) {
  std::vector<Eigen::Index> measured;
  for (Eigen::Index row = 0; row < residual.size(); ++row)
    if (!std::isnan(residual[row])) measured.push_back(row);
  auto const count = Eigen::Index(measured.size());
  Eigen::VectorXd const shown = residual(measured);
  Eigen::MatrixXd white = residual, steps = Eigen::MatrixXd::Zero(residual.size(), count);
  for (Eigen::Index k = 0; k < count; ++k) steps.col(k).tail(residual.size() - measured[std::size_t(k)]).setOnes();
  whitening.apply(white);
  whitening.apply(steps);
  Jump best;
  for (Eigen::Index k = side + turn; k + turn + side <= count; ++k) {
    double const information = steps.col(k).squaredNorm(), b = steps.col(k).dot(white.col(0));
    double const statistic = b * b / information, by = step_at(shown, k);
    if (statistic > best.statistic && std::abs(by) >= least_off)
      best = {{}, {}, time[measured[std::size_t(k)]], by, statistic};
  }
  return best;
}

/// Of sensors that touch something.
std::set<std::string> on_bodies(Machine const& machine) {
  std::set<std::string> names;
  for (auto const& sensor : machine.sensors)
    if (!sensor.weights.empty()) names.insert(sensor.description.name);
  return names;
}

}  // namespace

std::optional<FaultySensor> jumping_sensor(Machine const& machine, Estimation const& estimation, Fit const& calibrated,
                                           double threshold) {
  auto const residuals = estimation.residuals_at(calibrated.x);
  auto const& known = estimation.channels();
  auto const asked = on_bodies(machine);
  std::vector<Jump> jumps;
  double moments = 0.0;
  for (std::size_t r = 0; r < residuals.size(); ++r) {
    auto const& run = estimation.data()[r];
    for (Eigen::Index c = 0; c < residuals[r].cols(); ++c) {
      auto const& channel = run.run->channels[std::size_t(c)].name;
      if (!asked.contains(channel)) continue;
      auto const& noise =
          estimation.noise()[std::size_t(std::find(known.begin(), known.end(), channel) - known.begin())];
      Jump jump = clearest(residuals[r].col(c), whitening_of(noise, run, c), run.time);
      jump.sensor = channel;
      jump.run = run.run->name;
      jumps.push_back(jump);
      moments += double(residuals[r].rows());
    }
  }
  std::erase_if(jumps, [&](Jump const& jump) { return jump.statistic < threshold + 2.0 * std::log(moments); });
  if (jumps.empty()) return std::nullopt;
  auto const& most = *std::max_element(jumps.begin(), jumps.end(),
                                       [](Jump const& a, Jump const& b) { return a.statistic < b.statistic; });
  if (std::any_of(jumps.begin(), jumps.end(), [&](Jump const& jump) { return jump.sensor != most.sensor; }))
    return std::nullopt;
  return FaultySensor{most.sensor,
                      fmt::format("jumps by {:.1f} K at {:.1f} h of {} and stays off, though what it touches "
                                  "does not",
                                  most.by, most.time / 3600.0, most.run)};
}

}  // namespace thermotwin::twin
