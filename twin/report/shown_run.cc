#include "twin/report/shown_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "output/csv.h"
#include "output/dataset_file.h"
#include "thermal/units.h"
#include "twin/diagnosis/measurement_file.h"

namespace thermotwin::twin {
namespace {

using output::Channel;
using output::Json;
using output::ReportPage;

constexpr double square_share = 0.1 * 0.1;  // of the highest speed

std::string edge_unit(scenarios::SampledInput const& input) {
  if (input.unit == "K" && input.absolute_temperature) return "degC";
  if (input.unit == "rad/s") return "rpm";
  if (input.unit == "m/s") return "mm/min";
  return input.unit == "m" ? "mm" : input.unit;
}

/// The last sample at or before each time; none before the first.
Channel on_times(scenarios::SampledInput const& input, Eigen::VectorXd const& time) {
  Channel channel{input.name, edge_unit(input), "", Eigen::VectorXd(time.size())};
  std::size_t next = 0;
  double last = std::numeric_limits<double>::quiet_NaN();
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    for (; next < input.times.size() && input.times[next] <= time[i]; ++next)
      if (std::isfinite(input.values[next])) last = input.values[next];
    channel.values[i] = channel.unit == "1" ? last : thermal::to_unit(last, channel.unit);
  }
  return channel;
}

output::Dataset dataset_of(MeasuredData const& measured, std::filesystem::path const& path) {
  output::Dataset data;
  data.title = path.stem().string();
  data.time_s = measured.time;
  for (auto const& input : measured.inputs) data.inputs.push_back(on_times(input, measured.time));
  data.readings = measured.readings;
  data.displacements = measured.displacements;
  return data;
}

bool is_constant(Eigen::VectorXd const& values) {
  return values.size() > 0 && std::isfinite(values[0]) && (values.array() == values[0]).all();
}

Json channels_json(std::vector<Channel> const& channels, ReportPage& page) {
  Json list = Json::array();
  for (auto const& channel : channels) {
    Json json = {{"name", channel.name}, {"unit", channel.unit}, {"title", channel.long_name}};
    json["values"] = page.add_numbers(channel.values);
    list.push_back(json);
  }
  return list;
}

Json inputs_json(std::vector<Channel> const& inputs, ReportPage& page) {
  Json list = Json::array();
  for (auto const& input : inputs) {
    Json json = {{"name", input.name}, {"unit", input.unit}, {"title", input.long_name}};
    if (is_constant(input.values))
      json["constant"] = input.values[0];
    else
      json["values"] = page.add_numbers(input.values);
    list.push_back(json);
  }
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
  if (path.extension() == ".csv")
    run.data = output::import_csv(path);
  else if (path.extension() == ".toml")
    run.data = dataset_of(read_measurement_file(path), path);
  else
    run.data = output::read(path);
  run.simulated = run.data.provenance.contains("solver.steps") || !run.data.complete;
  run.without_instruments = show_truth_for_now(run.data);
  return run;
}

bool driven_alike(ShownRun const& reference, ShownRun const& other) {
  if (reference.data.time_s.size() == 0) return true;
  for (auto const& mine : reference.data.inputs)
    for (auto const& theirs : other.data.inputs) {
      if (mine.name != theirs.name || (mine.unit != "rpm" && mine.unit != "mm/min")) continue;
      Eigen::ArrayXd const there = output::at_times(theirs.values, other.data.time_s, reference.data.time_s);
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
  return {{"name", run.path.stem().string()},
          {"title", data.title},
          {"simulated", run.simulated},
          {"complete", data.complete},
          {"time", page.add_numbers(data.time_s)},
          {"inputs", inputs_json(data.inputs, page)},
          {"readings", channels_json(data.readings, page)},
          {"displacements", channels_json(data.displacements, page)},
          {"heat", channels_json(data.heat, page)},
          {"positioning", positioning_json(data.positioning, page)},
          {"facts", facts_json(data.provenance)}};
}

}  // namespace thermotwin::twin
