#include "twin/checkpoint.h"

#include <cmath>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <set>

#include "output/error.h"
#include "thermal/error.h"
#include "thermal/evaluation.h"
#include "thermal/units.h"
#include "twin/packed.h"

namespace thermotwin::twin {
namespace {

/// Byte for byte, unlike JSON: a recorded table may be in any encoding.
std::string record_of(Checkpoint::Identity const& identity) {
  std::string record;
  nlohmann::json::to_msgpack(nlohmann::json(identity), record);
  return record;
}

/// Of the lines in a provenance.
std::string typed_settings(std::string text) {
  if (text.empty()) return "no --set";
  for (auto at = text.find('\n'); at != std::string::npos; at = text.find('\n', at)) text.replace(at, 1, "' --set '");
  return fmt::format("--set '{}'", text);
}

/// As a user asks for it.
std::string asked_for(std::string const& key, std::string const& text) {
  if (key == "checkpoint_s")
    return fmt::format("--checkpoint \"{}\"", thermal::format_quantity(std::stod(text), thermal::dimension::time));
  if (key == "nodes") return text == "yes" ? "--nodes" : "no --nodes";
  if (key == "settings") return typed_settings(text);
  if (key == "seed") return "experiment.seed = " + text;
  if (key.starts_with("tolerance.")) return "--tolerance " + text;
  if (key == "version" || key == "commit") return fmt::format("{} {} of the program", key, text);
  if (key.starts_with("recorded.")) return "other recorded tables";
  return fmt::format("another {}, or another text in its file", key.substr(0, key.find('.')));
}

/// How a run was asked for, where not as now.
std::set<std::string> asked_differently(Checkpoint::Identity const& then, Checkpoint::Identity now) {
  std::set<std::string> asked;
  for (auto const& [key, text] : then)
    if (auto const same = now.extract(key); same.empty() || same.mapped() != text) asked.insert(asked_for(key, text));
  for (auto const& [key, text] : now) asked.insert(asked_for(key, ""));
  return asked;
}

Checkpoint::Identity identity_in(std::string const& record, std::filesystem::path const& path) {
  auto const json = nlohmann::json::from_msgpack(record, true, false);
  if (!json.is_object()) throw thermal::InputError(fmt::format("'{}' is no checkpoint of a run", path.string()));
  return json.get<Checkpoint::Identity>();
}

}  // namespace

Checkpoint::Checkpoint(std::filesystem::path const& path, Identity const& identity, bool resume)
    : journal_(path), records_(journal_.take_records()) {
  if (records_.empty()) {
    journal_.append(record_of(identity));
    return;
  }
  if (!resume)
    throw thermal::InputError(
        fmt::format("'{}' holds a run that was not finished; go on with --resume, or delete it", path.string()));
  if (records_.front() != record_of(identity))
    throw thermal::InputError(
        fmt::format("'{}' is of another run, with {}; ask for the same, or delete it to begin anew", path.string(),
                    fmt::join(asked_differently(identity_in(records_.front(), path), identity), " and ")));
  records_.erase(records_.begin());
}

std::size_t Checkpoint::replay(thermal::Network const& network, thermal::IntegrationState& state,
                               thermal::Observer const& observe) {
  thermal::Evaluation evaluation(network);
  std::size_t count = 0;
  for (auto const& record : records_) {
    packed::Reader bytes(record);
    for (auto left = bytes.take<std::size_t>(); left > 0; --left, ++count) {
      thermal::Sample sample;
      sample.time = bytes.take<double>();
      sample.energy = bytes.take<thermal::Energy>();
      auto const values = bytes.take_all<double>(), input = bytes.take_all<double>();
      sample.state = values;
      sample.input = input;
      sample.temperatures = evaluation.temperatures(values.data(), input.data());
      observe(sample);
    }
    state.time = bytes.take<double>();
    for (auto* part : {&state.state, &state.start, &state.relays, &state.next_switch}) *part = bytes.take_all<double>();
    state.summary = bytes.take<thermal::IntegrationSummary>();
  }
  records_.clear();
  return count;
}

void Checkpoint::keep(thermal::Sample const& sample) {
  packed::put(samples_, sample.time);
  packed::put(samples_, sample.energy);
  packed::put_all(samples_, sample.state);
  packed::put_all(samples_, sample.input);
  ++kept_;
}

void Checkpoint::write(thermal::IntegrationState const& state) {
  std::string record;
  packed::put(record, kept_);
  record += samples_;
  packed::put(record, state.time);
  for (auto const* part : {&state.state, &state.start, &state.relays, &state.next_switch})
    packed::put_all(record, std::span<double const>(*part));
  packed::put(record, state.summary);
  journal_.append(record);
  samples_.clear();
  kept_ = 0;
}

std::vector<std::size_t> stretches(std::span<double const> times, double interval) {
  std::vector<std::size_t> ends;
  double boundary = interval;
  for (std::size_t i = 0; interval > 0.0 && i + 1 < times.size(); ++i) {
    double const since = times[i] - times.front();
    if (since < boundary * (1.0 - 1e-12)) continue;
    ends.push_back(i + 1);
    boundary = interval * (std::floor(since / interval * (1.0 + 1e-12)) + 1.0);
  }
  ends.push_back(times.size());
  return ends;
}

std::filesystem::path checkpoint_of(std::filesystem::path dataset) { return dataset += ".checkpoint"; }

double checkpoint_interval(std::filesystem::path const& path) {
  if (!std::filesystem::exists(path))
    throw thermal::InputError(
        fmt::format("there is no checkpoint '{}' to go on from: the run was never begun, or not with --checkpoint; "
                    "give it, \"2 h\" "
                    "for example, to begin it",
                    path.string()));
  auto const records = output::Journal::read(path);
  if (records.empty()) throw thermal::InputError(fmt::format("'{}' holds no run", path.string()));
  return std::stod(identity_in(records.front(), path)["checkpoint_s"]);
}

void refuse_to_resume_finished(std::filesystem::path const& dataset) {
  auto const checkpoint = checkpoint_of(dataset);
  if (!std::filesystem::exists(dataset) || std::filesystem::exists(checkpoint)) return;
  throw thermal::InputError(
      fmt::format("'{}' is finished: it is there, and no checkpoint '{}' to go on from; leave out --resume to make it "
                  "anew",
                  dataset.string(), checkpoint.string()));
}

void remove_stale_checkpoint(std::filesystem::path const& dataset) {
  auto const path = checkpoint_of(dataset);
  if (!std::filesystem::exists(path)) return;
  try {
    output::Journal journal(path);
    auto const records = journal.take_records();
    if (!records.empty() && !identity_in(records.front(), path).empty()) journal.remove();
  } catch (thermal::InputError const&) {  // something else
  } catch (output::OutputError const&) {  // in use
  }
}

}  // namespace thermotwin::twin
