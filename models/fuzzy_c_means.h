#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <mutex>
#include <vector>

namespace thermotwin::models {

struct FuzzyOptions {
  double exponent = 2;      ///< m > 1
  double tolerance = 1e-5;  ///< largest change of a membership at which an iteration ends
  int iterations = 300;
  int starts = 20;  ///< from different points as first centres; that of least J is kept
  std::uint64_t seed = 1;
};

/// Fuzzy c-means (Bezdek 1981; methods.md §4.3): with u_ik the membership of point k in cluster i, d_ik its distance
/// from the centre v_i,
///
///   J = Σ_i Σ_k u_ik^m d_ik²,   Σ_i u_ik = 1,
///   v_i = Σ_k u_ik^m x_k / Σ_k u_ik^m,   u_ik = 1 / Σ_j (d_ik/d_jk)^(2/(m−1)),
///
/// the last two in turn until the memberships stand. A point on a centre (to 1e-10 of the largest distance or
/// coordinates) belongs to it alone, to several that coincide in equal parts.
struct FuzzyClusters {
  Eigen::MatrixXd membership;   ///< c × n
  Eigen::MatrixXd centres;      ///< c × dimensions
  std::vector<double> descent;  ///< J after every iteration of the start that was kept

  [[nodiscard]] double objective() const { return descent.back(); }
  /// Of each point the cluster in which it has most membership.
  [[nodiscard]] std::vector<Eigen::Index> labels() const;
};

/// Clusters of the rows of `points`. std::invalid_argument unless 1 ≤ c ≤ n and the options are as said above.
FuzzyClusters fuzzy_c_means(Eigen::MatrixXd const& points, int clusters, FuzzyOptions const& options = {});

/// XB = Σ_i Σ_k u_ik² d_ik² / (n min_{i≠j} ‖v_i − v_j‖²): small where clusters are tight and far apart (Xie & Beni,
/// IEEE TPAMI 13 (1991) 841). Infinite for one cluster and where centres coincide.
double xie_beni(FuzzyClusters const& clusters, Eigen::MatrixXd const& points);

/// The fuzzy clusters of the same points for any number of them, each found when it is first asked for, by whichever
/// thread asks, and only once.
class FuzzyPartitions {
 public:
  explicit FuzzyPartitions(Eigen::MatrixXd points, FuzzyOptions const& options = {});

  /// As `fuzzy_c_means` finds them, and refuses.
  [[nodiscard]] FuzzyClusters const& clusters(int count);
  /// The c from 2 to n/2, 10 at most, with the least Xie-Beni index; 1 for fewer than four points.
  [[nodiscard]] int number();
  /// Clusterings that were made so far.
  [[nodiscard]] int made() const { return made_; }

 private:
  Eigen::MatrixXd points_;
  FuzzyOptions options_;
  std::mutex finding_;
  std::map<int, FuzzyClusters> found_;
  int made_ = 0;
};

}  // namespace thermotwin::models
