#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "tests/twin/effect_bench.h"
#include "twin/diagnosis/hypothesis.h"

/// What must hold for the way in which diagnosis tries every effect of the catalogue.
namespace thermotwin::twin {
namespace {

constexpr double tiny = 1e-6;  // of a trial's largest amplitude

struct Tried {
  std::string machine;
  Value document;
  std::vector<Hypothesis> hypotheses;
};

std::vector<Tried> const& tried() {
  static std::vector<Tried> const all = [] {
    std::vector<Tried> result;
    for (std::string const name : {"v450", "g200", "vmc850", "water_pipe"}) {
      Value document = read_toml(machine_file(name));
      auto found = hypotheses(document, Machine::build(document));
      result.push_back({name, std::move(document), std::move(found)});
    }
    return result;
  }();
  return all;
}

Machine with(Tried const& tried, Hypothesis const& hypothesis, double share) {
  return Machine::build(with_hypothesis(tried.document, hypothesis, "trial", share * hypothesis.largest));
}

std::vector<double> heat(Tried const& tried, Hypothesis const& hypothesis, double share) {
  Machine const machine = with(tried, hypothesis, share);
  Inputs inputs;
  if (machine.limits.max_spindle_speed == 0.0) inputs = {{"spindle.speed", 0.0}, {"spindle.running", 0.0}};
  return heat_of({hypothesis.effect->name, "trial", {}}, machine, bench_temperatures(machine), inputs);
}

TEST(Trials, TellWhatTheyAreConfusedWithAndHowToTell) {
  std::set<int> numbers;
  for (auto const& entry : effect_catalogue()) {
    numbers.insert(entry.numbers.begin(), entry.numbers.end());
    for (int const number : entry.numbers) EXPECT_TRUE(number >= 1 && number <= 42) << entry.name;
    for (auto const& other : entry.confusable) {
      EXPECT_NO_THROW((void)effect(other)) << entry.name;
      EXPECT_NE(other, entry.name);
    }
    EXPECT_EQ(entry.confusable.empty(), entry.separated_by.empty()) << entry.name;
    if (!entry.trials.empty()) {
      EXPECT_FALSE(entry.numbers.empty() || entry.confusable.empty()) << entry.name;
    }
  }
  // Numbers of tables that are no effect: pretension of a ball_screw (16), resolution of a sensor (30), clock and start
  // of an experiment (37).
  std::set<int> const elsewhere = {16, 30, 37};
  for (int number = 1; number <= 42; ++number)
    EXPECT_TRUE(numbers.contains(number) || elsewhere.contains(number)) << number;
}

TEST(Trials, NameKeysOfTheirEffect) {
  for (auto const& entry : effect_catalogue())
    for (auto const& trial : entry.trials) {
      std::vector<std::string> keys = {trial.amplitude};
      for (auto const& site : trial.sites) keys.push_back(site.key);
      for (auto const& [key, factor] : trial.proportional) keys.push_back(key);
      for (auto const& shape : trial.shapes)
        for (auto const& [key, text] : shape) keys.push_back(key);
      for (auto const& key : keys)
        EXPECT_TRUE(std::any_of(entry.parameters.begin(), entry.parameters.end(),
                                [&](auto const& field) { return field.key == key; }))
            << entry.name << ": " << key;
      EXPECT_GT(trial.largest, 0.0) << entry.name;
    }
}

TEST(Trials, HaveASiteOnOneOfTheMachines) {
  std::set<Trial const*> found;
  for (auto const& machine : tried())
    for (auto const& hypothesis : machine.hypotheses) found.insert(hypothesis.trial);
  for (auto const& entry : effect_catalogue())
    for (auto const& trial : entry.trials) EXPECT_TRUE(found.contains(&trial)) << entry.name;
}

/// The machine takes the table at an amplitude that is next to nothing, and its heat grows in proportion.
TEST(Trials, AreLinearNearZeroAtEverySite) {
  for (auto const& machine : tried())
    for (auto const& hypothesis : machine.hypotheses) {
      SCOPED_TRACE(machine.machine + ": " + hypothesis.label());
      std::vector<double> once, twice;
      ASSERT_NO_THROW(once = heat(machine, hypothesis, tiny));
      ASSERT_NO_THROW(twice = heat(machine, hypothesis, 2.0 * tiny));
      double most = 0.0;
      for (double const q : twice) most = std::max(most, std::abs(q));
      for (std::size_t i = 0; i < once.size(); ++i) EXPECT_NEAR(twice[i], 2.0 * once[i], 1e-4 * most);
    }
}

/// Heat at two operating points, as a direction; empty where there is none, or other nodes than the machine's.
std::vector<double> direction(Tried const& tried, Hypothesis const& hypothesis) {
  Machine const machine = with(tried, hypothesis, tiny);
  Snippet const trial{hypothesis.effect->name, "trial", {}};
  auto warm = bench_temperatures(machine);
  auto q = heat_of(trial, machine, warm, {});
  for (double& temperature : warm)
    if (temperature > 0.0) temperature += 5.0;
  Inputs const later = {
      {"spindle.speed", 150.0}, {"spindle.time_running", 5000.0}, {"servo.on", 0.0}, {"coolant.on", 0.5}};
  auto const more = heat_of(trial, machine, warm, later);
  q.insert(q.end(), more.begin(), more.end());
  double sum = 0.0;
  for (double const x : q) sum += x * x;
  if (sum == 0.0 || hypothesis.effect->name == "extra_mass") return {};
  for (double& x : q) x /= std::sqrt(sum);
  return q;
}

/// Two effects that would make the same heat at the same places could not be told apart by any run.
TEST(Trials, OfDifferentEffectsDifferInTheirHeat) {
  auto const& machine = tried().front();
  std::vector<std::pair<Hypothesis const*, std::vector<double>>> seen;
  for (auto const& hypothesis : machine.hypotheses) {
    auto const mine = direction(machine, hypothesis);
    if (mine.empty()) continue;
    for (auto const& [other, theirs] : seen) {
      if (other->effect == hypothesis.effect) continue;
      double difference = 0.0;
      for (std::size_t i = 0; i < mine.size(); ++i) difference = std::max(difference, std::abs(mine[i] - theirs[i]));
      EXPECT_GT(difference, 1e-4) << other->label() << " and " << hypothesis.label();
    }
    seen.emplace_back(&hypothesis, mine);
  }
  EXPECT_GT(seen.size(), 50U);
}

}  // namespace
}  // namespace thermotwin::twin
