#include "tests/twin/effect_bench.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <stdexcept>

#include "thermal/evaluation.h"

namespace thermotwin::twin {
namespace {

Value read(std::string const& file) {
  return read_toml(std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "tests" / "twin" / file);
}

/// Tables that come later in a machine file may refer to those before: let this one come last.
Value last(Value table) {
  table.where.line += 1'000'000;
  return table;
}

std::vector<Snippet> read_snippets() {
  std::vector<Snippet> all;
  Value const file = read("effect_snippets.toml");
  for (auto const& entry : std::get<Value::Table>(file.content))
    for (auto const& table : std::get<Value::List>(entry.value.content))
      all.push_back({entry.key, std::get<std::string>(table.find("name")->content), last(table)});
  return all;
}

}  // namespace

std::vector<Snippet> const& snippets() {
  static std::vector<Snippet> const all = read_snippets();
  return all;
}

Snippet const& snippet(std::string const& effect, std::string const& name) {
  auto const it = std::find_if(snippets().begin(), snippets().end(), [&](Snippet const& s) {
    return s.effect == effect && (name.empty() || s.name == name);
  });
  if (it == snippets().end()) throw std::out_of_range("no snippet for " + effect + " " + name);
  return *it;
}

Value bench(Snippet const& snippet, Changes const& changes) {
  static Value const machine = read("effect_bench.toml");
  Value document = machine;
  Value* list = document.find(snippet.effect);
  if (!list) {
    Location const where = snippet.table.where;
    std::get<Value::Table>(document.content).push_back({snippet.effect, where, {where, Value::List{}}});
    list = document.find(snippet.effect);
  }
  std::get<Value::List>(list->content).push_back(snippet.table);
  for (auto const& [key, value] : changes) set_parameter(document, snippet.path(key), value);
  return document;
}

double bench_input(std::string const& channel) {
  static std::map<std::string, double> const values = {{"spindle.speed", 400.0},
                                                       {"spindle.running", 1.0},
                                                       {"spindle.time_running", 600.0},
                                                       {"spindle.revolutions", 4e4},
                                                       {"z.feed", 0.2},
                                                       {"z.duty", 0.8},
                                                       {"z.speed", 100.0},
                                                       {"z.moving_speed", 100.0},
                                                       {"z.running", 1.0},
                                                       {"z.stroke_from", 0.08},
                                                       {"z.stroke_to", 0.22},
                                                       {"ambient.temperature", 294.0},
                                                       {"ambient.gradient", 0.5},
                                                       {"ambient.door", 1.0},
                                                       {"ambient.floor_temperature", 293.5},
                                                       {"clock.day_cosine", 0.6},
                                                       {"clock.day_sine", 0.8},
                                                       {"coolant.on", 1.0},
                                                       {"coolant.temperature", 289.0},
                                                       {"chiller.on", 1.0},
                                                       {"chiller.offset", 0.2},
                                                       {"machine.on", 1.0},
                                                       {"servo.on", 1.0},
                                                       {"pipe.flow", 0.05},
                                                       {"pipe.inlet", 310.0}};
  auto const it = values.find(channel);
  return it == values.end() ? 0.0 : it->second;
}

thermal::FunctionCourse bench_course(Machine const& machine, Inputs const& replaced) {
  auto const& all = machine.network().channel_names();
  std::vector<std::string> const names(all.begin(), all.begin() + machine.network().external_channels());
  std::vector<double> constant;
  for (auto const& name : names) {
    constant.push_back(bench_input(name));
    for (auto const& [channel, value] : replaced)
      if (channel == name) constant.back() = value;
  }
  return {names, [constant, names](double t, std::span<double> values) {
            std::copy(constant.begin(), constant.end(), values.begin());
            for (std::size_t i = 0; i < names.size(); ++i) {
              if (names[i] == "spindle.time_running") values[i] += t;
              if (names[i] == "spindle.revolutions") values[i] += 64.0 * t;
            }
          }};
}

std::vector<double> bench_temperatures(Machine const& machine) {
  auto temperatures = uniform_temperatures(machine, 297.0);
  for (std::size_t i = 0; i < temperatures.size(); ++i)
    if (temperatures[i] > 0.0) temperatures[i] += double((5 * i) % 11);
  return temperatures;
}

std::vector<double> uniform_temperatures(Machine const& machine, double temperature) {
  std::vector<double> temperatures;
  for (char const signal : machine.network().signals()) temperatures.push_back(signal ? 0.0 : temperature);
  return temperatures;
}

std::vector<double> heat_of(Snippet const& effect, Machine const& machine, std::vector<double> const& temperatures,
                            Inputs const& replaced) {
  auto const& network = machine.network();
  auto const course = bench_course(machine, replaced);
  std::vector<double> input(std::size_t(network.channels()), 1.0);  // relays are on
  course.evaluate(0.0, {input.data(), std::size_t(network.external_channels())});
  std::vector<double> state(temperatures.size());
  for (std::size_t i = 0; i < state.size(); ++i) state[i] = network.state_of_temperature(int(i), temperatures[i]);
  thermal::Evaluation evaluation(network);
  auto const ports = evaluation.temperatures(state.data(), input.data());
  std::vector<double> const all(ports.begin(), ports.end());

  std::vector<double> heat(all.size(), 0.0), flows;
  for (auto const& group : network.groups()) {
    auto const p = std::size_t(group.law->ports());
    flows.resize(group.ports.size());
    group.law->heat_flows(group.batch(), all.data(), input.data(), flows.data());
    for (std::size_t k = 0; k < flows.size(); ++k)
      if (network.parts()[std::size_t(group.parts[k / p])] == effect.part())
        heat[std::size_t(group.ports[k])] += flows[k];
  }
  auto const first_average = std::size_t(network.nodes()) + network.boundaries().size();
  for (std::size_t a = 0; a < network.averages().size(); ++a)
    for (std::size_t i = 0; i < network.averages()[a].nodes.size(); ++i) {
      auto const& average = network.averages()[a];
      double const weight = average.from_channel < 0 ? average.weights[i] : 1.0 / double(average.nodes.size());
      heat[std::size_t(average.nodes[i])] += heat[first_average + a] * weight;
    }
  heat.resize(temperatures.size());
  for (std::size_t i = 0; i < heat.size(); ++i)
    if (network.signals()[i]) heat[i] = 0.0;
  return heat;
}

double total_heat(Snippet const& effect, Inputs const& replaced, Changes const& changes) {
  Machine const machine = Machine::build(bench(effect, changes));
  auto const heat = heat_of(effect, machine, bench_temperatures(machine), replaced);
  return std::accumulate(heat.begin(), heat.end(), 0.0);
}

}  // namespace thermotwin::twin
