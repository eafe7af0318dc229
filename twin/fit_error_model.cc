#include "twin/fit_error_model.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <stdexcept>

#include "models/metrics.h"
#include "thermal/error.h"
#include "twin/axis_record.h"
#include "twin/compensation/observed_run.h"
#include "twin/diagnosis/measured_run.h"
#include "twin/error_model_run.h"
#include "twin/file/distinct_names.h"
#include "twin/study/judgement.h"
#include "twin/study/study_file.h"
#include "twin/version.h"

namespace thermotwin::twin {
namespace {

/// Whether the machine has it on a body.
bool observes(TwinObserver const& observer, std::string const& sensor) {
  return std::any_of(observer.inputs().begin(), observer.inputs().end(),
                     [&](auto const& input) { return input.sensor && input.name == sensor; });
}

constexpr double largest_missing_share_of_fit = 0.1;  ///< as in studies

/// Rows of which something could be learnt: with the error, and at least one sensor.
Eigen::ArrayX<bool> rows_to_learn_from(output::Dataset const& shown, std::string const& error) {
  Eigen::ArrayX<bool> any = Eigen::ArrayX<bool>::Constant(shown.time_s.size(), false);
  for (auto const& channel : shown.readings) any = any || channel.values.array().isFinite();
  if (auto const* channel = find_channel(shown.displacements, error)) any = any && channel->values.array().isFinite();
  return any;
}

/// Why a run's sensor is not for a model of all sensors; empty: it is.
std::string unusable(output::Dataset const& shown, std::string const& sensor, std::string const& error,
                     TwinObserver const* observer) {
  auto const it =
      std::find_if(shown.readings.begin(), shown.readings.end(), [&](auto const& c) { return c.name == sensor; });
  if (it == shown.readings.end()) return "it is not there";
  if (observer && !observes(*observer, sensor)) return "the twin does not have it on a body";
  Eigen::ArrayX<bool> const missing = !it->values.array().isFinite(), asked = rows_to_learn_from(shown, error);
  if (missing.all()) return "it is dead";
  auto const lacking = (missing && asked).count();
  if (double(lacking) <= largest_missing_share_of_fit * double(asked.count())) return {};
  return fmt::format("{} of {} readings are missing, more than {:g} %", lacking, asked.count(),
                     100.0 * largest_missing_share_of_fit);
}

std::vector<std::string> usable_sensors(std::vector<RecordedRun>& runs, std::string const& error,
                                        TwinObserver const* observer) {
  std::vector<std::string> sensors;  // of any run
  for (auto const& run : runs)
    for (auto const& channel : run.shown.readings)
      if (std::find(sensors.begin(), sensors.end(), channel.name) == sensors.end()) sensors.push_back(channel.name);
  if (sensors.empty())
    throw thermal::InputError(
        fmt::format("{}: no sensor is in it, and an error model follows sensors; give the "
                    "machine some, as [[temperature_sensor]]",
                    runs.front().file));
  for (auto& run : runs)
    std::erase_if(sensors, [&](std::string const& sensor) {
      auto const why = unusable(run.shown, sensor, error, observer);
      if (!why.empty()) run.remarks.push_back(fmt::format("{} is left out: {}", sensor, why));
      return !why.empty();
    });
  if (!sensors.empty()) return sensors;
  std::vector<std::string> why;
  for (auto const& run : runs)
    for (auto const& remark : run.remarks) why.push_back(run.file + ": " + remark);
  throw thermal::InputError(fmt::format("no sensor has its readings in every run: {}", fmt::join(why, "; ")));
}

void check_units(std::vector<ErrorModelRun> const& runs, std::string const& error) {
  for (auto const& run : runs)
    if (run.unit != runs.front().unit)
      throw thermal::InputError(fmt::format("{} is in {} in {}, and in {} in {}", error, run.unit, run.batch.name,
                                            runs.front().unit, runs.front().batch.name));
}

/// Of a slope: in its unit, not at positions.
Eigen::VectorXd slopes(SavedErrorModel const& saved, ErrorModelRun const& run) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(run.batch.time.size());
  for (auto const& part : saved.parts) sum += part.model.predict(run.batch);
  return sum / double(saved.parts.size());
}

FittedRun fitted_run(SavedErrorModel const& saved, ErrorModelRun const& run, std::string const& machine) {
  auto const first = saved.unclaimed_instants();
  auto const rows = run.batch.time.size() - first;
  Eigen::VectorXd const predicted = run.axis ? slopes(saved, run) : Eigen::VectorXd(saved.predict(run));
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

/// What a study would call the models whose mean is fitted. Beside a twin stands what names none, too.
std::vector<NamedModel> models_of(ErrorModelFit const& fit) {
  auto models = named_models(fit.method);
  bool const named = std::any_of(models.begin(), models.end(), [](auto const& model) { return model.twin; });
  if ((named || fit.twin) && fit.error.starts_with(slope_prefix))
    throw thermal::InputError(fmt::format("'{}': a slope is fitted without a twin", fit.error));
  if (named && !fit.twin)
    throw thermal::InputError(fmt::format("'{}': the twin's machine file is missing; give --twin FILE", fit.method));
  if (fit.twin && !named)
    for (auto& model : models) model.twin = true;
  return models;
}

/// The twin as observer, of the sensors that are named, or of all, where one of the models is it.
std::optional<TwinObserver> named_observer(std::vector<NamedModel> const& models, ErrorModelFit const& fit,
                                           std::optional<Machine> const& twin) {
  if (std::none_of(models.begin(), models.end(), [](auto const& model) { return model.observes(); }))
    return std::nullopt;
  return TwinObserver(*twin, fit.error, {}, fit.sensors.empty() ? std::nullopt : std::optional(fit.sensors));
}

/// Of what the twin as observer may believe, that with which the displacements of the runs are met best, each from a
/// zero of its own. The runs know what it tells.
ModelPart fitted_observer(Machine const& twin, std::string const& error, std::vector<RecordedRun> const& recorded,
                          std::vector<ErrorModelRun>& runs) {
  auto const& first = runs.front().batch;
  ModelPart best;
  double least = std::numeric_limits<double>::infinity();
  auto const& time = recorded.front().run->time;
  for (auto const& choice : observer_choices(usual_interval({time.data(), std::size_t(time.size())}))) {
    TwinObserver const observer(twin, error, choice, first.sensors);
    std::vector<Eigen::VectorXd> told;
    double missed = 0.0;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      told.push_back(observed_change(observer, recorded[r], runs[r]));
      auto const rest = (runs[r].batch.error - told.back()).eval();
      missed += (rest.array() - rest.mean()).square().sum();
    }
    if (!(missed < least)) continue;
    least = missed;
    best = observing_part(first.sensors, choice);
    for (std::size_t r = 0; r < runs.size(); ++r) runs[r].observed = told[r];
  }
  if (!best.observer) throw thermal::InputError("the observer tells no finite error of these runs");
  return best;
}

ModelPart fitted_part(NamedModel const& named, std::vector<ErrorModelRun> const& runs, std::uint64_t seed) {
  std::vector<models::Batch> batches;
  for (auto const& run : runs) batches.push_back(named.twin ? run.less_twin() : run.batch);
  if (named.method.empty()) return {nothing_more(batches.front().sensors), true, {}};
  return {models::model_method(named.method).fit(batches, {.seed = seed}), named.twin, input_ranges(batches)};
}

void fit_parts(SavedErrorModel& saved, std::vector<NamedModel> const& models, std::vector<ErrorModelRun> const& runs,
               std::optional<ModelPart> const& observer, std::uint64_t seed) {
  for (auto const& named : models)
    saved.parts.push_back(named.observes() ? observer.value() : fitted_part(named, runs, seed));
  std::vector<models::AxisRecord> records;
  for (auto const& run : runs)
    if (run.axis) records.push_back(*run.axis);
  if (!records.empty()) saved.zero_position = models::zero_position(records);
}

/// By how much the prediction changes with each input that shows 1 K more all along [unit/K].
Eigen::VectorXd changes_per_kelvin(SavedErrorModel const& saved) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(Eigen::Index(saved.inputs().size()));
  for (auto const& part : saved.parts)
    if (auto const* linear = std::get_if<models::LinearForm>(&part.model.form); linear && part.reads())
      if (!part.observer) sum += linear->coefficients.rowwise().sum();
  return sum / double(saved.parts.size());
}

double rms_of_error(std::vector<ErrorModelRun> const& runs) {
  double sum = 0.0, rows = 0.0;
  for (auto const& run : runs) {
    sum += run.batch.error.squaredNorm();
    rows += double(run.batch.error.size());
  }
  return std::sqrt(sum / rows);
}

constexpr double usual_sensor_error = 0.1;  ///< [K]
constexpr double times_the_rmse = 10.0, share_of_the_error = 0.1;

/// What an error of the sensors does to the prediction, where that is more than ten times what the model errs by and a
/// tenth of the error: coefficients that large cancel each other. Empty: it is not.
std::string sensor_error_remark(SavedErrorModel const& saved, double error) {
  Eigen::VectorXd const changes = usual_sensor_error * changes_per_kelvin(saved);
  if (changes.norm() <= std::max(times_the_rmse * saved.rmse(), share_of_the_error * error)) return {};
  Eigen::Index most = 0;
  double const largest = changes.cwiseAbs().maxCoeff(&most);
  return fmt::format(
      "an error of {:g} K moves the prediction by {:.3g} {} in {} alone, by {:.3g} {} in each sensor at random; the "
      "RMSE is {:.3g} {}: sensors that show nearly the same? Name fewer, or take a method with a penalty (ridge)",
      usual_sensor_error, largest, saved.unit, saved.inputs()[std::size_t(most)], changes.norm(), saved.unit,
      saved.rmse(), saved.unit);
}

/// What models say of data that they refuse, with the runs that these are; some say which by themselves.
std::string refusal_of(std::vector<RecordedRun> const& runs, std::optional<double> sampling, std::string const& why) {
  if (why.starts_with("batch '")) return why;
  std::vector<std::string> files;
  for (auto const& run : runs) files.push_back(run.file);
  return fmt::format("{}{}: {}", fmt::join(files, ", "), sampling ? fmt::format(", means over {:g} s", *sampling) : "",
                     why);
}

}  // namespace

SavedErrorModel fit_error_model(ErrorModelFit const& fit, std::vector<std::string>& remarks) {
  std::vector<NamedModel> models;
  try {
    models = models_of(fit);
  } catch (std::invalid_argument const& error) {
    throw thermal::InputError(error.what());
  }
  auto const beside = fit.twin ? std::optional(twin_beside(*fit.twin)) : std::nullopt;
  auto const twin = beside ? std::optional(twin_of(*beside)) : std::nullopt;
  auto const observing = named_observer(models, fit, twin);
  std::vector<RecordedRun> recorded;
  auto const names = distinct_names(fit.runs);
  for (std::size_t r = 0; r < fit.runs.size(); ++r) {
    recorded.push_back(read_recorded_run(fit.runs[r], fit.sampling, twin ? &*twin : nullptr));
    recorded.back().file = names[r].string();
  }
  if (observing)
    for (auto& run : recorded) run.admit_observer(twin->name);
  auto const sensors =
      fit.sensors.empty() ? usable_sensors(recorded, fit.error, observing ? &*observing : nullptr) : fit.sensors;
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
    auto const observer = observing ? std::optional(fitted_observer(*twin, fit.error, recorded, runs)) : std::nullopt;
    fit_parts(saved, models, runs, observer, fit.seed);
    for (std::size_t r = 0; r < runs.size(); ++r) saved.runs.push_back(fitted_run(saved, runs[r], recorded[r].machine));
  } catch (std::invalid_argument const& error) {
    throw thermal::InputError(refusal_of(recorded, fit.sampling, error.what()));
  }
  for (auto const& run : recorded)
    for (auto const& remark : run.remarks) remarks.push_back(run.file + ": " + remark);
  if (auto const remark = sensor_error_remark(saved, rms_of_error(runs)); !remark.empty()) remarks.push_back(remark);
  return saved;
}

}  // namespace thermotwin::twin
