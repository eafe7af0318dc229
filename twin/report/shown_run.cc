#include "twin/report/shown_run.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "output/csv.h"
#include "output/dataset_file.h"
#include "thermal/error.h"
#include "thermal/units.h"
#include "twin/diagnosis/measurement_file.h"
#include "twin/edge_unit.h"
#include "twin/file/distinct_names.h"
#include "twin/file/tables.h"

namespace thermotwin::twin {
namespace {

using output::Channel;
using output::Json;
using output::ReportPage;

constexpr double square_share = 0.1 * 0.1;  // of the highest speed
constexpr double usual_intervals = 10.0;    // at least, of a gap

/// The last sample at or before each time; none before the first.
Channel on_times(scenarios::SampledInput const& input, Eigen::VectorXd const& time) {
  Channel channel{input.name, input.unit, "", Eigen::VectorXd(time.size())};
  std::size_t next = 0;
  double last = std::numeric_limits<double>::quiet_NaN();
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    for (; next < input.times.size() && input.times[next] <= time[i]; ++next)
      if (std::isfinite(input.values[next])) last = input.values[next];
    channel.values[i] = last;
  }
  return channel;
}

std::string title_of_measurement(std::filesystem::path const& measurement_file) {
  MeasurementFile file;
  read_fields(read_toml(measurement_file), file);
  return file.title.empty() ? measurement_file.stem().string() : file.title;
}

output::Dataset dataset_of(MeasuredData const& measured) {
  output::Dataset data;
  data.time_s = measured.time;
  for (auto const& input : measured.inputs) data.inputs.push_back(on_times(input, measured.time));
  data.readings = measured.readings;
  data.displacements = measured.displacements;
  return data;
}

void convert(Channel& channel, std::string const& unit) {
  if (channel.unit == unit || channel.unit.empty()) return;
  thermal::from_unit({channel.values.data(), std::size_t(channel.values.size())}, channel.unit);
  auto const shown = read_edge_unit(unit);
  for (double& value : channel.values) value = edge_value(value, shown);
  channel.unit = unit;
}

/// A sensor shows a temperature, an input what it is by its name, and the rest lengths and angles.
void write_as_run_does(output::Dataset& data) {
  auto const dimension_of = [](Channel const& channel) {
    return thermal::dimension_of(channel.unit.empty() ? "1" : channel.unit);
  };
  for (auto& input : data.inputs) convert(input, edge_unit({input.name, thermal::unit_of(dimension_of(input)), ""}));
  for (auto& reading : data.readings)
    if (dimension_of(reading) == thermal::dimension::temperature_difference) convert(reading, "degC");
  for (auto& displacement : data.displacements)
    if (auto const dimension = dimension_of(displacement); dimension == thermal::dimension::length)
      convert(displacement, "um");
    else if (dimension == thermal::dimension::angle)
      convert(displacement, "urad");
}

/// Of the samples of a channel, as of those of an input (diagnosis/input_gap.h); infinite for a simulated run.
double longest_gap(ShownRun const& run, Eigen::VectorXd const& values) {
  std::vector<double> times;
  for (Eigen::Index row = 0; row < values.size(); ++row)
    if (std::isfinite(values[row])) times.push_back(run.data.time_s[row]);
  return std::max(run.max_gap, usual_intervals * usual_interval(times));
}

bool is_constant(Eigen::VectorXd const& values) {
  return values.size() > 0 && std::isfinite(values[0]) && (values.array() == values[0]).all();
}

Json channel_json(ShownRun const& run, Channel const& channel, ReportPage& page) {
  Json json = {{"name", channel.name}, {"unit", channel.unit}, {"title", channel.long_name}};
  json["values"] = page.add_numbers(channel.values);
  if (double const gap = longest_gap(run, channel.values); std::isfinite(gap)) json["longest_gap"] = gap;
  return json;
}

Json channels_json(ShownRun const& run, std::vector<Channel> const& channels, ReportPage& page) {
  Json list = Json::array();
  for (auto const& channel : channels) list.push_back(channel_json(run, channel, page));
  return list;
}

Json inputs_json(ShownRun const& run, ReportPage& page) {
  Json list = Json::array();
  for (auto const& input : run.data.inputs)
    if (is_constant(input.values))
      list.push_back(
          {{"name", input.name}, {"unit", input.unit}, {"title", input.long_name}, {"constant", input.values[0]}});
    else
      list.push_back(channel_json(run, input, page));
  return list;
}

Json positioning_json(std::vector<output::Positioning> const& passes, ReportPage& page) {
  Json list = Json::array();
  for (auto const& axis : passes)
    list.push_back({{"axis", axis.axis},
                    {"position_mm", page.add_numbers(axis.position_mm)},
                    {"time", page.add_numbers(axis.time_s)},
                    {"forward_um", page.add_numbers(axis.forward_um)},
                    {"backward_um", page.add_numbers(axis.backward_um)}});
  return list;
}

/// What a reader may ask: who made it, does its balance close.
Json facts_json(std::map<std::string, std::string> const& provenance) {
  Json facts = Json::object();
  for (char const* key : {"version", "commit", "seed", "settings", "energy.imbalance", "solver.linear", "solver.steps"})
    if (auto const it = provenance.find(key); it != provenance.end() && !it->second.empty()) facts[key] = it->second;
  return facts;
}

bool has_values(std::vector<Channel> const& channels) {
  return std::any_of(channels.begin(), channels.end(), [](auto const& c) { return c.values.array().isFinite().any(); });
}

/// A run that goes on has no readings yet, but their truth.
bool show_truth_for_now(output::Dataset& data) {
  if (data.complete || has_values(data.readings) || has_values(data.displacements)) return false;
  if (!data.truth_readings.empty()) data.readings = data.truth_readings;
  if (!data.truth_displacements.empty()) data.displacements = data.truth_displacements;
  return true;
}

}  // namespace

ShownRun read_shown_run(std::filesystem::path const& path) {
  ShownRun run{path.extension() == ".partial" ? std::filesystem::path(path).replace_extension() : path, {}};
  run.name = run.path.filename();
  double max_gap = MeasuredData().max_gap;
  if (path.extension() == ".csv") {
    run.data = output::import_csv(path);
  } else if (path.extension() == ".toml") {
    auto const measured = read_measurement_file(path);
    run.data = dataset_of(measured);
    run.data.title = title_of_measurement(path);
    run.machine = measured.machine;
    run.machine_file = measured.machine_file;
    max_gap = measured.max_gap;
  } else {
    run.data = output::read(path);
  }
  run.simulated = run.data.provenance.contains("solver.steps") || !run.data.complete;
  run.without_instruments = show_truth_for_now(run.data);
  try {
    write_as_run_does(run.data);
  } catch (thermal::InputError const& error) {
    throw thermal::InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
  if (!run.simulated) run.max_gap = max_gap;
  return run;
}

void name_distinctly(std::vector<ShownRun>& runs) {
  std::vector<std::filesystem::path> paths;
  for (auto const& run : runs) paths.push_back(run.path);
  auto const names = distinct_names(paths);
  for (std::size_t r = 0; r < runs.size(); ++r) runs[r].name = names[r];
}

Samples samples_of(ShownRun const& run, Eigen::VectorXd const& values) {
  auto const& times = run.data.time_s;
  double const gap = longest_gap(run, values);
  if (!std::isfinite(gap)) return {times, values};
  std::vector<double> time, shown;
  for (Eigen::Index row = 0; row < times.size(); ++row) {
    if (std::isnan(values[row])) continue;
    if (!time.empty() && times[row] - time.back() > gap) {
      time.push_back(0.5 * (time.back() + times[row]));
      shown.push_back(std::nan(""));
    }
    time.push_back(times[row]);
    shown.push_back(values[row]);
  }
  auto const vector = [](std::vector<double> const& list) -> Eigen::VectorXd {
    return Eigen::Map<Eigen::VectorXd const>(list.data(), Eigen::Index(list.size()));
  };
  return {vector(time), vector(shown)};
}

bool driven_alike(ShownRun const& reference, ShownRun const& other) {
  if (reference.data.time_s.size() == 0) return true;
  for (auto const& mine : reference.data.inputs)
    for (auto const& theirs : other.data.inputs) {
      if (mine.name != theirs.name || (mine.unit != "rpm" && mine.unit != "mm/min")) continue;
      auto const known_there = samples_of(other, theirs.values);
      Eigen::ArrayXd const there = output::at_times(known_there.values, known_there.time_s, reference.data.time_s);
      Eigen::ArrayXd const difference = mine.values.array() - there;
      auto const known = difference.isFinite();
      double const highest = known.select(mine.values.array().abs().max(there.abs()), 0.0).maxCoeff();
      double const squares = known.select(difference.square(), 0.0).sum();
      if (squares > square_share * highest * highest * double(known.count())) return false;
    }
  return true;
}

Json run_json(ShownRun const& run, ReportPage& page) {
  auto const& data = run.data;
  return {{"name", run.stem()},
          {"title", data.title},
          {"simulated", run.simulated},
          {"complete", data.complete},
          {"time", page.add_numbers(data.time_s)},
          {"inputs", inputs_json(run, page)},
          {"readings", channels_json(run, data.readings, page)},
          {"displacements", channels_json(run, data.displacements, page)},
          {"heat", channels_json(run, data.heat, page)},
          {"positioning", positioning_json(data.positioning, page)},
          {"facts", facts_json(data.provenance)}};
}

}  // namespace thermotwin::twin
