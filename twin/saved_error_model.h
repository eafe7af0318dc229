#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "models/error_model.h"
#include "twin/compensation/twin_observer.h"
#include "twin/error_model_run.h"
#include "twin/input_range.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// A run that an error model was fitted to.
struct FittedRun {
  std::string file;          ///< its name
  std::string machine;       ///< that was run or measured; empty where the data do not say
  std::string fingerprint;   ///< of times, temperatures and errors, as the fit saw them
  int rows = 0;              ///< that the model claims to predict
  std::vector<double> zero;  ///< what the inputs showed in its first row, where the error is zero [°C]
  double rmse = 0.0;         ///< of the model there, in the error's unit
  double largest = 0.0;      ///< likewise
};

/// The machine file beside which a model stands: what the model predicts is what that twin errs by.
struct TwinBeside {
  std::filesystem::path machine;
  std::string fingerprint;  ///< of its text
};

/// InputError unless the file is there and as it was.
[[nodiscard]] Machine twin_of(TwinBeside const& twin);
[[nodiscard]] TwinBeside twin_beside(std::filesystem::path const& machine);

/// One of the models whose mean is a saved error model.
struct ModelPart {
  models::ErrorModel model;
  bool beside_twin = false;        ///< what the twin says, and the model of what that errs by; "twin": nothing more
  std::vector<InputRange> ranges;  ///< of the inputs, in their order; empty: its file does not say
  std::optional<ObserverOptions> observer{};  ///< of a twin that the inputs correct; the model adds nothing

  [[nodiscard]] std::string name() const;  ///< "ridge", "twin ridge", "twin", "twin observer", as studies call it
  [[nodiscard]] bool reads() const;        ///< its sensors: it is not the twin alone
};

/// The twin that these sensors correct.
[[nodiscard]] ModelPart observing_part(std::vector<std::string> const& sensors, ObserverOptions const& options);

/// An error model, of what, from which data, and how well it meets them: the mean of its parts (Bates & Granger 1969,
/// named_models()), all of the same inputs.
struct SavedErrorModel {
  std::string error;                    ///< displacement channel, or "slope z": of the position error of axis z
  std::string unit = "um";              ///< "um", "urad"; of a slope "um/m"
  std::string title;                    ///< of the channel, for people; its sign is that of the channel
  std::optional<double> zero_position;  ///< P₀ of a slope: E = K (P − P₀) [m]
  std::string version, commit;          ///< of the program that fitted it
  std::optional<double> sampling;       ///< means over this time were fitted [s]; none: the rows as they are
  std::optional<TwinBeside> twin;       ///< where a part stands beside it
  std::vector<FittedRun> runs;
  std::vector<ModelPart> parts;  ///< at least one

  [[nodiscard]] std::vector<std::string> const& inputs() const { return parts.front().model.inputs; }
  [[nodiscard]] std::string method() const;      ///< "ridge", "twin & ridge_distributed_lag"
  [[nodiscard]] int unclaimed_instants() const;  ///< the most of its parts
  [[nodiscard]] double rmse() const;             ///< over all runs
  /// Errors of a run, a row per instant; of a slope a column per position of the laser. std::invalid_argument for a run
  /// that a part refuses.
  [[nodiscard]] Eigen::MatrixXd predict(ErrorModelRun const& run) const;
};

/// The part that is an observer, made ready: of the saved model's twin, corrected by its inputs. Nothing where no part
/// is one. InputError where that twin cannot be observed so (TwinObserver).
[[nodiscard]] std::optional<TwinObserver> observer_of(SavedErrorModel const& saved, Machine const& twin);

/// What it predicts, from which inputs, what it was fitted to and what it errs by there: a few lines.
[[nodiscard]] std::string error_model_text(SavedErrorModel const& saved);
/// The same for programs.
[[nodiscard]] nlohmann::ordered_json error_model_json(SavedErrorModel const& saved);

}  // namespace thermotwin::twin
