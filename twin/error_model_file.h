#pragma once

#include <filesystem>

#include "twin/file/schema.h"
#include "twin/saved_error_model.h"

namespace thermotwin::twin {

/// A fitted thermal-error model as a file: what it predicts, the data that it was fitted to with its error there, and
/// the names of the inputs in their order; every number in its shortest form that reads back as the same double, so
/// that it predicts the same bytes.
///
///   [predicts]
///   error = "E_X"                       # or "slope z", with zero_position = "0.018 m"
///   unit = "um"
///   title = "spindle against turret, radial"
///
///   [twin]                              # of methods that name it
///   machine = "calibrated.toml"         # relative to this file
///   fingerprint = "1b…"                 # of its text
///
///   [fit]                               # may be missing: then nobody knows
///   version = "0.1.0"
///   commit = "1fdea30"
///   run = [{ file = "other.h5", machine = "g200", fingerprint = "8c…", rows = 481, rmse = 0.3, largest = 1.1,
///            zero_degC = [20.1, 20.0] }]
///
///   [model]                             # or several [[part]], whose mean it is
///   method = "ridge"                    # "twin ridge": of what the twin errs by; "twin": nothing more; "twin
///   observer" inputs = ["T2", "T4"] lowest_K = [-0.1, 0]                # change of each input since the first row,
///   that the fit saw; may be missing highest_K = [7.8, 3.2] sample_period = "180 s" parameters = 3 remark = "…"
///   [model.linear]                      # or model.kernel, model.network
///   intercept = 1.25
///   lag = [{ samples = 0, coefficients = [0.5, -2.75] }]
///
/// "twin observer" has, in place of all from lowest_K on, what it believes (ObserverOptions):
///
///   [model.observer]
///   heat_noise = 0.0005                 # [K/√s]
///   sensor_noise = 0.5                  # [K √s]
///   longest_step = "30 s"
///
/// Written atomically; InputError for a model with a number that is not finite.
void write_error_model(std::filesystem::path const& path, SavedErrorModel const& saved);

/// FileError, with line and column, for unknown methods and keys, missing ones, a file that does not say what it
/// predicts, and lists whose lengths are not the number of inputs.
[[nodiscard]] SavedErrorModel read_error_model(std::filesystem::path const& path);

/// The keys of such a file.
[[nodiscard]] std::vector<FieldRecord> error_model_fields();

}  // namespace thermotwin::twin
