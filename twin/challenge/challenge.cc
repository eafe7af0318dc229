#include "twin/challenge/challenge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "output/atomic_file.h"
#include "output/dataset_file.h"
#include "scenarios/course.h"
#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "twin/challenge/challenge_runs.h"
#include "twin/challenge/hidden_heat.h"
#include "twin/challenge/refined_form.h"
#include "twin/experiment_file.h"
#include "twin/file/document.h"
#include "twin/file/text_file.h"
#include "twin/instruments/random_stream.h"
#include "twin/needed_solution.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

using Json = nlohmann::ordered_json;

constexpr double tolerance = 3e-6;  // not that of the twin
std::array<std::string, 3> const run_names = {"run1", "run2", "unseen"};

output::Dataset simulate(Machine const& machine, scenarios::Experiment const& experiment) {
  RunOptions options;
  options.integration.relative_tolerance = options.integration.absolute_tolerance = tolerance;
  options.node_temperatures = true;
  return run(machine, experiment, options).dataset;
}

/// What somebody who measures has.
output::Dataset measured(output::Dataset const& run, HiddenWorld const& world, std::string const& name) {
  output::Dataset data;
  data.title = run.title;
  data.time_s = run.time_s;
  data.inputs = run.inputs;
  data.readings = run.readings;
  data.displacements = run.displacements;
  data.positioning = run.positioning;
  disturb(data, world, name);
  return data;
}

/// The machine with the same sensors, had they no noise and showed every digit.
Value with_quiet_sensors(Value document) {
  for (auto* table : tables_of(document, "temperature_sensor"))
    for (auto const* key : {"noise", "correlated_noise", "cold_junction", "resolution"})
      set_key(*table, key, std::string("0 K"));
  return document;
}

/// A run as the hidden world went through it, before noise: what a machine is held against that claims to be it.
output::Dataset as_it_was(HiddenWorld const& world, scenarios::Experiment const& experiment) {
  auto const run = simulate(Machine::build(with_quiet_sensors(world.hidden)), experiment);
  output::Dataset data;
  data.title = run.title;
  data.time_s = run.time_s;
  data.inputs = run.inputs;
  data.readings = run.readings;
  data.displacements = run.truth_displacements;
  return data;
}

/// How far the hidden part moves each displacement channel: root mean square and largest difference.
Json moved(output::Dataset const& with, output::Dataset const& without) {
  Json json = Json::object();
  for (std::size_t c = 0; c < with.truth_displacements.size(); ++c) {
    auto const& channel = with.truth_displacements[c];
    Eigen::VectorXd const difference = channel.values - without.truth_displacements[c].values;
    json[channel.name] = {{"unit", channel.unit},
                          {"rms", std::sqrt(difference.squaredNorm() / double(difference.size()))},
                          {"largest", difference.cwiseAbs().maxCoeff()}};
  }
  return json;
}

Json warmed(output::Dataset const& with, output::Dataset const& without) {
  Json json = Json::object();
  for (std::size_t c = 0; c < with.truth_readings.size(); ++c)
    json[with.truth_readings[c].name] =
        (with.truth_readings[c].values - without.truth_readings[c].values).cwiseAbs().maxCoeff();
  return json;
}

Json heat_json(std::map<std::string, MeanHeat> const& heat) {
  Json json = Json::object();
  for (auto const& [body, q] : heat)
    json[body] = {{"mean_W", q.mean}, {"moving_W", q.moving}, {"standing_W", q.standing}};
  return json;
}

Json effect_json(HiddenEffect const& effect) {
  auto const& hypothesis = effect.hypothesis;
  Json keys = Json::object();
  for (auto const& [key, text] : hypothesis.keys) keys[key] = text;
  return {{"effect", hypothesis.effect->name},
          {"site", hypothesis.site},
          {"body", hypothesis.body},
          {"amplitude_key", hypothesis.trial->amplitude},
          {"amplitude", effect.amplitude},
          {"largest", hypothesis.largest},
          {"numbers", hypothesis.effect->numbers},
          {"confusable", hypothesis.effect->confusable},
          {"keys", keys}};
}

Json sealed(HiddenWorld const& world, std::string const& machine) {
  Json json;
  json["machine"] = machine;
  json["seed"] = world.seed;
  json["kind"] = name_of(world.kind);
  json["effects"] = Json::array();
  json["removed"] = Json::array();
  for (auto const& effect : world.effects) {
    json["effects"].push_back(effect_json(effect));
    if (world.kind == CaseKind::outside) json["removed"].push_back(effect.hypothesis.effect->name);
  }
  json["sensor"] = nullptr;
  if (world.fault)
    json["sensor"] = {
        {"name", world.fault->sensor}, {"fault", world.fault->kind}, {"amplitude", world.fault->amplitude}};
  return json;
}

/// InputError for a machine, a seed or a kind that is not the one of the challenge in the folder.
void require_same(ChallengeOptions const& options, Json const& truth) {
  auto const refuse = [&](std::string const& option, std::string const& own, std::string const& other) {
    throw thermal::InputError(
        fmt::format("the challenge in '{0}' has the {1} {2}, not {3}; without --{1} it goes on with its own",
                    options.folder.string(), option, own, other));
  };
  auto const own = options.folder / "machine.toml";
  if (options.machine && text_of_file(machine_file(*options.machine)) != text_of_file(own))
    refuse("machine", fmt::format("{} of {}", truth.at("machine").get<std::string>(), own.string()), *options.machine);
  if (auto const seed = truth.at("seed").get<std::uint64_t>(); options.seed && *options.seed != seed)
    refuse("seed", std::to_string(seed), std::to_string(*options.seed));
  if (auto const kind = truth.at("kind").get<std::string>(); options.kind && name_of(*options.kind) != kind)
    refuse("kind", kind, name_of(*options.kind));
}

/// The hidden world of a challenge goes through one more experiment.
std::string write_further_run(ChallengeOptions const& options) {
  std::ifstream file(options.folder / "sealed.json");
  Json const truth = Json::parse(file, nullptr, false);
  if (truth.is_discarded()) throw thermal::InputError(fmt::format("'{}' holds no challenge", options.folder.string()));
  require_same(options, truth);
  auto const name = options.further_run->stem().string();
  auto const target = options.folder / (name + ".h5");
  if (std::filesystem::exists(target))
    throw thermal::InputError(fmt::format("'{}' is there already; a challenge does not overwrite", target.string()));
  auto experiment = read_experiment(read_toml(*options.further_run), *options.further_run);
  auto const world =
      draw_hidden_world(read_toml(options.folder / "machine.toml"), truth.at("seed").get<std::uint64_t>(),
                        case_kind(truth.at("kind").get<std::string>()));
  experiment.seed = int(1e9 * RandomStream(world.seed, name).uniform());
  output::write(measured(simulate(Machine::build(world.hidden), experiment), world, name), target);
  return fmt::format("{}: one more run, {:.0f} h\n", target.string(), experiment.duration / 3600.0);
}

/// Why nothing can be hidden in a machine; empty where it can.
std::string hindrance(std::filesystem::path const& file) {
  Value const document = read_toml(file);
  Machine const machine = Machine::build(document);
  auto const experiment = challenge_runs(machine.limits, 1).front();
  auto const given = scenarios::ExperimentCourse(experiment, machine.limits).channels();
  for (int i = 0; i < machine.network().external_channels(); ++i) {
    auto const& name = machine.network().channel_names()[std::size_t(i)];
    if (std::none_of(given.begin(), given.end(), [&](auto const& channel) { return channel.name == name; }))
      return fmt::format("it needs the input '{}', which the runs of a challenge do not give", name);
  }
  auto const hidden = refined_form(document);
  if (known_solutions(file, hidden).size() < needed_solutions(hidden).size())
    return "the hidden machine is a finer form of it, for whose blocks there are no elastic solutions";
  return "";
}

std::vector<std::string> machines_for_challenges() {
  std::vector<std::string> names;
  for (auto const& entry : std::filesystem::directory_iterator(machine_file("v450").parent_path()))
    if (entry.path().extension() == ".toml" && hindrance(entry.path()).empty())
      names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// InputError for a machine of which there is no challenge; of v450_fine, v450 is the nearest.
std::filesystem::path nominal_file(ChallengeOptions const& options) {
  auto const file = machine_file(options.machine.value_or("v450"));
  auto const reason = hindrance(file);
  if (reason.empty()) return file;
  auto const name = file.stem().string();
  throw thermal::InputError(
      fmt::format("there is no challenge of '{}': {}; {}", name, reason,
                  thermal::did_you_mean(name.substr(0, name.find("_fine")), machines_for_challenges())));
}

HiddenWorld world_of(ChallengeOptions const& options, Value const& nominal) {
  auto const seed = options.seed.value_or(1);
  return draw_hidden_world(nominal, seed, options.kind.value_or(case_kind(seed)));
}

}  // namespace

std::string challenge_key(ChallengeOptions const& options) {
  Value const nominal = read_toml(nominal_file(options));
  return sealed(world_of(options, nominal), Machine::build(nominal).name).dump() + "\n";
}

std::string write_challenge(ChallengeOptions const& options) {
  if (options.further_run) return write_further_run(options);
  output::require_empty(options.folder);
  auto const file = nominal_file(options);
  Value const nominal = read_toml(file);
  Machine const nominal_machine = Machine::build(nominal);
  auto const world = world_of(options, nominal);
  auto const runs = challenge_runs(nominal_machine.limits, world.seed);
  Machine const hidden = Machine::build(world.hidden), healthy = Machine::build(world.healthy);

  std::filesystem::create_directories(options.folder);
  Json json = sealed(world, nominal_machine.name);
  json["nodes"] = {{"nominal", nominal_machine.network().nodes()}, {"hidden", hidden.network().nodes()}};
  double hours = 0.0;
  for (int r = 0; r < 3; ++r) {
    auto const& experiment = runs[std::size_t(r)];
    auto const& name = run_names[std::size_t(r)];
    auto const data = simulate(hidden, experiment);
    output::write(measured(data, world, std::to_string(r)), options.folder / (name + ".h5"));
    hours += experiment.duration / 3600.0;
    if (world.effects.empty()) continue;
    json["watts"][name] = heat_json(hidden_heat(hidden, healthy, experiment, data));
    if (r < 2) continue;
    auto const without = simulate(healthy, experiment);
    json["moved"] = moved(data, without);
    json["warmed_K"] = warmed(data, without);
  }
  output::write(as_it_was(world, runs.back()), options.folder / "sealed_unseen.h5");
  json["drawn"] = world.drawn;
  std::filesystem::copy_file(file, options.folder / "machine.toml");
  output::write_atomically(options.folder / "sealed.json", json.dump(2) + "\n");
  return fmt::format("{}: {} with {} sensors, three runs, {:.0f} h; the truth is in sealed.json and sealed_unseen.h5\n",
                     options.folder.string(), nominal_machine.name, nominal_machine.sensors.size(), hours);
}

}  // namespace thermotwin::twin
