#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

namespace thermotwin::models {

/// Sensors that could be had, and what they shall tell. Readings x of n sites and d quantities y that nobody can
/// measure while it matters vary together, as their covariances say; a sensor has an error of its own besides,
/// independent of all others:
///
///   V(A) = tr(S_yy − S_yA (S_AA + R_A)⁻¹ S_Ay)
///
/// is what the best linear estimate of y from the sensors A leaves unknown, for Gaussian variables the trace of the
/// posterior covariance: A-optimality of Bayesian design (Chaloner and Verdinelli, Stat. Sci. 10 (1995) 273).
struct PlacementProblem {
  Eigen::MatrixXd readings;                                 ///< S_xx, n × n, without the sensors' own errors [K²]
  Eigen::MatrixXd cross;                                    ///< S_xy, n × d [K µm]
  double prior = 0.0;                                       ///< tr S_yy [µm²]
  Eigen::VectorXd noise;                                    ///< R, n: variances of the sensors' own errors, > 0 [K²]
  Eigen::VectorXd cost;                                     ///< n, > 0; empty: all 1
  double budget = std::numeric_limits<double>::infinity();  ///< for the sum of the costs of the chosen sites

  [[nodiscard]] Eigen::Index sites() const { return readings.rows(); }
  [[nodiscard]] double cost_of(Eigen::Index site) const { return cost.size() == 0 ? 1.0 : cost[site]; }
};

/// Throws std::invalid_argument with a sentence: sizes that differ, a noise or cost that is not positive, no site.
void check(PlacementProblem const& problem);

/// V of a growing set. With x_i's variance v_i and covariance c_i with y, both given the sensors so far,
///
///   V(A ∪ i) = V(A) − |c_i|² / (v_i + r_i);
///
/// one more sensor is a rank-one update of all v and c, O(n (k + d)).
class RemainingVariance {
 public:
  /// Room for `most` sensors.
  RemainingVariance(PlacementProblem const& problem, Eigen::Index most);

  void add(Eigen::Index site);
  [[nodiscard]] double value() const { return value_; }
  /// By how much one more sensor at each site would lessen V; −1 where there is one.
  [[nodiscard]] Eigen::VectorXd const& gains() const { return gains_; }

 private:
  void find_gains();

  PlacementProblem const* problem_;
  Eigen::VectorXd variance_;
  Eigen::MatrixXd cross_, factor_;  ///< factor: n × k, rows of L⁻¹ S_Ax, transposed
  std::vector<Eigen::Index> sensors_;
  Eigen::VectorXd gains_;
  double value_;
};

/// V(A).
[[nodiscard]] double remaining_variance(PlacementProblem const& problem, std::span<Eigen::Index const> sensors);

/// (S_AA + R_A)⁻¹ S_Ay: what the readings' departures from their mean are multiplied by, k × d [µm/K].
[[nodiscard]] Eigen::MatrixXd estimator(PlacementProblem const& problem, std::span<Eigen::Index const> sensors);

}  // namespace thermotwin::models
