#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "models/error_model.h"

namespace thermotwin::twin {

struct ErrorModelFit {
  std::vector<std::filesystem::path> runs;  ///< data sets (.h5)
  std::string error = "E_X";                ///< displacement to explain
  std::vector<std::string> sensors;         ///< of the readings; none: all
  std::string method = "linear";            ///< of models::model_methods()
  std::uint64_t seed = 1;
};

/// An error model from what the instruments showed in these runs, temperatures and error counted from the first row of
/// each. InputError that names run, sensor, displacement or method.
[[nodiscard]] models::ErrorModel fit_error_model(ErrorModelFit const& fit);

}  // namespace thermotwin::twin
