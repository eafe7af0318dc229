#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/remaining_variance.h"
#include "twin/placement/ensemble.h"

namespace thermotwin::twin {

/// The best linear estimate of the displacements from some sensors, as an ensemble teaches it:
///
///   ŷ = ȳ + Wᵀ (x − x̄),   W = (S_AA + R)⁻¹ S_Ay.
struct LinearEstimate {
  std::vector<Eigen::Index> sites;
  Eigen::RowVectorXd mean_reading;       ///< x̄, since the start of a run [K]
  Eigen::RowVectorXd mean_displacement;  ///< ȳ [µm]
  Eigen::MatrixXd weights;               ///< W, sites × channels [µm/K]
};

/// How far an estimate was from the truth.
struct EstimateError {
  Eigen::VectorXd mean_square;  ///< per channel, the noise of the sensors included [µm²]
  Eigen::VectorXd of_members;   ///< per member of the ensemble, all channels together [µm²]
};

/// Means and covariances of readings and displacements over an ensemble, member by member, so that one can be left out.
class SnapshotMoments {
 public:
  /// `noise`: standard deviation of each sensor's own error [K].
  SnapshotMoments(Ensemble const& ensemble, double noise);

  /// Of the first `sites` sites.
  [[nodiscard]] models::PlacementProblem problem(Eigen::Index sites) const;
  [[nodiscard]] LinearEstimate estimate(std::span<Eigen::Index const> sites) const;
  /// What each member's displacements would have been estimated to be from all the others' moments: the variance to be
  /// expected on a machine and a spectrum that took no part.
  [[nodiscard]] EstimateError cross_validated(std::span<Eigen::Index const> sites) const;
  [[nodiscard]] double noise_variance() const { return noise_ * noise_; }

 private:
  Ensemble const* ensemble_;
  double noise_;
};

/// Of an estimate on any ensemble with the same sites.
[[nodiscard]] EstimateError error_on(Ensemble const& ensemble, LinearEstimate const& estimate, double noise_variance);

}  // namespace thermotwin::twin
