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

/// What teaches the estimate that makes displacements of readings.
enum class Teacher {
  family,   ///< all machines that the file could stand for: one estimate, before the machine is there
  machine,  ///< the machine itself, whose displacements are measured during some runs: each has its own estimate
};

/// Rows of an ensemble that follow one another.
struct Rows {
  Eigen::Index first = 0, count = 0;
};

/// Means and covariances of readings and displacements over an ensemble, part by part, so that one can be left out.
class SnapshotMoments {
 public:
  /// `noise`: standard deviation of each sensor's own error [K]. InputError for machines that shall teach themselves,
  /// but have fewer than two runs: one to teach, one to judge by.
  SnapshotMoments(Ensemble const& ensemble, double noise, Teacher teacher = Teacher::family);

  /// Of the first `sites` sites; a world per group.
  [[nodiscard]] models::PlacementProblem problem(Eigen::Index sites) const;
  /// Taught by all rows.
  [[nodiscard]] LinearEstimate estimate(std::span<Eigen::Index const> sites) const;
  /// Of the family: what each member's displacements would have been estimated to be from all the others' moments; of
  /// machines: each run's from the other runs of the same member. It is the variance to be expected on a machine that
  /// took no part, or of machines under a spectrum that did not.
  [[nodiscard]] EstimateError cross_validated(std::span<Eigen::Index const> sites) const;
  /// What estimates taught by this family, or by those machines themselves, leave on machines that took no part.
  [[nodiscard]] EstimateError unseen(Ensemble const& others, std::span<Eigen::Index const> sites) const;
  [[nodiscard]] double noise_variance() const { return noise_ * noise_; }
  /// Rows that share an estimate: all, or those of each member.
  [[nodiscard]] std::vector<Rows> const& groups() const { return groups_; }

 private:
  Ensemble const* ensemble_;
  double noise_;
  Teacher teacher_;
  std::vector<Rows> groups_;
};

/// Of an estimate on any ensemble with the same sites.
[[nodiscard]] EstimateError error_on(Ensemble const& ensemble, LinearEstimate const& estimate, double noise_variance);

}  // namespace thermotwin::twin
