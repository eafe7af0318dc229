#include "twin/saved_error_model.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "thermal/error.h"
#include "twin/compensation/observed_run.h"
#include "twin/file/text_file.h"
#include "twin/fingerprint.h"
#include "twin/study/judgement.h"
#include "twin/study/study_file.h"

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

/// What the fits say of themselves: "R² = 0.9914".
std::vector<std::string> remarks_of(SavedErrorModel const& saved) {
  std::vector<std::string> remarks;
  for (auto const& part : saved.parts)
    if (!part.model.remark.empty()) remarks.push_back(part.model.remark);
  return remarks;
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

bool ModelPart::reads() const { return model.method != twin_alone; }

std::string ModelPart::name() const {
  return beside_twin && reads() ? fmt::format("{} {}", twin_alone, model.method) : model.method;
}

ModelPart observing_part(std::vector<std::string> const& sensors, ObserverOptions const& options) {
  ModelPart part{nothing_more(sensors), true, {}, options};
  part.model.method = observer_method;
  part.model.remark = text_of(options);
  return part;
}

std::optional<TwinObserver> observer_of(SavedErrorModel const& saved, Machine const& twin) {
  for (auto const& part : saved.parts)
    if (part.observer) return TwinObserver(twin, saved.error, *part.observer, part.model.inputs);
  return std::nullopt;
}

std::string SavedErrorModel::method() const {
  std::vector<std::string> names;
  for (auto const& part : parts) names.push_back(part.name());
  return fmt::format("{}", fmt::join(names, " & "));
}

int SavedErrorModel::unclaimed_instants() const {
  int most = 0;
  for (auto const& part : parts) most = std::max(most, part.model.unclaimed_instants());
  return most;
}

Eigen::MatrixXd SavedErrorModel::predict(ErrorModelRun const& run) const {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(run.batch.time.size(), run.axis ? run.axis->position.size() : 1);
  for (auto const& part : parts) {
    if (run.axis)
      sum += models::FeedAxisModel{part.model, zero_position.value()}.predict(*run.axis);
    else if (part.observer)
      sum += run.observed.value();
    else if (part.beside_twin)
      sum += run.said.value().error + part.model.predict(run.less_twin());
    else
      sum += part.model.predict(run.batch);
  }
  return sum / double(parts.size());
}

double SavedErrorModel::rmse() const {
  double sum = 0.0, rows = 0.0;
  for (auto const& run : runs) {
    sum += run.rows * run.rmse * run.rmse;
    rows += run.rows;
  }
  return rows > 0.0 ? std::sqrt(sum / rows) : 0.0;
}

nlohmann::ordered_json error_model_json(SavedErrorModel const& saved) {
  auto runs = nlohmann::ordered_json::array();
  for (auto const& run : saved.runs)
    runs.push_back({{"file", run.file},
                    {"machine", run.machine},
                    {"rows", run.rows},
                    {"zero_degC", run.zero},
                    {"rmse", run.rmse},
                    {"largest", run.largest}});
  nlohmann::ordered_json json = {{"method", saved.method()}, {"error", saved.error},     {"unit", saved.unit},
                                 {"title", saved.title},     {"inputs", saved.inputs()}, {"fits", remarks_of(saved)}};
  if (saved.zero_position) json["zero_position_mm"] = 1e3 * *saved.zero_position;
  if (saved.twin) json["twin"] = saved.twin->machine.filename().string();
  json["fitted_to"] = runs;
  if (!saved.runs.empty()) json["rmse"] = saved.rmse();
  return json;
}

std::string error_model_text(SavedErrorModel const& saved) {
  auto const remarks = remarks_of(saved);
  std::string text =
      fmt::format("{}{} of {} [{}]{} on {}{}{}\n", saved.parts.size() > 1 ? "the mean of " : "", saved.method(),
                  saved.error, saved.unit, saved.title.empty() ? "" : " (" + saved.title + ")",
                  fmt::join(saved.inputs(), ", "), remarks.empty() ? "" : ": ", fmt::join(remarks, "; "));
  if (saved.zero_position) text += fmt::format("zero position {:.2f} mm\n", 1e3 * *saved.zero_position);
  if (saved.twin) text += fmt::format("the twin is {}\n", saved.twin->machine.filename().string());
  text += fmt::format("zero in the first row of a run{}\n", zero_text(saved));
  for (auto const& run : saved.runs)
    text += fmt::format("fitted to {}{}: {} rows, RMSE {:.3g}, largest {:.3g} {}\n", run.file,
                        run.machine.empty() ? "" : " of " + run.machine, run.rows, run.rmse, run.largest, saved.unit);
  if (saved.runs.empty()) text += "its file does not say what it was fitted to\n";
  if (saved.runs.size() > 1) text += fmt::format("over all of them RMSE {:.3g} {}\n", saved.rmse(), saved.unit);
  return text;
}

}  // namespace thermotwin::twin
