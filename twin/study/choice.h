#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/exhaustive_selection.h"
#include "models/selection.h"
#include "models/selection_score.h"
#include "models/shared_screen.h"
#include "models/subset_validation.h"
#include "twin/study/question.h"
#include "twin/study/study_modes.h"

namespace thermotwin::twin {

/// What a method chose for a question, in columns of the world's sensors; or why it could not.
struct Choice {
  models::Selection selection;        ///< score 0 for sensors that stand still in the training set
  std::vector<Eigen::Index> columns;  ///< the same sensors, ascending: what models are fitted to
  std::string refused;                ///< empty if it chose
};

/// Whether a method chooses by the errors as well as by the readings.
[[nodiscard]] bool sees_error(NamedSelection const& method);

/// How `[screening]` has methods look at readings.
[[nodiscard]] models::SelectionOptions selection_options(StudyScreening const& screening);

/// `options` but for the number of sensors and the mode shapes, which only modes_method asks for; what they share, all
/// methods share that choose for this question with them.
[[nodiscard]] Choice choose(NamedSelection const& method, Question const& question, WorldData const& data,
                            ModeShapes const& modes, models::SelectionOptions options);

/// How good a choice is, by the truth of a world.
struct ChoiceQuality {
  double regret = 0;  ///< [µm], see models::regret
  models::SelectionScore score;
};

/// What selections are measured against: the runs of a world, all of them, without noise where they are simulated, and
/// the best of all sets of a size on them by blocked cross-validation of a linear regression (exhaustive_selection.h).
///
/// The truth of a sensor for sets of k is its margin there: RMSE of the best k without it − RMSE of the best k with it,
/// shifted so that the least is 0. The k truly informative ones are thus the best set. Only for up to 20 sensors.
class SelectionTruth {
 public:
  explicit SelectionTruth(WorldData const& data);

  /// Finds the best set of that size. To be called for every size before quality() is asked from several threads.
  void prepare(int count);

  /// None when the number of sensors, or of those chosen, is out of reach.
  [[nodiscard]] std::optional<ChoiceQuality> quality(Choice const& choice) const;

 private:
  std::unique_ptr<models::SubsetValidation> validation_;
  std::map<int, models::BestSubset> best_;
};

}  // namespace thermotwin::twin
