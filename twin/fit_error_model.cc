#include "twin/fit_error_model.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdexcept>

#include "models/metrics.h"
#include "thermal/error.h"
#include "twin/axis_record.h"
#include "twin/error_model_run.h"
#include "twin/version.h"

namespace thermotwin::twin {
namespace {

/// Why a run's sensor is not for a model of all sensors; empty: it is.
std::string unusable(output::Dataset const& shown, std::string const& sensor) {
  auto const it =
      std::find_if(shown.readings.begin(), shown.readings.end(), [&](auto const& c) { return c.name == sensor; });
  if (it == shown.readings.end()) return "it is not there";
  auto const missing = (!it->values.array().isFinite()).count();
  if (missing == it->values.size()) return "it is dead";
  return missing > 0 ? fmt::format("{} of {} readings are missing", missing, it->values.size()) : std::string();
}

std::vector<std::string> usable_sensors(std::vector<RecordedRun>& runs) {
  std::vector<std::string> sensors;
  for (auto const& channel : runs.front().shown.readings) sensors.push_back(channel.name);
  for (auto& run : runs)
    std::erase_if(sensors, [&](std::string const& sensor) {
      auto const why = unusable(run.shown, sensor);
      if (!why.empty()) run.remarks.push_back(fmt::format("{} is left out: {}", sensor, why));
      return !why.empty();
    });
  if (!sensors.empty()) return sensors;
  std::vector<std::string> why;
  for (auto const& run : runs)
    for (auto const& remark : run.remarks) why.push_back(run.file + ": " + remark);
  throw thermal::InputError(fmt::format("no sensor has all its readings in every run: {}", fmt::join(why, "; ")));
}

void check_units(std::vector<ErrorModelRun> const& runs, std::string const& error) {
  for (auto const& run : runs)
    if (run.unit != runs.front().unit)
      throw thermal::InputError(fmt::format("{} is in {} in {}, and in {} in {}", error, run.unit, run.batch.name,
                                            runs.front().unit, runs.front().batch.name));
}

FittedRun fitted_run(SavedErrorModel const& saved, ErrorModelRun const& run, std::string const& machine) {
  auto const first = saved.model.unclaimed_instants();
  auto const rows = run.batch.time.size() - first;
  Eigen::VectorXd const predicted = saved.model.predict(run.batch);
  auto const judged = models::metrics(run.batch.error.tail(rows), predicted.tail(rows));
  return {run.batch.name, machine, run.fingerprint, int(rows), run.zero, judged.rmse, judged.max};
}

void remark_repeated(std::vector<ErrorModelRun> const& runs, std::vector<RecordedRun>& recorded) {
  for (std::size_t r = 1; r < runs.size(); ++r)
    for (std::size_t s = 0; s < r; ++s)
      if (runs[r].fingerprint == runs[s].fingerprint) {
        recorded[r].remarks.push_back(fmt::format("the same data as {}; they count once more", recorded[s].file));
        break;
      }
}

void fit_form(SavedErrorModel& saved, std::vector<ErrorModelRun> const& runs, ErrorModelFit const& fit) {
  auto const& method = models::model_method(fit.method);
  models::FitOptions options;
  options.seed = fit.seed;
  std::vector<models::Batch> batches;
  std::vector<models::AxisRecord> records;
  for (auto const& run : runs) {
    batches.push_back(run.batch);
    if (run.axis) records.push_back(*run.axis);
  }
  saved.ranges = input_ranges(batches);
  if (records.empty()) {
    saved.model = method.fit(batches, options);
    return;
  }
  auto const axis = models::fit_feed_axis(records, method, options);
  saved.model = axis.slope;
  saved.zero_position = axis.zero_position;
}

}  // namespace

SavedErrorModel fit_error_model(ErrorModelFit const& fit, std::vector<std::string>& remarks) {
  if (fit.twin && fit.error.starts_with(slope_prefix))
    throw thermal::InputError(fmt::format("'{}': a slope is fitted without a twin", fit.error));
  auto const beside = fit.twin ? std::optional(twin_beside(*fit.twin)) : std::nullopt;
  auto const twin = beside ? std::optional(twin_of(*beside)) : std::nullopt;
  std::vector<RecordedRun> recorded;
  for (auto const& file : fit.runs) recorded.push_back(read_recorded_run(file, fit.sampling, twin ? &*twin : nullptr));
  auto const sensors = fit.sensors.empty() ? usable_sensors(recorded) : fit.sensors;
  std::vector<ErrorModelRun> runs;
  for (auto& run : recorded) runs.push_back(error_model_run(run, sensors, fit.error, true));
  check_units(runs, fit.error);
  remark_repeated(runs, recorded);
  SavedErrorModel saved;
  saved.error = fit.error;
  saved.unit = runs.front().unit;
  saved.title = runs.front().title;
  saved.version = version();
  saved.commit = commit();
  saved.sampling = fit.sampling;
  saved.twin = beside;
  try {
    fit_form(saved, runs, fit);
    for (std::size_t r = 0; r < runs.size(); ++r) saved.runs.push_back(fitted_run(saved, runs[r], recorded[r].machine));
  } catch (std::invalid_argument const& error) {
    throw thermal::InputError(error.what());
  }
  for (auto const& run : recorded)
    for (auto const& remark : run.remarks) remarks.push_back(run.file + ": " + remark);
  return saved;
}

}  // namespace thermotwin::twin
