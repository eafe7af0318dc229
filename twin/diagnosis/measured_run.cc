#include "twin/diagnosis/measured_run.h"

#include <cmath>
#include <fmt/format.h>

#include "models/quantile.h"
#include "output/csv.h"
#include "output/dataset_file.h"
#include "thermal/error.h"
#include "thermal/units.h"
#include "twin/diagnosis/measured_data.h"
#include "twin/diagnosis/measurement_file.h"
#include "twin/file/value.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

constexpr Eigen::Index fewest_rows = 10;
constexpr double begin_of_run = 120.0;  // [s]

scenarios::SampledInput sampled(output::Channel const& channel, Eigen::VectorXd const& time) {
  scenarios::SampledInput input;
  std::string const unit = channel.unit.empty() ? "1" : channel.unit;
  input.name = channel.name;
  input.unit = thermal::unit_of(thermal::dimension_of(unit));
  input.absolute_temperature = unit == "degC";
  input.times.assign(time.begin(), time.end());
  input.values.assign(channel.values.begin(), channel.values.end());
  thermal::from_unit(input.values, unit);
  return input;
}

/// The name in the machine's file, which a simulated run keeps.
std::string recorded_machine(output::Dataset const& dataset) {
  auto const text = dataset.provenance.find("machine.file");
  if (text == dataset.provenance.end()) return {};
  auto const document = parse_toml(text->second, "machine");
  auto const* name = document.find("name");
  return name && name->is_text() ? std::get<std::string>(name->content) : std::string();
}

std::string without_fine(std::string name) {
  if (name.ends_with("_fine")) name.erase(name.size() - std::string_view("_fine").size());
  return name;
}

}  // namespace

Eigen::VectorXd MeasuredRun::input(std::string_view name, Eigen::VectorXd const& times) const {
  int const channel = course->index_of(name);
  if (channel < 0) return {};
  std::vector<double> values(course->channels().size());
  return times.unaryExpr([&](double t) {
    course->evaluate(t, values);
    return values[std::size_t(channel)];
  });
}

double MeasuredRun::first_reading(Eigen::Index channel) const {
  for (Eigen::Index i = 0; i < time.size() && time[i] <= begin_of_run; ++i)
    if (double const value = channels[std::size_t(channel)].values[i]; !std::isnan(value)) return value;
  return NAN;
}

bool is_same_machine(std::string const& one, std::string const& other) {
  return without_fine(one) == without_fine(other);
}

double usual_interval(std::span<double const> times) {
  if (times.size() < 2) return INFINITY;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times.size(); ++i) intervals.push_back(times[i] - times[i - 1]);
  return models::upper_median(std::move(intervals));
}

MeasuredRun measured_run(MeasuredData const& data, std::string const& name) {
  MeasuredRun run;
  run.name = name;
  run.time = data.time;
  run.remarks = data.remarks;
  run.channels = channels_of(data, run.remarks);
  return run;
}

MeasuredRun measured_run(MeasuredData data, Machine const& machine, std::string const& name) {
  Eigen::Index const rows = data.time.size();
  if (rows < fewest_rows)
    throw InputError(fmt::format("the run has {} row{}, too few to identify anything; at least {} are due", rows,
                                 rows == 1 ? "" : "s", fewest_rows));
  MeasuredRun run;
  run.name = name;
  run.remarks = data.remarks;
  run.time = data.time;
  run.initial_temperature = data.initial_temperature;
  if (!data.machine.empty() && !is_same_machine(data.machine, machine.name))
    run.remarks.push_back(fmt::format("it is a run of '{}', the machine file is '{}'", data.machine, machine.name));
  run.channels = channels_of(data, machine, run.remarks);
  add_courses(run, std::move(data), machine);
  run.begin_with(warm_start(machine, run));
  return run;
}

void MeasuredRun::begin_with(std::optional<WarmStart> warmth) {
  warm_start = std::move(warmth);
  if (warm_start)
    remarks.push_back(
        fmt::format("it does not begin at rest with the room (first readings: {}); how warm each part was is estimated",
                    warm_start->farthest));
}

MeasuredData measured_data(output::Dataset const& dataset) {
  output::check(dataset);
  MeasuredData data;
  data.machine = recorded_machine(dataset);
  double const start = dataset.time_s.size() > 0 ? dataset.time_s[0] : 0.0;
  data.time = dataset.time_s.array() - start;
  data.readings = dataset.readings;
  data.displacements = dataset.displacements;
  for (auto const& channel : dataset.inputs) {
    data.inputs.push_back(sampled(channel, data.time));
    leave_out_impossible(data.inputs.back(), data.remarks);
  }
  if (start != 0.0) data.remarks.push_back(fmt::format("the data start at {} s; the run is counted from there", start));
  if (!dataset.complete) data.remarks.push_back("the data set is marked as incomplete");
  return data;
}

MeasuredRun measured_run(output::Dataset const& dataset, Machine const& machine, std::string const& name) {
  return measured_run(measured_data(dataset), machine, name);
}

MeasuredData read_measured_data(std::filesystem::path const& path) {
  return naming(path, [&] {
    if (path.extension() == ".toml") return read_measurement_file(path);
    if (path.extension() == ".csv") return measured_data(output::import_csv(path));
    if (path.extension() == ".h5") return measured_data(output::read(path));
    throw InputError(
        fmt::format("'{}' is no measured run; a data set (.h5), a table (.csv) or a measurement file "
                    "(.toml) is due",
                    path.string()));
  });
}

MeasuredRun read_measured_run(std::filesystem::path const& path, Machine const& machine) {
  return naming(path, [&] { return measured_run(read_measured_data(path), machine, path.stem().string()); });
}

}  // namespace thermotwin::twin
