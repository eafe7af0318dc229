#include "twin/diagnosis/plan.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/machine.h"

namespace thermotwin::twin {
namespace {

Hypothesis hypothesis(std::string const& label) {
  for (auto const& candidate : hypotheses(tests::v450(), Machine::build(tests::v450())))
    if (candidate.label() == label) return candidate;
  throw std::runtime_error("no hypothesis " + label);
}

TEST(Schedules, OfASpindleTurnAndThoseOfAFeedAxisMove) {
  auto const names = [](char const* machine) {
    std::set<std::string> result;
    for (auto const& schedule : separating_schedules(Machine::build(read_toml(machine_file(machine))), {}))
      result.insert(schedule.name());
    return result;
  };
  EXPECT_TRUE(names("v450").contains("separate_steps"));
  EXPECT_TRUE(names("vmc850").contains("separate_feeds"));
  EXPECT_FALSE(names("vmc850").contains("separate_steps"));
  EXPECT_TRUE(names("tclab").empty());
}

/// Constant heat and the loss of a motor look alike while it turns; a machine that is switched on at rest tells them
/// apart.
TEST(Remedies, NameAScheduleThatSeparates) {
  auto const run = tests::measured(tests::v450(), tests::experiment(R"(
    duration = "3 h"
    ambient.mean = "22 degC"
    [spindle]
    blocks = [{duration = "3 h", speed = "4000 rpm"}])"));
  std::vector<BinnedRun> const data = {bin(run, 600.0)};
  Rivals const rivals{{hypothesis("heat at motor"), hypothesis("copper_loss at motor")}, {0.3, 0.3}};
  auto const found = remedies(tests::v450(), data, {rivals})[0];
  ASSERT_FALSE(found.empty());
  EXPECT_TRUE(
      std::is_sorted(found.begin(), found.end(), [](auto const& a, auto const& b) { return a.distance > b.distance; }));
  auto const of = [&](std::string const& schedule, std::string const& sensor) {
    auto const it = std::find_if(found.begin(), found.end(), [&](auto const& remedy) {
      return remedy.schedule == schedule && remedy.sensor == sensor;
    });
    return it == found.end() ? -1.0 : it->distance;
  };
  EXPECT_GT(of("separate_switches", ""), 6.0);
  for (auto const& remedy : found) EXPECT_GE(remedy.distance, of(remedy.schedule, "") * (1.0 - 1e-6)) << remedy.sensor;
}

/// No schedule of the catalogue knows a pump's switch: it stays as the data have it.
TEST(Schedules, HoldInputsOfTheMachinesOwn) {
  Value const document = tests::with_table(tests::v450(), R"(
    [[heat]]
    name = "pump"
    at = "bed"
    power = "100 W"
    while_on = "pump.on")");
  auto const run = tests::measured(document, tests::experiment(R"(
    duration = "3 h"
    [spindle]
    blocks = [{duration = "3 h", speed = "4000 rpm"}]
    [[inputs]]
    channel = "pump.on"
    blocks = [{duration = "45 min", value = "1"}, {duration = "135 min", value = "0"}])"));
  std::vector<BinnedRun> const data = {bin(run, 600.0)};
  auto const schedules = separating_schedules(Machine::build(document), data);
  ASSERT_FALSE(schedules.empty());
  for (auto const& schedule : schedules) {
    auto const& held = schedule.experiment.driven;
    ASSERT_EQ(held.size(), 1U) << schedule.name();
    EXPECT_EQ(held[0].channel.name, "pump.on");
    EXPECT_NEAR(held[0].signal.at(0.0), 0.25, 0.03);
  }
  Rivals const rivals{{hypothesis("heat at motor"), hypothesis("copper_loss at motor")}, {0.3, 0.3}};
  EXPECT_FALSE(remedies(document, data, {rivals})[0].empty());
}

TEST(Plan, SaysWhatASpindleTestWouldShow) {
  auto const schedule = read_schedule(experiment_file("spindle_standard"));
  auto const made = plan(tests::v450(), {schedule}, {.without = {}, .with_remedies = 0, .progress = {}});
  EXPECT_DOUBLE_EQ(made.hours, 5.0);
  std::set<std::string> labels;
  for (auto const& effect : made.effects) {
    EXPECT_TRUE(labels.insert(effect.hypothesis.label()).second) << effect.hypothesis.label();
    EXPECT_GE(effect.kept, 0.0);
    EXPECT_LE(effect.kept, 1.0 + 1e-9);
  }
  EXPECT_TRUE(std::is_sorted(made.effects.begin(), made.effects.end(),
                             [](auto const& a, auto const& b) { return a.seen > b.seen; }));
  ASSERT_FALSE(made.ambiguities.empty());
  for (auto const& ambiguity : made.ambiguities) {
    EXPECT_LT(ambiguity.distance, 6.0);
    EXPECT_GE(made.effects[ambiguity.effect].seen, 6.0);
    EXPECT_NE(made.effects[ambiguity.effect].hypothesis.effect, made.effects[ambiguity.rival].hypothesis.effect);
  }
  auto const json = nlohmann::json::parse(plan_json(made));
  EXPECT_EQ(json["effects"].size(), made.effects.size());
  EXPECT_NE(plan_text(made).find("Planned: spindle_standard (5 h)"), std::string::npos);
}

}  // namespace
}  // namespace thermotwin::twin
