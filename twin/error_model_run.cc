#include "twin/error_model_run.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

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

output::Channel const& channel_named(std::vector<output::Channel> const& group, std::string const& name,
                                     std::string const& file, char const* kind) {
  if (auto const* channel = find_channel(group, name)) return *channel;
  auto const known = names_of(group);
  throw InputError(fmt::format("{} has no {} '{}'; {}", file, kind, name, thermal::did_you_mean(name, known)));
}

output::Channel const& sensor_named(output::Dataset const& data, std::string const& name, std::string const& file) {
  return channel_named(data.readings, name, file, "sensor");
}

output::Channel const& displacement_named(output::Dataset const& data, std::string const& name,
                                          std::string const& file) {
  return channel_named(data.displacements, name, file, "displacement");
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

MeasuredRun without_machine(MeasuredData const& data) {
  MeasuredRun run;
  run.time = data.time;
  run.remarks = data.remarks;
  run.channels = channels_of(data, run.remarks);
  return run;
}

/// Changes of sensors and error since the first of these rows.
void take_changes(output::Dataset const& data, std::string const& error, std::vector<Index> const& rows,
                  models::Batch& batch) {
  auto const change = [&](output::Channel const& channel) {
    return VectorXd(channel.values(rows).array() - channel.values[rows.front()]);
  };
  batch.temperature_rise.resize(Index(rows.size()), Index(batch.sensors.size()));
  for (std::size_t j = 0; j < batch.sensors.size(); ++j)
    batch.temperature_rise.col(Index(j)) = change(sensor_named(data, batch.sensors[j], batch.name));
  batch.error = VectorXd::Zero(Index(rows.size()));
  if (find_channel(data.displacements, error)) batch.error = change(displacement_named(data, error, batch.name));
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
    auto run = twin ? measured_run(data, *twin, result.file) : without_machine(data);
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
  bool const slope = error.starts_with(slope_prefix);
  auto const axis = slope ? error.substr(slope_prefix.size()) : std::string();
  std::vector<output::Channel const*> used;
  for (auto const& sensor : sensors) used.push_back(&sensor_named(data, sensor, run.file));
  auto const* shown = slope ? nullptr : find_channel(data.displacements, error);
  if (!slope && (shown || must_show)) used.push_back(&displacement_named(data, error, run.file));
  ErrorModelRun result;
  result.rows = complete_rows(used, run.file, run.remarks);
  auto const& rows = result.rows;
  auto& batch = result.batch;
  batch = {run.file, data.time_s(rows), sensors, sensors, {}, {}};
  take_changes(data, error, rows, batch);
  for (std::size_t j = 0; j < sensors.size(); ++j)
    result.zero.push_back(std::round(1e3 * used[j]->values[rows.front()]) / 1e3);
  if (run.said) {
    result.said = batch;
    take_changes(*run.said, error, rows, *result.said);
  }
  if (slope) {
    result.axis = axis_record(batch, laser_of(data.positioning, axis, run.file));
    batch = models::slope_batch(*result.axis);
    result.unit = "um/m";
    result.title = fmt::format("of axis {}'s position error over its travel", axis);
  } else if (shown) {
    result.unit = shown->unit;
    result.title = shown->long_name;
  }
  result.shown = slope || shown;
  result.fingerprint = fingerprint_of(result);
  return result;
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
