#include "twin/error_model_run.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "output/dataset_file.h"
#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "thermal/units.h"
#include "twin/axis_record.h"
#include "twin/compensation/observed_run.h"
#include "twin/complete_rows.h"
#include "twin/diagnosis/measured_data.h"
#include "twin/diagnosis/prediction.h"
#include "twin/fingerprint.h"
#include "twin/study/study_runs.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using thermal::InputError;

/// What a run has in place of a name that it lacks. One that is asked for beside it is not what was meant.
std::string instead_of(std::string const& name, std::vector<output::Channel> const& group,
                       std::vector<std::string> const& asked) {
  auto const there = names_of(group);
  auto free = there;
  std::erase_if(free, [&](auto const& other) { return std::find(asked.begin(), asked.end(), other) != asked.end(); });
  if (free.empty() && !there.empty()) return fmt::format("it has {}", fmt::join(there, ", "));
  return thermal::did_you_mean(name, free);
}

output::Channel const& sensor_named(output::Dataset const& data, std::string const& name,
                                    std::vector<std::string> const& asked, std::string const& file) {
  if (auto const* sensor = find_channel(data.readings, name)) return *sensor;
  if (auto const* other = find_channel(data.displacements, name))
    throw InputError(fmt::format("{} has no sensor '{}': it is there in {}", file, name, other->unit));
  throw InputError(fmt::format("{} has no sensor '{}'; {}", file, name, instead_of(name, data.readings, asked)));
}

output::Channel const& displacement_named(output::Dataset const& data, std::string const& name,
                                          std::string const& file) {
  if (auto const* displacement = find_channel(data.displacements, name)) return *displacement;
  if (name.find(',') != std::string::npos)
    throw InputError(fmt::format("'{}': a model is of one error; name one at a time", name));
  if (auto const* other = find_channel(data.readings, name))
    throw InputError(fmt::format("{} has no displacement '{}': it is there in {}", file, name, other->unit));
  throw InputError(
      fmt::format("{} has no displacement '{}'; {}", file, name, instead_of(name, data.displacements, {})));
}

/// Units and titles are those of the record; dataset_of() gives numbers in µm and µrad.
void take_titles(MeasuredData const& data, output::Dataset& shown) {
  for (auto& channel : shown.displacements) {
    auto const& recorded = *find_channel(data.displacements, channel.name);
    channel.long_name = recorded.long_name;
    if (thermal::dimension_of(recorded.unit) == thermal::dimension::angle) channel.unit = "urad";
  }
}

std::string fingerprint_of(ErrorModelRun const& run) {
  Fingerprint print;
  auto const add = [&](auto const& numbers) { print.add(std::span(numbers.data(), std::size_t(numbers.size()))); };
  add(run.batch.time);
  add(run.batch.temperature_rise);
  add(run.batch.error);
  if (run.axis) {
    add(run.axis->position);
    add(run.axis->error);
  }
  return print.text();
}

/// Which of these rows lack a value, counted in them.
std::vector<Index> lacking(output::Channel const& channel, std::vector<Index> const& rows) {
  std::vector<Index> without;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!std::isfinite(channel.values[rows[i]])) without.push_back(Index(i));
  return without;
}

/// Since the first of these rows that has a value; 0 where there is none.
VectorXd changes_of(output::Channel const& channel, std::vector<Index> const& rows) {
  VectorXd const values = channel.values(rows);
  auto const first = std::find_if(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  double const zero = first == values.end() ? 0.0 : *first;
  return values.unaryExpr([&](double value) { return std::isfinite(value) ? value - zero : 0.0; });
}

/// Changes of sensors and error since the first of these rows.
void take_changes(output::Dataset const& data, std::string const& error, std::vector<Index> const& rows,
                  models::Batch& batch) {
  batch.temperature_rise.resize(Index(rows.size()), Index(batch.sensors.size()));
  for (std::size_t j = 0; j < batch.sensors.size(); ++j)
    batch.temperature_rise.col(Index(j)) =
        changes_of(sensor_named(data, batch.sensors[j], batch.sensors, batch.name), rows);
  auto const* shown = find_channel(data.displacements, error);
  batch.error = shown ? changes_of(*shown, rows) : VectorXd(VectorXd::Zero(Index(rows.size())));
}

/// A run in these rows of its record, in which all sensors have a value.
ErrorModelRun run_in_rows(RecordedRun const& run, std::vector<std::string> const& sensors, std::string const& error,
                          std::vector<Index> const& rows) {
  auto const& data = run.shown;
  ErrorModelRun result;
  result.rows = rows;
  auto& batch = result.batch;
  batch = {run.file, data.time_s(rows), sensors, sensors, {}, {}};
  take_changes(data, error, rows, batch);
  for (auto const& sensor : sensors)
    result.zero.push_back(std::round(1e3 * find_channel(data.readings, sensor)->values[rows.front()]) / 1e3);
  if (run.said) {
    result.said = batch;
    take_changes(*run.said, error, rows, *result.said);
  }
  if (error.starts_with(slope_prefix)) {
    auto const axis = error.substr(slope_prefix.size());
    result.axis = axis_record(batch, laser_of(data.positioning, axis, run.file));
    batch = models::slope_batch(*result.axis);
    result.unit = "um/m";
    result.title = fmt::format("of axis {}'s position error over its travel", axis);
  } else if (auto const* shown = find_channel(data.displacements, error)) {
    result.unit = shown->unit;
    result.title = shown->long_name;
    result.without_error = lacking(*shown, rows);
    result.shown = result.without_error.size() < rows.size();
  } else {
    result.shown = false;
  }
  result.fingerprint = fingerprint_of(result);
  return result;
}

/// What a fit would see of a run that shows the error in some of its rows.
std::string fingerprint_of_complete(RecordedRun const& recorded, ErrorModelRun const& run, std::string const& error) {
  std::vector<Index> complete;
  for (Index const row : run.rows)
    if (std::isfinite(find_channel(recorded.shown.displacements, error)->values[row])) complete.push_back(row);
  return run_in_rows(recorded, run.batch.sensors, error, complete).fingerprint;
}

/// Sensors that never moved, and what they showed [°C].
std::map<std::string, double> still_sensors(MeasuredRun const& run) {
  std::map<std::string, double> still;
  for (auto const& channel : run.channels)
    if (channel.still && !channel.displacement) still[channel.name] = thermal::to_unit(*channel.still, "degC");
  return still;
}

}  // namespace

void RecordedRun::believe_still(std::vector<std::string> const& sensors) {
  for (auto& channel : shown.readings) {
    auto const value = still.find(channel.name);
    if (value == still.end() || std::find(sensors.begin(), sensors.end(), channel.name) == sensors.end()) continue;
    std::erase(remarks, remark_of_still(channel.name));
    channel.values.setConstant(value->second);
    remarks.push_back(fmt::format("'{}' shows {:g} degC throughout: its change is taken as 0, unless it is dead",
                                  channel.name, value->second));
  }
}

RecordedRun read_recorded_run(std::filesystem::path const& path, std::optional<double> sampling, Machine const* twin) {
  RecordedRun result{path.filename().string(), {}, {}, {}, {}};
  bool const whole = path.extension() == ".h5";
  auto const file = whole ? output::read(path) : output::Dataset();
  auto const data = whole ? measured_data(file) : read_measured_data(path);
  try {
    auto run = twin ? measured_run(data, *twin, result.file) : measured_run(data, result.file);
    result.remarks = run.remarks;
    double const own = usual_interval({run.time.data(), std::size_t(run.time.size())});
    if (sampling && *sampling < own * (1.0 - 1e-6))
      throw InputError(fmt::format("a sampling of {:g} s is finer than the {:g} s between its rows", *sampling, own));
    result.machine = data.machine;
    result.still = still_sensors(run);
    result.shown = dataset_of(run, sampling);
    take_titles(data, result.shown);
    result.shown.positioning = file.positioning;
    for (auto& laser : result.shown.positioning) laser.time_s.array() -= file.time_s[0] + run.time[first_reading(run)];
    if (!twin) return result;
    auto const values = predict(*twin, run);
    result.said = dataset_of(run, sampling, &values);
    result.sampling = sampling;
    result.run = std::make_shared<MeasuredRun const>(std::move(run));
    return result;
  } catch (InputError const& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

ErrorModelRun error_model_run(RecordedRun& run, std::vector<std::string> const& sensors, std::string const& error,
                              bool must_show) {
  auto const& data = run.shown;
  std::vector<output::Channel const*> used;
  for (auto const& sensor : sensors) used.push_back(&sensor_named(data, sensor, sensors, run.file));
  if (must_show && !error.starts_with(slope_prefix)) used.push_back(&displacement_named(data, error, run.file));
  auto result = run_in_rows(run, sensors, error, complete_rows(used, run.file, run.remarks));
  if (!result.shown || result.without_error.empty()) return result;
  result.fingerprint = fingerprint_of_complete(run, result, error);
  run.remarks.push_back(fmt::format("{} of {} rows show no {}; the others are judged", result.without_error.size(),
                                    result.rows.size(), error));
  return result;
}

Index ErrorModelRun::first_with_error() const {
  std::size_t first = 0;
  while (first < without_error.size() && without_error[first] == Index(first)) ++first;
  return Index(first);
}

void RecordedRun::admit_observer(std::string const& observed) {
  if (!machine.empty() && !is_same_machine(machine, observed))
    throw InputError(fmt::format("{} is a run of '{}'; '{} {}' observes '{}'", file, machine, twin_alone,
                                 observer_method, observed));
  if (auto const remark = observer_remark(*run); !remark.empty()) remarks.push_back(remark);
}

VectorXd observed_change(TwinObserver const& observer, RecordedRun const& recorded, ErrorModelRun const& run) {
  models::check(run.batch);
  try {
    VectorXd const error = observed_error(observer, *recorded.run, recorded.sampling)(run.rows);
    return error.array() - error[0];
  } catch (InputError const& error) {
    throw InputError(fmt::format("{}: the observer: {}", recorded.file, error.what()));
  }
}

models::Batch ErrorModelRun::less_twin() const {
  models::Batch rest = batch;
  rest.temperature_rise -= said.value().temperature_rise;
  rest.error -= said->error;
  return rest;
}

}  // namespace thermotwin::twin
