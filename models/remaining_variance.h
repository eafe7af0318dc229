#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

namespace thermotwin::models {

/// How readings x of n sites and d quantities y vary together.
struct JointCovariance {
  Eigen::MatrixXd readings;  ///< S_xx, n × n, without the sensors' own errors [K²]
  Eigen::MatrixXd cross;     ///< S_xy, n × d [K µm]
  double prior = 0.0;        ///< tr S_yy [µm²]
};

/// Sensors that could be had, and what they shall tell of quantities that nobody can measure while it matters. It will
/// be known which of m worlds is the true one, all equally likely, when the readings are made something of; a sensor
/// has an error of its own besides, independent of all others:
///
///   V(A) = 1/m Σ_w tr(S_yy − S_yA (S_AA + R_A)⁻¹ S_Ay)_w
///
/// is what the best linear estimates of y from the sensors A leave unknown, for Gaussian variables the trace of the
/// posterior covariance: A-optimality of Bayesian design (Chaloner and Verdinelli, Stat. Sci. 10 (1995) 273).
struct PlacementProblem {
  std::vector<JointCovariance> worlds;                      ///< m ≥ 1, of the same sites and quantities
  Eigen::VectorXd noise;                                    ///< R, n: variances of the sensors' own errors, > 0 [K²]
  Eigen::VectorXd cost;                                     ///< n, > 0; empty: all 1
  double budget = std::numeric_limits<double>::infinity();  ///< for the sum of the costs of the chosen sites

  [[nodiscard]] Eigen::Index sites() const { return noise.size(); }
  [[nodiscard]] double prior() const;  ///< V of no sensor
  [[nodiscard]] double cost_of(Eigen::Index site) const { return cost.size() == 0 ? 1.0 : cost[site]; }
};

/// Throws std::invalid_argument with a sentence: sizes that differ, a noise or cost that is not positive, no site.
void check(PlacementProblem const& problem);

/// V of a growing set. With x_i's variance v_i and covariance c_i with y, both given the sensors so far,
///
///   V(A ∪ i) = V(A) − |c_i|² / (v_i + r_i), the mean over the worlds;
///
/// one more sensor is a rank-one update of all v and c, O(m n (k + d)).
class RemainingVariance {
 public:
  /// Room for `most` sensors.
  RemainingVariance(PlacementProblem const& problem, Eigen::Index most);

  void add(Eigen::Index site);
  [[nodiscard]] double value() const { return value_; }
  /// By how much one more sensor at each site would lessen V; −1 where there is one.
  [[nodiscard]] Eigen::VectorXd const& gains() const { return gains_; }

 private:
  /// Of one world.
  struct World {
    JointCovariance const* prior;
    Eigen::VectorXd variance;
    Eigen::MatrixXd cross, factor;  ///< factor: n × k, rows of L⁻¹ S_Ax, transposed

    /// Returns by how much it lessens V there.
    double add(Eigen::Index site, Eigen::Index sensors, double noise);
  };
  void find_gains();

  PlacementProblem const* problem_;
  std::vector<World> worlds_;
  std::vector<Eigen::Index> sensors_;
  Eigen::VectorXd gains_;
  double value_;
};

/// V(A).
[[nodiscard]] double remaining_variance(PlacementProblem const& problem, std::span<Eigen::Index const> sensors);

}  // namespace thermotwin::models
