#include "twin/replay.h"

#include <cmath>
#include <fmt/format.h>

#include "output/dataset_file.h"
#include "output/temporary_folder.h"
#include "thermal/error.h"
#include "twin/experiment_file.h"
#include "twin/file/output_path.h"
#include "twin/file/text_file.h"
#include "twin/influence_file.h"
#include "twin/needed_solution.h"
#include "twin/setting.h"
#include "twin/version.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;

std::string recording_key(std::size_t number) { return fmt::format("recorded.{}", number); }

/// What the data set says of itself, by key.
class Origin {
 public:
  Origin(output::Dataset const& data, fs::path const& file) : data_(data), file_(file) {}

  [[nodiscard]] bool has(std::string const& key) const { return data_.provenance.contains(key); }
  [[nodiscard]] std::string const& operator[](std::string const& key) const {
    auto const it = data_.provenance.find(key);
    if (it != data_.provenance.end()) return it->second;
    throw thermal::InputError(
        fmt::format("'{}' does not say what it was made from: its provenance has no '{}'; only what `thermotwin run` "
                    "of this version wrote can be made anew",
                    file_.string(), key));
  }

 private:
  output::Dataset const& data_;
  fs::path file_;
};

/// Machine and experiment from the texts alone.
std::pair<Machine, scenarios::Experiment> made_from(Origin const& origin, output::TemporaryFolder const& folder) {
  auto const machine_path = folder.put("machine.toml", origin["machine.file"]);
  if (origin.has("machine.weights")) folder.put("machine.weights", origin["machine.weights"]);
  auto const experiment_path = folder.put("experiment.toml", origin["experiment.file"]);
  Value machine = read_toml(machine_path), experiment = read_toml(experiment_path);
  for (auto const& setting : settings_in(origin["settings"])) apply(setting, machine, experiment);
  auto programme = read_experiment(experiment, experiment_path);
  for (std::size_t i = 0; i < programme.recorded.size(); ++i)
    programme.recorded[i].file = folder.put(recording_key(i) + ".csv", origin[recording_key(i)]).filename();
  return {Machine::build(machine), std::move(programme)};
}

/// The largest difference of two groups of channels, or what is not comparable.
std::string difference(std::string const& group, std::vector<output::Channel> const& a,
                       std::vector<output::Channel> const& b) {
  if (a.size() != b.size()) return fmt::format("  {}: {} channels instead of {}\n", group, b.size(), a.size());
  std::string text;
  for (std::size_t c = 0; c < a.size(); ++c) {
    if (a[c].name != b[c].name || a[c].values.size() != b[c].values.size())
      return fmt::format("  {}: not the same channels or times\n", group);
    auto const difference = (a[c].values - b[c].values).array();
    double const gap = difference.isNaN().select(0.0, difference).abs().maxCoeff();
    auto const one_is_missing = (a[c].values.array().isNaN() != b[c].values.array().isNaN()).count();
    if (gap > 0.0) text += fmt::format("  {} {}: up to {:.3g} {}\n", group, a[c].name, gap, a[c].unit);
    if (one_is_missing > 0)
      text += fmt::format("  {} {}: {} values are there in one only\n", group, a[c].name, one_is_missing);
  }
  return text;
}

/// Each direction of each axis, pass after pass.
std::vector<output::Channel> channels_of(std::vector<output::Positioning> const& axes) {
  std::vector<output::Channel> channels;
  for (auto const& axis : axes)
    for (auto const& [direction, errors] : {std::pair{"forward", &axis.forward_um}, {"backward", &axis.backward_um}})
      channels.push_back({axis.axis + " " + direction, "um", "", errors->reshaped()});
  return channels;
}

std::string differences(output::Dataset const& a, output::Dataset const& b) {
  std::string text;
  for (auto const& [key, value] : a.provenance)
    if (auto const other = b.provenance.find(key); other == b.provenance.end() || other->second != value)
      text += value.size() > 60 || other == b.provenance.end() || other->second.size() > 60
                  ? fmt::format("  {}: not the same\n", key)
                  : fmt::format("  {}: {} instead of {}\n", key, other->second, value);
  text += difference("input", a.inputs, b.inputs) + difference("reading", a.readings, b.readings) +
          difference("displacement", a.displacements, b.displacements) +
          difference("true reading", a.truth_readings, b.truth_readings) +
          difference("true displacement", a.truth_displacements, b.truth_displacements) +
          difference("heat", a.heat, b.heat) +
          difference("positioning", channels_of(a.positioning), channels_of(b.positioning)) +
          difference("true positioning", channels_of(a.truth_positioning), channels_of(b.truth_positioning));
  if (a.node_temperatures != b.node_temperatures) text += "  node temperatures: not the same\n";
  return text.empty() ? "  only what stands around these numbers\n" : text;
}

}  // namespace

std::map<std::string, std::string> origin(fs::path const& machine, Value const& document, fs::path const& experiment,
                                          std::string const& settings, scenarios::Experiment const& nominal) {
  std::map<std::string, std::string> texts = {
      {"machine.file", text_of_file(machine)}, {"experiment.file", text_of_file(experiment)}, {"settings", settings}};
  if (auto const solutions = known_solutions(machine, document); !solutions.empty())
    texts["machine.weights"] = text_of(solutions);
  for (std::size_t i = 0; i < nominal.recorded.size(); ++i)
    texts[recording_key(i)] = text_of_file(scenarios::resolved_path(nominal.recorded[i].file, nominal.directory));
  return texts;
}

void refuse_to_replace_other_than_run(fs::path const& output) {
  if (output.empty()) return;
  for (auto const& there : {output, output::partial_of(output)})
    refuse_to_replace_other(
        there, "run", [](fs::path const& file) { return output::provenance_in(file).contains("experiment.file"); });
}

Replay replay(fs::path const& dataset, fs::path const& output, std::function<void(double)> const& progress,
              std::atomic<bool> const* stop) {
  auto const data = output::read(dataset);
  if (!data.complete)
    throw thermal::InputError(fmt::format("'{}' is partial: the run that wrote it did not end", dataset.string()));
  if (auto const model = data.provenance.find("model"); model != data.provenance.end() && model->second == "reduced")
    throw thermal::InputError(fmt::format(
        "'{}' is of a reduced model (run --reduced), which is not made anew; the same run without --reduced "
        "can be",
        dataset.string()));
  Origin const origin(data, dataset);
  output::TemporaryFolder const folder;
  auto const [machine, experiment] = made_from(origin, folder);
  RunOptions options;
  options.integration.relative_tolerance = std::stod(origin["tolerance.relative"]);
  options.integration.absolute_tolerance = std::stod(origin["tolerance.absolute_K"]);
  options.checkpoint_interval = std::stod(origin["checkpoint_s"]);
  options.node_temperatures = origin["nodes"] == "yes";
  options.dataset = output.empty() ? folder / "run.h5" : output;
  for (auto const& [key, text] : data.provenance)
    if (key.starts_with("machine.") || key.starts_with("experiment.") || key.starts_with("recorded.") ||
        key == "settings")
      options.provenance[key] = text;
  options.progress = progress;
  options.stop = stop;
  auto const again = run(machine, experiment, options).dataset;
  if (text_of_file(*options.dataset) == text_of_file(dataset))
    return {true, fmt::format("{}: made anew from its own output, the same bytes\n", dataset.string())};
  std::string const& commit = origin["commit"];
  std::string const other =
      commit == twin::commit() ? "" : fmt::format(" (it is of commit {}, this program of {})", commit, twin::commit());
  return {false, fmt::format("{}: made anew it differs{}:\n{}", dataset.string(), other, differences(data, again))};
}

}  // namespace thermotwin::twin
