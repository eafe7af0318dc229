#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>

#include "tests/twin/effect_bench.h"
#include "thermal/error.h"
#include "thermal/integrate.h"
#include "thermal/units.h"
#include "twin/effect.h"
#include "twin/sensitivity.h"

/// What must hold for every effect of the catalogue, the ones that are still to be written included.
namespace thermotwin::twin {
namespace {

bool is_number(FieldRecord const& field) {
  return field.kind == "number" || field.kind.starts_with("temperature [") || field.kind.ends_with("]");
}

/// It moves the tool or a reading, and no temperature.
bool moves_only(Effect const& effect) { return effect.changes == "deformation" || effect.changes == "sensor"; }

/// It changes the air or a reading: heat flows through laws of other parts.
bool has_no_law(Effect const& effect) { return moves_only(effect) || effect.changes.ends_with("input"); }

class EveryEffect : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] Effect const& entry() const { return effect(GetParam()); }
};

std::vector<std::string> effect_names() {
  std::vector<std::string> names;
  for (auto const& entry : effect_catalogue()) names.push_back(entry.name);
  return names;
}

std::string name_of(testing::TestParamInfo<std::string> const& info) { return info.param; }

TEST_P(EveryEffect, TellsWhatItIs) {
  EXPECT_EQ(entry().name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos);
  for (auto const& text : {entry().meaning, entry().equation, entry().sites, entry().signature, entry().source}) {
    EXPECT_GT(text.size(), 7U) << text;
    EXPECT_NE(text.back(), '.') << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
  EXPECT_NE(entry().equation.find('='), std::string::npos) << entry().equation;
  EXPECT_NE(entry().source.find("physics.md"), std::string::npos) << entry().source;
  std::set<std::string> const kinds = {"source", "link", "film", "boundary", "sensor", "deformation", "input"};
  std::stringstream changes(entry().changes);
  for (std::string kind; std::getline(changes >> std::ws, kind, ',');) EXPECT_TRUE(kinds.contains(kind)) << kind;
}

TEST_P(EveryEffect, TellsWhatItsParametersAre) {
  std::set<std::string> keys;
  for (auto const& field : entry().parameters) {
    EXPECT_TRUE(keys.insert(field.key).second) << field.key;
    EXPECT_FALSE(field.kind.empty()) << field.key;
    EXPECT_GT(field.description.size(), 2U) << field.key;
    if (is_number(field)) {
      EXPECT_FALSE(field.range.empty()) << field.key << " has no plausible range";
    }
    if (field.initial == "required" || field.initial.empty() || !is_number(field)) continue;
    if (field.kind.starts_with("temperature [") || field.kind.starts_with("list")) continue;
    double const initial = thermal::parse_value(field.initial, field.dimension);
    EXPECT_GE(initial, field.plausible.low) << field.key;
    EXPECT_LE(initial, field.plausible.high) << field.key;
  }
  EXPECT_TRUE(keys.contains("name"));
}

TEST_P(EveryEffect, HasASnippet) {
  EXPECT_TRUE(std::any_of(snippets().begin(), snippets().end(), [&](auto const& s) { return s.effect == GetParam(); }));
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryEffect, testing::ValuesIn(effect_names()), name_of);

/// One element of a law, alone: its ports are 0, 1, …, and so are its inputs.
class Element {
 public:
  Element(Machine const& machine, thermal::ElementGroup const& group, int element) : law_(*group.law) {
    for (int p = 0; p < law_.ports(); ++p) index_.push_back(p);
    auto const c = std::size_t(law_.coefficients());
    coefficients_.assign(group.coefficients.begin() + std::ptrdiff_t(c * std::size_t(element)),
                         group.coefficients.begin() + std::ptrdiff_t(c * std::size_t(element + 1)));
    for (int u = 0; u < law_.inputs(); ++u) {
      auto const& channel =
          machine.network().channel_names()[std::size_t(group.inputs[std::size_t(element * law_.inputs() + u)])];
      bool const own = channel.ends_with(".state") || channel.find(".weight[") != std::string::npos;
      inputs_.push_back(own ? 0.7 : bench_input(channel));
      input_index_.push_back(u);
    }
  }

  [[nodiscard]] thermal::Law const& law() const { return law_; }
  [[nodiscard]] std::vector<double> flows(std::vector<double> const& temperatures) const {
    std::vector<double> result(index_.size());
    law_.heat_flows(batch(), temperatures.data(), inputs_.data(), result.data());
    return result;
  }
  [[nodiscard]] std::vector<double> slopes(std::vector<double> const& temperatures) const {
    std::vector<double> result(index_.size() * index_.size());
    law_.jacobian_blocks(batch(), temperatures.data(), inputs_.data(), result.data());
    return result;
  }

 private:
  [[nodiscard]] thermal::ElementBatch batch() const { return {1, index_, coefficients_, input_index_}; }

  thermal::Law const& law_;
  std::vector<int> index_, input_index_;
  std::vector<double> coefficients_, inputs_;
};

class EverySnippet : public testing::TestWithParam<Snippet> {
 protected:
  /// Calls `check` with the first element of every law that the effect brings.
  template <class Check>
  void for_laws(Check check) const {
    Machine const machine = Machine::build(bench(GetParam()));
    int laws = 0;
    for (auto const& group : machine.network().groups()) {
      auto const mine = std::find_if(group.parts.begin(), group.parts.end(), [&](int part) {
        return machine.network().parts()[std::size_t(part)] == GetParam().part();
      });
      if (mine == group.parts.end()) continue;
      check(Element(machine, group, int(mine - group.parts.begin())));
      ++laws;
    }
    EXPECT_EQ(laws == 0, has_no_law(effect(GetParam().effect))) << laws << " laws";
  }
};

std::string snippet_name(testing::TestParamInfo<Snippet> const& info) {
  auto name = info.param.effect + "_" + info.param.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

double largest(std::vector<double> const& values) {
  double result = 0.0;
  for (double const v : values) result = std::max(result, std::abs(v));
  return result;
}

/// Along a line through the temperatures from 0 to 80 °C, every step must be the slope in its middle times its length:
/// a jump, a kink or a wrong derivative would show.
TEST_P(EverySnippet, IsContinuousAndHasExactSlopes) {
  for_laws([](Element const& element) {
    auto const ports = std::size_t(element.law().ports());
    std::mt19937 random(7);
    std::uniform_real_distribution<double> temperature(283.0, 343.0);
    for (std::size_t moved = 0; moved < ports; ++moved) {
      std::vector<double> at(ports);
      for (double& t : at) t = temperature(random);
      constexpr double step = 0.004, half = 0.5 * step;
      double worst = 0.0, steepest = 0.0, most = 0.0;
      std::vector<double> before;
      for (double t = 273.15; t < 353.15; t += step) {
        at[moved] = t;
        auto const now = element.flows(at);
        at[moved] = t - half;
        auto const slope = element.slopes(at);
        for (std::size_t p = 0; p < ports && !before.empty(); ++p) {
          double const expected = step * slope[p * ports + moved];
          worst = std::max(worst, std::abs(now[p] - before[p] - expected));
          steepest = std::max(steepest, std::abs(expected));
        }
        most = std::max(most, largest(now));
        before = now;
      }
      EXPECT_LE(worst, 2e-3 * steepest + 1e-10 * most) << element.law().name() << ", port " << moved;
    }
  });
}

TEST_P(EverySnippet, AddsUpToZeroWhereItIsConservative) {
  for_laws([](Element const& element) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> temperature(280.0, 350.0);
    double sum = 0.0, most = 0.0;
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<double> at(std::size_t(element.law().ports()));
      for (double& t : at) t = temperature(random);
      auto const flows = element.flows(at);
      double made = 0.0;
      for (double const q : flows) made += q;
      sum = std::max(sum, std::abs(made));
      most = std::max(most, largest(flows));
    }
    EXPECT_GT(most, 0.0) << element.law().name() << " does nothing";
    if (element.law().conservative()) {
      EXPECT_LE(sum, 1e-12 * most) << element.law().name();
    }
  });
}

struct Outcome {
  std::vector<double> temperatures;
  std::vector<double> sensitivities;  ///< to the only parameter
};

Outcome short_run(Machine const& machine, std::vector<thermal::NetworkDerivative> parameters) {
  thermal::IntegrationOptions options;
  options.relative_tolerance = 1e-12;
  options.absolute_tolerance = 1e-10;
  options.parameters = std::move(parameters);
  Outcome outcome;
  auto const course = bench_course(machine);
  std::vector<double> const times = {0.0, 600.0};
  thermal::integrate(machine.network(), course, bench_temperatures(machine), times, options,
                     [&](thermal::Sample const& sample) {
                       outcome.temperatures.assign(sample.temperatures.begin(),
                                                   sample.temperatures.begin() + machine.network().nodes());
                       if (!sample.sensitivities) return;
                       auto const column = sample.sensitivities->col(0);
                       outcome.sensitivities.assign(column.begin(), column.end());
                     });
  return outcome;
}

/// Puts the default of a number into the file, where the snippet does not state it; the path must have a value.
bool state(Value& document, Snippet const& snippet, FieldRecord const& field) {
  auto const [table, key] = find_parameter(document, snippet.path(field.key));
  if (table->find(key)) return true;
  if (field.initial.empty() || field.initial == "required") return false;
  set_parameter(document, snippet.path(field.key), field.initial);
  auto& content = table->find(key)->content;
  if (auto const* whole = std::get_if<std::int64_t>(&content)) content = double(*whole);
  return true;
}

std::vector<std::string> stated_numbers(Value& document, Snippet const& snippet) {
  std::vector<std::string> keys;
  for (auto const& field : effect(snippet.effect).parameters)
    if (is_number(field) && !field.kind.starts_with("list") && state(document, snippet, field))
      keys.push_back(field.key);
  return keys;
}

bool switches(Snippet const& snippet) { return snippet.effect == "chiller" && snippet.name == "relay"; }

/// Lengths of moving windows; the relay's numbers are skipped with it.
bool has_no_sensitivity(std::string const& key) { return key == "nut_length" || key == "carriage_length"; }

double typical_size(Parameter const& parameter) {
  return parameter.absolute_temperature ? 5.0 : std::abs(parameter.value);
}

/// dT/dθ of the nodes at the end, by central differences of runs: Richardson's extrapolation from steps h and h/2.
std::vector<double> differences(Value const& document, Parameter const& parameter) {
  double const step = 4e-3 * typical_size(parameter);
  auto const at = [&](double x) {
    return short_run(Machine::build(with_number(document, parameter, x)), {}).temperatures;
  };
  auto const plus = at(parameter.value + step), minus = at(parameter.value - step);
  auto const near_plus = at(parameter.value + 0.5 * step), near_minus = at(parameter.value - 0.5 * step);
  std::vector<double> slopes;
  for (std::size_t i = 0; i < plus.size(); ++i)
    slopes.push_back((4.0 * (near_plus[i] - near_minus[i]) / step - (plus[i] - minus[i]) / (2.0 * step)) / 3.0);
  return slopes;
}

TEST_P(EverySnippet, HasSensitivitiesThatAgreeWithCentralDifferences) {
  if (moves_only(effect(GetParam().effect))) GTEST_SKIP() << "moves the tool, not the temperatures";
  if (switches(GetParam())) GTEST_SKIP() << "a relay: sensitivities hold between two switches only";
  Value document = bench(GetParam());
  for (auto const& key : stated_numbers(document, GetParam())) {
    auto const parameter = find_number(document, GetParam().path(key));
    if (parameter.value == 0.0) continue;
    if (has_no_sensitivity(key)) {
      EXPECT_THROW((void)differentiate(document, parameter.path), thermal::InputError) << key;
      continue;
    }
    auto const derivative = differentiate(document, parameter.path);
    auto const forward = short_run(Machine::build(document), {derivative.network}).sensitivities;
    auto const expected = differences(document, parameter);
    double error = 0.0;
    for (std::size_t i = 0; i < forward.size(); ++i) error = std::max(error, std::abs(forward[i] - expected[i]));
    EXPECT_LE(error * typical_size(parameter), 1e-4 * largest(forward) * typical_size(parameter) + 2e-6) << key;
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EverySnippet, testing::ValuesIn(snippets()), snippet_name);

/// What a change of 1 % makes of the temperatures [K] after a short run, or of the displacement [m].
double answer(Value const& document, Snippet const& snippet, std::string const& key) {
  auto const parameter = find_number(document, snippet.path(key));
  double const other = parameter.absolute_temperature ? parameter.value + 1.0 : 0.99 * parameter.value;
  Machine const machine = Machine::build(document);
  Machine const changed = Machine::build(with_number(document, parameter, other));
  if (moves_only(effect(snippet.effect))) {
    auto const shift = [](Machine const& m) {
      double sum = 0.0;
      auto const temperatures = bench_temperatures(m);
      for (auto const& channel : m.linear_channels) {
        for (auto const& [node, weight] : channel.weights) sum += weight * (temperatures[std::size_t(node)] - 293.15);
        for (auto const& term : channel.input_terms)
          sum += term.coefficient * std::pow(bench_input(term.channel), term.power);
      }
      for (auto const& term : m.reading_terms)  // after an hour, 16 K above air that is 3 K warmer, rising by 1 mK/s
        sum += 3600.0 * term.drift - 1e-3 * term.lag - 16.0 * term.air_share + 3.0 * term.per_air;
      return sum;
    };
    return std::abs(shift(changed) - shift(machine)) * 1e6;
  }
  auto const a = short_run(machine, {}).temperatures, b = short_run(changed, {}).temperatures;
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

/// Numbers that no one per cent moves: a table that steps, and what acts only when a relay switches.
std::set<std::pair<std::string, std::string>> const unmoved = {
    {"seal", "outer_diameter"}, {"chiller", "hysteresis"}, {"chiller", "minimum_off_time"}};

TEST_P(EveryEffect, HasNoNumberThatDoesNothing) {
  std::map<std::string, double> most;
  for (auto const& field : entry().parameters)
    if (is_number(field) && !field.kind.starts_with("list") && !unmoved.contains({GetParam(), field.key}))
      most[field.key] = 0.0;
  for (auto const& s : snippets()) {
    if (s.effect != GetParam() || switches(s)) continue;
    Value document = bench(s);
    for (auto const& key : stated_numbers(document, s))
      if (most.contains(key) && most[key] < 1e-6) most[key] = std::max(most[key], answer(document, s, key));
  }
  for (auto const& [key, kelvin] : most) EXPECT_GE(kelvin, 1e-6) << key;
}

}  // namespace
}  // namespace thermotwin::twin
