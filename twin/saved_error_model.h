#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "models/error_model.h"
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

/// An error model, of what, from which data, and how well it meets them.
struct SavedErrorModel {
  std::string error;                    ///< displacement channel, or "slope z": of the position error of axis z
  std::string unit = "um";              ///< "um", "urad"; of a slope "um/m"
  std::string title;                    ///< of the channel, for people; its sign is that of the channel
  std::optional<double> zero_position;  ///< P₀ of a slope: E = K (P − P₀) [m]
  std::string version, commit;          ///< of the program that fitted it
  std::optional<double> sampling;       ///< means over this time were fitted [s]; none: the rows as they are
  std::optional<TwinBeside> twin;
  std::vector<FittedRun> runs;
  std::vector<InputRange> ranges;  ///< of the inputs, in their order; empty: its file does not say
  models::ErrorModel model;

  [[nodiscard]] double rmse() const;  ///< over all runs
};

/// What it predicts, from which inputs, what it was fitted to and what it errs by there: a few lines.
[[nodiscard]] std::string error_model_text(SavedErrorModel const& saved);

}  // namespace thermotwin::twin
