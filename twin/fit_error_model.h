#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "twin/saved_error_model.h"

namespace thermotwin::twin {

struct ErrorModelFit {
  std::vector<std::filesystem::path> runs;  ///< data sets (.h5), tables (.csv), measurement files (.toml)
  std::string error = "E_X";                ///< displacement to explain, or "slope z" of an axis' error
  std::vector<std::string> sensors{};       ///< of the readings; none: all that lack few of their readings in every run
  std::string method = "linear";            ///< as studies name models (named_models()): "ridge", "twin & ridge"
  std::uint64_t seed = 1;
  std::optional<std::filesystem::path> twin{};  ///< machine file, best calibrated; a method that names no twin is of
                                                ///< what it errs by
  std::optional<double> sampling{};             ///< means over this time [s]; none: the rows as they are
};

/// An error model from what the instruments showed in these runs, temperatures and error counted from the first row of
/// each. What is odd about a run goes to `remarks`, under its name; so does what 0.1 K of error in the sensors does to
/// the prediction, where that is far more than the model errs by. InputError that names run, sensor, displacement or
/// method.
[[nodiscard]] SavedErrorModel fit_error_model(ErrorModelFit const& fit, std::vector<std::string>& remarks);

}  // namespace thermotwin::twin
