#pragma once

#include <Eigen/Core>
#include <compare>
#include <string>
#include <vector>

#include "models/batch.h"
#include "twin/study/study_data.h"

namespace thermotwin::twin {

/// What a prediction is good for: it was trained on, it was not, or it was left out of 'train' by cross-validation.
enum class Role { self, cross, validation };

/// A stretch of a run that a model is asked to predict.
struct Asked {
  Role role = Role::self;
  models::Batch batch;                ///< the whole run: lags may reach back before the stretch
  Eigen::VectorXd truth;              ///< of the whole run: true errors, measured ones where these are not known
  Eigen::Index first = 0, count = 0;  ///< rows of the stretch
  std::size_t run = 0;                ///< of the world: those of 'train', then those of 'test'
  Eigen::VectorXd said_by_twin{};     ///< of the whole run: what the model's answer is added to; empty: nothing
};

/// Rows of a run.
struct RunPart {
  std::size_t run = 0;  ///< of 'train'
  Eigen::Index first = 0, count = 0;

  auto operator<=>(RunPart const&) const = default;
};

/// A training set, and what its models are asked.
struct Question {
  std::string name;                     ///< of the training set, for people
  std::vector<models::Batch> training;  ///< the world's sensors that move in it
  std::vector<Eigen::Index> columns;    ///< these sensors, as columns of the world's
  std::vector<Asked> asked;
  std::vector<RunPart> parts;  ///< what `training` is of the runs, in its order
};

/// The questions of one repetition of a world: one, or one per run of 'train' (fit = "each"); then those of the
/// cross-validation: `folds` stretches of a single run, or groups of whole runs. A sensor that stands still in a
/// training set is left out of it; `remarks` say so, and where runs of 'train' hold the same data. A row that is a mean
/// over `sampling` is trained on only if all of it is before `split`.
struct Questions {
  std::vector<Question> fits, validations;
  std::vector<std::string> remarks;
};
[[nodiscard]] Questions questions(StudyWorld const& world, WorldData const& data, int repetition, int folds);

/// Whether both are trained on the same readings of the same sensors, whatever the errors.
[[nodiscard]] bool read_alike(Question const& a, Question const& b);

/// Whether both are trained on the same readings and errors of the same sensors.
[[nodiscard]] bool trained_alike(Question const& a, Question const& b);

/// Rows of a batch, as a batch that knows the readings before it: the machine does not rest in the middle of a run.
[[nodiscard]] models::Batch rows_of(models::Batch const& batch, Eigen::Index first, Eigen::Index count);
[[nodiscard]] inline models::Batch rows_of(models::Batch const& batch, RunPart const& part) {
  return rows_of(batch, part.first, part.count);
}

}  // namespace thermotwin::twin
