#include "twin/saved_error_model.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "thermal/error.h"
#include "twin/file/text_file.h"
#include "twin/fingerprint.h"

namespace thermotwin::twin {
namespace {

/// "20.0 degC", "19.8 to 20.3 degC": of all inputs in the first rows of all runs.
std::string zero_text(SavedErrorModel const& saved) {
  double lowest = INFINITY, highest = -INFINITY;
  for (auto const& run : saved.runs)
    for (double const temperature : run.zero) {
      lowest = std::min(lowest, temperature);
      highest = std::max(highest, temperature);
    }
  if (lowest > highest) return {};
  return highest - lowest < 0.05 ? fmt::format(", at {:.1f} degC", lowest)
                                 : fmt::format(", at {:.1f} to {:.1f} degC", lowest, highest);
}

}  // namespace

TwinBeside twin_beside(std::filesystem::path const& machine) {
  Fingerprint print;
  print.add(text_of_file(machine));
  return {machine, print.text()};
}

Machine twin_of(TwinBeside const& twin) {
  if (twin_beside(twin.machine).fingerprint != twin.fingerprint)
    throw thermal::InputError(
        fmt::format("{} is no longer the file beside which the model was fitted; fit it anew", twin.machine.string()));
  return Machine::read(twin.machine);
}

double SavedErrorModel::rmse() const {
  double sum = 0.0, rows = 0.0;
  for (auto const& run : runs) {
    sum += run.rows * run.rmse * run.rmse;
    rows += run.rows;
  }
  return rows > 0.0 ? std::sqrt(sum / rows) : 0.0;
}

std::string error_model_text(SavedErrorModel const& saved) {
  auto const& model = saved.model;
  std::string text = fmt::format("{} of {} [{}]{} on {}{}{}\n", model.method, saved.error, saved.unit,
                                 saved.title.empty() ? "" : " (" + saved.title + ")", fmt::join(model.inputs, ", "),
                                 model.remark.empty() ? "" : ": ", model.remark);
  if (saved.zero_position) text += fmt::format("zero position {:.2f} mm\n", 1e3 * *saved.zero_position);
  if (saved.twin)
    text += fmt::format("beside the twin {}: of what that errs by\n", saved.twin->machine.filename().string());
  text += fmt::format("zero in the first row of a run{}\n", zero_text(saved));
  for (auto const& run : saved.runs)
    text += fmt::format("fitted to {}{}: {} rows, RMSE {:.3g}, largest {:.3g} {}\n", run.file,
                        run.machine.empty() ? "" : " of " + run.machine, run.rows, run.rmse, run.largest, saved.unit);
  if (saved.runs.empty()) text += "its file does not say what it was fitted to\n";
  if (saved.runs.size() > 1) text += fmt::format("over all of them RMSE {:.3g} {}\n", saved.rmse(), saved.unit);
  return text;
}

}  // namespace thermotwin::twin
