#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "twin/error_model_run.h"
#include "twin/saved_error_model.h"

namespace thermotwin::twin {

/// What a saved model says of a run.
struct ErrorPrediction {
  ErrorModelRun run;
  Eigen::MatrixXd predicted;  ///< rows × positions; of a displacement one column
  int unclaimed = 0;          ///< first rows that the model does not claim to predict
  std::string unit;           ///< of the predicted numbers: "um", "urad"
  bool seen_before = false;   ///< the model was fitted to these very data
  std::vector<std::string> remarks;

  /// As the run showed it, likewise; NaN where it did not.
  [[nodiscard]] Eigen::MatrixXd shown() const;
};

/// The inputs are found by name. InputError for a run that lacks one, or shows the error in another unit; a run of
/// another machine than those that the model was fitted to, inputs that leave their range there, and a first row that
/// seems to be an outlier are remarked. An error that begins after the run's first row counts from what the model says
/// to have changed by then.
[[nodiscard]] ErrorPrediction predict_error(SavedErrorModel const& saved, std::filesystem::path const& run);

/// RMSE, MAE, bias (mean of shown less predicted) and largest of what is left, beside the same of the error itself.
[[nodiscard]] std::string prediction_text(ErrorPrediction const& prediction);

/// The same of a model's predictions, and the model (error_model_json).
[[nodiscard]] std::string predictions_json(SavedErrorModel const& saved,
                                           std::vector<ErrorPrediction> const& predictions);

/// time_s, error, predicted; of a slope with position_mm, and a row per pass and position. A cell is empty where the
/// run does not show the error, or the model does not claim to predict it.
[[nodiscard]] std::string prediction_csv(ErrorPrediction const& prediction);

/// Whether such a table begins so.
[[nodiscard]] bool is_prediction_header(std::string const& line);

}  // namespace thermotwin::twin
