#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "twin/diagnosis/estimation.h"

namespace thermotwin::twin {

/// Where heat that nobody knows may enter: a body, or a third of one of many cells, evenly over its capacity. Or all
/// that the room's air meets, which is not as warm as its record: no nodes, and the body that takes up most.
struct HeatSite {
  std::string body;
  int first_node = 0, nodes = 1;
  [[nodiscard]] bool is_air() const { return nodes == 0; }
};

[[nodiscard]] std::vector<HeatSite> heat_sites(Machine const& machine);

/// A mean and its whole_error() [W].
struct Watts {
  double mean = 0.0, standard_error = 0.0;
};

/// Heat of unknown course into one site (physics.md 8.3): straight lines between knots, a random walk from knot to
/// knot,
///
///   q_0 ~ N(0, σ_0²),  q_{k+1} − q_k ~ N(0, S² Δt),  Δt of a jump of the inputs: 4 h,
///
/// on top of everything that the fit could still change by its own unknowns. σ_0 and S by evidence. Air walks likewise,
/// its kelvins for 100 W.
struct FreeHeat {
  HeatSite site;
  double gain = 0.0;                   ///< 2 ln of the evidence against no such heat
  std::vector<Eigen::VectorXd> knots;  ///< per run [s]
  std::vector<Eigen::VectorXd> heat;   ///< per run, at the knots [W]
  /// What is not known of it, as a sum of independent parts of deviation 1: (knots of all runs) × part [W].
  Eigen::MatrixXd spread;
  /// Of the air: what every body takes up per kelvin, a mean over all runs [W/K].
  std::map<std::string, double> per_kelvin;
  /// Bodies that receive it, in shares of what the site's does.
  [[nodiscard]] std::map<std::string, double> shares() const;
  /// Of the heat at the knots of one run [W].
  [[nodiscard]] Eigen::VectorXd standard_error(std::size_t run) const;
  /// Over the time of all runs.
  [[nodiscard]] Watts mean_of_all() const;
};

/// Every site as the place of such heat, best first, from one linearisation about a fit. Knots besides those at jumps:
/// so many in half a day, or in a run that is longer.
[[nodiscard]] std::vector<FreeHeat> scan_for_free_heat(Estimation const& estimation, Fit const& fit, int knots = 24);

/// Of the bodies between which an effect of a fit moves heat, the one that gets most for its heat capacity: what
/// radiates to a test bar from a column is seen at the bar.
[[nodiscard]] std::string warmed_most(Estimation const& amended, Fit const& fit, std::size_t effect);

/// What the effects of a fit bring into one body, at its temperatures; errors are those of their amplitudes.
[[nodiscard]] FreeHeat heat_of_effects(Estimation const& amended, Fit const& fit, std::string const& body);

/// Such heat at each speed of the spindle, and how far it is from that otherwise.
struct HeatBySpeed {
  std::vector<std::pair<std::string, Watts>> mean;  ///< regimes.h, speed_regimes; over all runs
  double swing = 0.0;                               ///< root mean square about these means [W]
};
[[nodiscard]] HeatBySpeed heat_by_speed(FreeHeat const& heat, std::vector<BinnedRun> const& data);

/// While the machine moves and while it stands, in one run.
[[nodiscard]] LinearisedRun::MeanHeat mean_heat(FreeHeat const& heat, std::size_t run, BinnedRun const& data);

}  // namespace thermotwin::twin
