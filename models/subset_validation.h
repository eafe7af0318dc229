#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/batch.h"

namespace thermotwin::models {

/// Blocked cross-validation of y = b₀ + Σ_{j∈S} b_j ΔT_j for any set S of sensors: the instants are cut into `folds`
/// blocks that follow one another (neighbouring minutes are too alike to be in training and test; of several runs, each
/// block is whole runs), each is predicted by the least squares of all others, and
///
///   RMSE(S) = √(Σ e²/N) over all blocks [µm].
///
/// Each block is reduced once to the triangle R of [1 X y] = QR; after that a set costs a small QR per fold, whatever
/// N, and the residuals of a block are ‖R (b₀, b, −1)ᵀ‖ exactly. A sensor that is a combination of others in S adds
/// nothing.
class SubsetValidation {
 public:
  /// std::invalid_argument for what `folds_of_runs` refuses.
  explicit SubsetValidation(std::span<Batch const> batches, int folds = 5);

  /// std::invalid_argument when a training set has fewer instants than the set has sensors, and two more.
  [[nodiscard]] double rmse(std::span<Eigen::Index const> sensors) const;

  /// Largest set for which that suffices.
  [[nodiscard]] int largest_set() const { return static_cast<int>(shortest_training_) - 2; }
  [[nodiscard]] Eigen::Index sensors() const { return sensors_; }

  /// Less by more than round-off (1e-9 of the error's own size).
  [[nodiscard]] bool less(double rmse, double other) const;

  /// The rule by which sets grow when no size is given: one more sensor must lower the RMSE by 1 %, and not from what
  /// is round-off already.
  [[nodiscard]] bool worthwhile(double before, double after) const;

 private:
  Eigen::Index instants_ = 0, sensors_ = 0, shortest_training_ = 0;
  double size_of_error_ = 0;
  std::vector<Eigen::MatrixXd> test_, training_;  ///< R of each block and of all others, columns [1 X y]
};

}  // namespace thermotwin::models
