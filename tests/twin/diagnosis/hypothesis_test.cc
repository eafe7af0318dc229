#include "twin/diagnosis/hypothesis.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <set>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/sensitivity.h"

namespace thermotwin::twin {
namespace {

struct Subject {
  explicit Subject(std::string const& name)
      : document(read_toml(machine_file(name))),
        machine(Machine::build(document)),
        all(hypotheses(document, machine)) {}
  Value document;
  Machine machine;
  std::vector<Hypothesis> all;
};

std::string text_of(Hypothesis const& hypothesis) {
  std::string text = hypothesis.effect->name;
  for (auto const& [key, value] : hypothesis.keys) text += fmt::format(" {}={}", key, value);
  return text;
}

class HypothesesOf : public testing::TestWithParam<char const*> {};

TEST_P(HypothesesOf, CanBeBuiltAlone) {
  Subject const subject(GetParam());
  int const nodes = subject.machine.network().nodes();
  for (auto const& hypothesis : subject.all) {
    double const amplitude = 1e-6 * hypothesis.largest;
    try {
      auto const machine = Machine::build(with_hypothesis(subject.document, hypothesis, "trial", amplitude));
      EXPECT_GE(machine.network().nodes(), nodes) << text_of(hypothesis);
    } catch (std::exception const& error) {
      ADD_FAILURE() << text_of(hypothesis) << ": " << error.what();
    }
  }
}

TEST_P(HypothesesOf, AreAllDifferent) {
  Subject const subject(GetParam());
  std::set<std::pair<Trial const*, std::string>> seen;
  for (auto const& hypothesis : subject.all)
    EXPECT_TRUE(seen.insert({hypothesis.trial, text_of(hypothesis)}).second) << text_of(hypothesis);
}

/// What bears one label is one effect at one place, in several shapes.
TEST_P(HypothesesOf, OfOneLabelDifferInTheirShapeOnly) {
  Subject const subject(GetParam());
  std::map<std::string, std::string> places;
  for (auto const& hypothesis : subject.all) {
    std::string place = hypothesis.body;
    for (auto const& site : hypothesis.trial->sites)
      for (auto const& [key, value] : hypothesis.keys)
        if (key == site.key || key == site.other || key == "axis") place += fmt::format(" {}={}", key, value);
    auto const [it, isnew] = places.insert({hypothesis.label(), place});
    EXPECT_TRUE(isnew || it->second == place) << hypothesis.label() << ": " << it->second << " and " << place;
  }
}

TEST_P(HypothesesOf, NameSitesThatTheMachineHas) {
  Subject const subject(GetParam());
  std::set<std::string> names = {"machine"};
  for (auto const& body : subject.machine.geometry) names.insert(body.name);
  for (auto const& sensor : subject.machine.sensors) names.insert(sensor.description.name);
  for (auto const& displacement : subject.machine.displacements) names.insert(displacement.name);
  for (auto const& screw : subject.machine.screws) names.insert(screw.description.name);
  for (auto const& hypothesis : subject.all) EXPECT_TRUE(names.contains(hypothesis.body)) << text_of(hypothesis);
}

/// Beforehand every effect is as likely as any other, however many sites it has, but for what a coarse network looks
/// like.
TEST_P(HypothesesOf, ShareTheProbabilityOfTheirEffect) {
  Subject const subject(GetParam());
  std::map<std::string, double> probability;
  for (auto const& hypothesis : subject.all) probability[hypothesis.effect->name] += std::exp(-0.5 * hypothesis.choice);
  EXPECT_GT(probability.size(), 10U);
  for (auto const& [effect, sum] : probability)
    EXPECT_NEAR(sum, effect == "extra_mass" ? std::exp(-15.0) : 1.0, 1e-12) << effect;
}

INSTANTIATE_TEST_SUITE_P(Machines, HypothesesOf, testing::Values("v450", "vmc850", "g200"),
                         [](auto const& info) { return std::string(info.param); });

class Hypotheses : public testing::Test {
 protected:
  Subject const v450{"v450"};
  [[nodiscard]] std::vector<std::string> labels(std::vector<Hypothesis> const& all) const {
    std::vector<std::string> result;
    for (auto const& hypothesis : all) result.push_back(hypothesis.label());
    return result;
  }
  [[nodiscard]] bool has(std::vector<Hypothesis> const& all, std::string const& label) const {
    auto const known = labels(all);
    return std::find(known.begin(), known.end(), label) != known.end();
  }
};

TEST_F(Hypotheses, SeekHeatEverywhereAndInThreeStretchesOfALongBar) {
  EXPECT_TRUE(has(v450.all, "heat at motor"));
  EXPECT_TRUE(has(v450.all, "heat at column_rear"));
  EXPECT_TRUE(has(v450.all, "heat at shaft[140 mm .. 280 mm]"));
  EXPECT_FALSE(has(v450.all, "heat at shaft"));
  EXPECT_TRUE(has(v450.all, "sensor_drift at T4"));
}

/// A bearing ring of 110 mm, 40 mm wide, cannot radiate from a square metre; a column can.
TEST_F(Hypotheses, GiveABodyNoMoreAreaThanItHas) {
  std::map<std::string, double> largest;
  for (auto const& hypothesis : v450.all) largest[hypothesis.label()] = hypothesis.largest;
  EXPECT_NEAR(largest.at("radiation at front_ring to head_front"), 2 * 0.11 * 0.11 + 4 * 0.11 * 0.04, 1e-12);
  EXPECT_NEAR(largest.at("radiation at motor to bed"), 2 * 0.22 * 0.22 + 4 * 0.22 * 0.3, 1e-12);
  EXPECT_EQ(largest.at("radiation at head_front to column_rear"),
            std::min(1.0, 2 * (0.32 * 0.26 + 0.26 * 0.34 + 0.34 * 0.32)));
  EXPECT_EQ(largest.at("heat at front_ring"), 300.0);
}

TEST_F(Hypotheses, LeaveOutWhatTheCallerDoes) {
  auto const others = hypotheses(v450.document, v450.machine, {"heat"});
  EXPECT_LT(others.size(), v450.all.size());
  for (auto const& hypothesis : others) EXPECT_NE(hypothesis.effect->name, "heat");
}

TEST_F(Hypotheses, KnowWhatStandsInTheFile) {
  auto const known = tests::with_table(v450.document, R"(
    [[heat]]
    name = "pump"
    at = "bed"
    power = "40 W"
    while_on = "machine.on")");
  auto const others = hypotheses(known, Machine::build(known));
  ASSERT_EQ(others.size(), v450.all.size());
  for (std::size_t h = 0; h < others.size(); ++h) {
    auto const& keys = others[h].keys;
    bool const pump =
        others[h].label() == "heat at bed" &&
        std::count(keys.begin(), keys.end(), std::pair<std::string, std::string>("while_on", "machine.on"));
    EXPECT_EQ(others[h].stands, v450.all[h].stands || pump) << others[h].label();
  }
}

TEST_F(Hypotheses, StandInTheFileWithTheirAmplitude) {
  for (auto const& hypothesis : v450.all) {
    double const amplitude = 0.25 * hypothesis.largest;
    auto const with = with_hypothesis(v450.document, hypothesis, "found", amplitude);
    std::string const table = hypothesis.effect->name + ".found.";
    EXPECT_NEAR(find_number(with, table + hypothesis.trial->amplitude).value, amplitude, 1e-9 * amplitude)
        << text_of(hypothesis);
    for (auto const& [key, factor] : hypothesis.trial->proportional)
      EXPECT_NEAR(find_number(with, table + key).value, factor * amplitude, 1e-9 * std::abs(factor * amplitude))
          << text_of(hypothesis);
  }
}

/// vmc850 has an axis, and no spindle.
TEST(HypothesesOfAnAxis, FollowItWhereNoSpindleTurns) {
  Subject const vmc850("vmc850");
  bool fan = false;
  for (auto const& hypothesis : vmc850.all) {
    EXPECT_FALSE(hypothesis.trial->needs_spindle) << text_of(hypothesis);
    for (auto const& [key, value] : hypothesis.keys) EXPECT_FALSE(value.starts_with("spindle.")) << text_of(hypothesis);
    if (hypothesis.label() != "fan_cooling at motor") continue;
    fan = true;
    std::map<std::string, std::string> const keys(hypothesis.keys.begin(), hypothesis.keys.end());
    EXPECT_EQ(keys.at("speed"), "z.speed");
    EXPECT_NEAR(thermal::parse_value(keys.at("rated_speed"), dimension::angular_speed),
                2.0 * std::numbers::pi * vmc850.machine.limits.axes[0].rapid_feed / 0.010, 1e-3);
  }
  EXPECT_TRUE(fan);
}

/// mill200 has a spindle and the screw of an axis x: what is part of that drive follows x, all else the spindle.
TEST(HypothesesOfAFeedDrive, FollowItsAxisBesideASpindle) {
  Subject const mill("mill200");
  std::map<std::string, std::set<std::string>> heat_while_on;
  std::set<std::string> of_spindle;
  for (auto const& hypothesis : mill.all) {
    bool const of_drive = hypothesis.body == "x_nut" || hypothesis.body == "x_screw";
    EXPECT_FALSE(of_drive && hypothesis.trial->needs_spindle) << text_of(hypothesis);
    if (hypothesis.trial->needs_spindle) of_spindle.insert(hypothesis.effect->name);
    for (auto const& [key, value] : hypothesis.keys) {
      EXPECT_FALSE(of_drive && value.starts_with("spindle.")) << text_of(hypothesis);
      if (hypothesis.effect->name == "heat" && key == "while_on") heat_while_on[hypothesis.body].insert(value);
    }
  }
  EXPECT_EQ(heat_while_on.at("x_nut"), (std::set<std::string>{"machine.on", "servo.on", "x.running", "coolant.on"}));
  EXPECT_EQ(heat_while_on.at("table"),
            (std::set<std::string>{"machine.on", "servo.on", "spindle.running", "coolant.on"}));
  EXPECT_TRUE(of_spindle.contains("rotor_windage"));
}

TEST_F(Hypotheses, OfALagAreAlsoOfSomeSize) {
  auto const all = with_those_of_some_size(v450.all);
  EXPECT_EQ(all.size(), v450.all.size() + v450.machine.sensors.size());
  for (std::size_t h = 0; h < all.size(); ++h) {
    EXPECT_EQ(all[h].about > 0.0, h >= v450.all.size());
    EXPECT_TRUE(all[h].about == 0.0 || all[h].effect->name == "sensor_lag") << all[h].label();
  }
}

/// Of a screw whose errors are read; a machine without one has none of these.
TEST_F(Hypotheses, ErrorsOfPositionHaveScaleCompensationLaserAndItsAir) {
  auto const labels = [](std::string const& machine) {
    Value const document = read_toml(machine_file(machine));
    std::set<std::string> all;
    for (auto const& hypothesis : hypotheses(document, Machine::build(document))) all.insert(hypothesis.label());
    return all;
  };
  auto const axis = labels("vmc850"), spindle = labels("v450");
  for (std::string const expected : {"scale at E_P by bed", "compensation at E_P by head", "laser_air at E_P",
                                     "probe_drift at E_P", "scale at E_P_fixed by column_top"})
    EXPECT_TRUE(axis.contains(expected)) << expected;
  EXPECT_FALSE(axis.contains("scale at E_P by lower_ring")) << "no scale sits on a ring";
  for (auto const& label : spindle)
    EXPECT_TRUE(!label.starts_with("scale") && !label.starts_with("laser_air")) << label;
}

}  // namespace
}  // namespace thermotwin::twin
