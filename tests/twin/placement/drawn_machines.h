#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "models/placement.h"
#include "models/selection.h"
#include "tests/twin/random_machine.h"
#include "twin/machine.h"
#include "twin/placement/ensemble.h"
#include "twin/placement/snapshot_moments.h"

namespace thermotwin::twin {

/// A machine with its sites and two ensembles that share no member and no spectrum: what a placement is tried on.
struct DrawnMachines {
  static constexpr double noise = 0.1;  ///< of each sensor [K]

  Value document;
  std::vector<CandidateSite> sites;
  Ensemble design, unseen;

  DrawnMachines(Value given, CandidateRules const& rules, int members, int others, int spares = 0)
      : document(std::move(given)), sites(with_spares(candidate_sites(document, rules), spares)) {
    EnsembleOptions options;
    options.members = members;
    design = draw_ensemble(document, sites, options);
    if (others == 0) return;
    options.members = others;
    options.first_member = 1'000'000;
    unseen = draw_ensemble(document, sites, options);
  }
  [[nodiscard]] SnapshotMoments moments(Teacher teacher = Teacher::family) const { return {design, noise, teacher}; }
  [[nodiscard]] models::PlacementProblem problem(Teacher teacher = Teacher::family) const {
    return moments(teacher).problem(Eigen::Index(sites.size()));
  }
  /// Of the machines that took no part [um].
  [[nodiscard]] double unseen_error(std::vector<Eigen::Index> const& set, Teacher teacher = Teacher::family) const {
    return std::sqrt(moments(teacher).unseen(unseen, set).mean_square.sum());
  }
};

/// Of a RandomMachine: a site on every lump.
inline DrawnMachines drawn_at_random(RandomMachine const& machine, int members, int others, int spares = 0) {
  CandidateRules rules;
  for (auto const& body : machine.bodies()) rules.sites.push_back({body, {body}});
  return {parse_toml(machine.text(), "random"), rules, members, others, spares};
}

/// Of a machine that is shipped.
inline DrawnMachines drawn_as_shipped(std::string const& name, int members, int others, int spares = 0) {
  CandidateRules rules;
  if (name.starts_with("v450")) rules.forbidden = {"rotor"};
  return {read_toml(machine_file(name)), rules, members, others, spares};
}

/// What another method chooses, of the displacement with the largest variance; `centred`: given every machine's
/// departures from its own mean, so that what machines differ by does not mislead it.
inline std::vector<Eigen::Index> chosen_by(std::string const& method, DrawnMachines const& machines, int count,
                                           bool centred = false) {
  Eigen::MatrixXd rise = machines.design.rise, displacement = machines.design.displacement;
  auto const groups = machines.moments(centred ? Teacher::machine : Teacher::family).groups();
  for (auto const& [first, rows] : groups) {
    rise.middleRows(first, rows).rowwise() -= rise.middleRows(first, rows).colwise().mean().eval();
    displacement.middleRows(first, rows).rowwise() -= displacement.middleRows(first, rows).colwise().mean().eval();
  }
  models::Batch batch;
  batch.name = "ensemble";
  batch.time = Eigen::VectorXd::LinSpaced(rise.rows(), 0.0, double(rise.rows() - 1));
  Eigen::Index largest = 0;
  displacement.colwise().squaredNorm().maxCoeff(&largest);
  batch.temperature_rise = std::move(rise);
  batch.error = displacement.col(largest);
  for (auto const& site : machines.sites) {
    batch.sensors.push_back(site.name);
    batch.components.emplace_back("machine");
  }
  models::SelectionOptions options;
  options.count = count;
  return models::selection_method(method).select({&batch, 1}, options).sensors;
}

/// Errors of six sensors on unseen machines over those of six that other methods choose, machine by machine; all sets
/// get the same estimator.
struct ErrorRatios {
  std::vector<double> to_pivots, to_groups;

  /// Each of the machines is taught by itself, one of its spectra, and judged by the other; `centred` as chosen_by's.
  void add_trained(DrawnMachines const& machines, bool centred = false) {
    auto const error = [&](auto const& set) { return machines.unseen_error(set, Teacher::machine); };
    double const ours = error(models::place(machines.problem(Teacher::machine), 6).sensors);
    to_pivots.push_back(ours / error(chosen_by("qr_pivot", machines, 6, centred)));
    to_groups.push_back(ours / error(chosen_by("correlation_grouping", machines, 6, centred)));
  }
};

/// Least variance of all sets of 1 to 6 sites over that of the sets found.
inline std::vector<double> shares_of_optimum(models::PlacementProblem const& problem) {
  std::vector<double> shares;
  for (Eigen::Index count = 1; count <= 6; ++count)
    shares.push_back(models::exhaustive_placement(problem, count).variance / models::place(problem, count).variance);
  return shares;
}

/// Error √V of a placement whose worst two sensors are dead over that of all.
inline double worst_over_intact(models::PlacementProblem const& problem, models::Placement const& placement) {
  return std::sqrt(models::worst_variance(problem, placement.sensors, 2) / placement.variance);
}

/// Variance that is foretold of the recommended six over that on machines that took no part.
inline double predicted_over_realised(DrawnMachines const& machines, Teacher teacher) {
  auto const set = models::place(machines.problem(teacher), 6).sensors;
  return machines.moments(teacher).cross_validated(set).mean_square.sum() /
         std::pow(machines.unseen_error(set, teacher), 2);
}

inline double share_below(std::vector<double> const& values, double limit) {
  return double(std::count_if(values.begin(), values.end(), [&](double x) { return x <= limit; })) /
         double(values.size());
}

}  // namespace thermotwin::twin
