#pragma once

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "twin/diagnosis/binned_run.h"
#include "twin/diagnosis/noise_model.h"
#include "twin/experiment_file.h"
#include "twin/file/value.h"
#include "twin/run.h"

/// Machines that hide something, and what they show: for the tests of the diagnosis.
namespace thermotwin::twin::tests {

/// The lumped machine with sensors that show what is there. Their lag is the twin's to find: where it is none, the
/// estimate lies on its bound.
inline Value v450() {
  Value document = read_toml(std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "twin/machines/v450.toml");
  for (int i = 1; i <= 10; ++i) set_parameter(document, "temperature_sensor.T" + std::to_string(i) + ".kind", "ideal");
  return document;
}

inline Value with_table(Value document, std::string const& text) {
  Value const addition = parse_toml(text, "addition.toml");
  auto& content = std::get<Value::Table>(document.content);
  for (auto const& entry : std::get<Value::Table>(addition.content)) {
    Value* list = document.find(entry.key);
    if (!list) {
      content.push_back(entry);
      continue;
    }
    for (auto const& table : std::get<Value::List>(entry.value.content))
      std::get<Value::List>(list->content).push_back(table);
  }
  return document;
}

inline scenarios::Experiment experiment(std::string const& text) {
  return read_experiment(parse_toml("machine = \"v450\"\n" + text, "experiment.toml"), "experiment.toml");
}

/// Two speeds, a rest and another speed, each as long as that, in a room that swings.
inline scenarios::Experiment two_speeds(std::string const& first = "80 min", std::string const& second = "50 min",
                                        std::string const& rest = "50 min", std::string const& last = "1 h") {
  return experiment(R"(
    duration = "4 h"
    ambient.mean = "22 degC"
    ambient.daily_cycle.amplitude = "1.5 K"
    [spindle]
    blocks = [{duration = ")" +
                    first + R"(", speed = "5000 rpm"}, {duration = ")" + second + R"(", speed = "2500 rpm"},
              {duration = ")" +
                    rest + R"(", speed = "0 rpm"}, {duration = ")" + last + R"(", speed = "4000 rpm"}])");
}

/// The record of a logger that was off from one time to another [s].
inline output::Dataset without_rows(output::Dataset dataset, double from, double to) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < dataset.time_s.size(); ++i)
    if (dataset.time_s[i] <= from || dataset.time_s[i] >= to) kept.push_back(i);
  dataset.time_s = dataset.time_s(kept).eval();
  for (auto* group : {&dataset.inputs, &dataset.readings, &dataset.displacements, &dataset.truth_readings,
                      &dataset.truth_displacements, &dataset.heat})
    for (auto& channel : *group) channel.values = channel.values(kept).eval();
  return dataset;
}

/// A run of a machine whose sensors lag, as the twin of another is shown it: without the rows of a gap.
inline MeasuredRun measured(Value const& truth, scenarios::Experiment const& experiment, double gap_from = 0.0,
                            double gap_to = 0.0) {
  Machine machine = Machine::build(truth);
  for (auto& sensor : machine.sensors)
    if (!sensor.description.lag) sensor.description.lag = 30.0;
  return measured_run(without_rows(run(machine, experiment, {}).dataset, gap_from, gap_to), machine, "hidden");
}

/// Value of a course's channel there [SI].
inline double value_at(thermal::Course const& course, std::string const& name, double time) {
  auto const& channels = course.channels();
  std::vector<double> values(channels.size());
  course.evaluate(time, values);
  auto const it = std::find_if(channels.begin(), channels.end(), [&](auto const& c) { return c.name == name; });
  return values.at(std::size_t(it - channels.begin()));
}

/// White noise on every sample: of the sensors [K], of the displacements [m].
inline void add_noise(MeasuredRun& run, double kelvin, double metres, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (auto& channel : run.channels)
    for (double& value : channel.values) value += (channel.displacement ? metres : kelvin) * normal(random);
}

inline std::vector<std::string> channels_of(MeasuredRun const& run) {
  std::vector<std::string> names;
  for (auto const& channel : run.channels) names.push_back(channel.name);
  return names;
}

/// That noise, and the error that a model of this kind is allowed: what a diagnosis starts with.
inline std::vector<ChannelNoise> noise_of(MeasuredRun const& run, double kelvin, double metres) {
  std::vector<ChannelNoise> noise;
  for (auto const& channel : run.channels)
    noise.push_back(channel.displacement ? ChannelNoise{metres, 0.05e-6, 0.3e-6, 600.0, 0.5e-6, 3.0 * 3600.0}
                                         : ChannelNoise{kelvin, 0.01, 0.1, 600.0, 0.2, 3.0 * 3600.0});
  return noise;
}

}  // namespace thermotwin::twin::tests
