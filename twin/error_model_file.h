#pragma once

#include <filesystem>

#include "models/error_model.h"

namespace thermotwin::twin {

/// A fitted thermal-error model as a file: the table `[model]` of TOML with the names of the inputs in their order and
/// every number in its shortest form that reads back as the same double, so that it predicts the same bytes.
///
///   [model]
///   method = "ridge"
///   inputs = ["T2", "T4"]
///   sample_period = "180 s"
///   parameters = 3
///   remark = "…"
///   [model.linear]                      # or model.kernel, model.network
///   intercept = 1.25
///   lag = [{ samples = 0, coefficients = [0.5, -2.75] }]
///
/// Written atomically; InputError for a model with a number that is not finite.
void write_error_model(std::filesystem::path const& path, models::ErrorModel const& model);

/// FileError, with line and column, for unknown methods and keys, missing ones, and lists whose lengths are not the
/// number of inputs.
[[nodiscard]] models::ErrorModel read_error_model(std::filesystem::path const& path);

}  // namespace thermotwin::twin
