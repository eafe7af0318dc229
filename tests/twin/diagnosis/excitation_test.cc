#include "twin/diagnosis/excitation.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "tests/twin/diagnosis/diagnosis_bench.h"

namespace thermotwin::twin {
namespace {

/// Names of the effects without a site that a run of this length lets be seen.
std::vector<std::string> seen_in(std::string const& duration) {
  Value const document = tests::v450();
  auto const run = tests::measured(document, tests::experiment("duration = \"" + duration +
                                                               "\"\n[spindle]\nblocks = "
                                                               "[{duration = \"1 h\", speed = \"3000 rpm\"}]"));
  std::vector<BinnedRun> const runs = {bin(run, 300.0)};
  Machine const machine = Machine::build(document);
  std::vector<std::string> names;
  for (auto const& hypothesis : hypotheses(document, machine)) {
    bool const excited = is_excited(hypothesis, document, machine, runs);
    bool const may_be_silent = hypothesis.site == "machine" || !hypothesis.trial->if_changes.empty();
    EXPECT_TRUE(excited || may_be_silent) << hypothesis.label();
    if (excited && hypothesis.site == "machine") names.push_back(hypothesis.effect->name);
  }
  return names;
}

TEST(Excitation, OfADailyCycleTakesHours) {
  auto const has = [](std::vector<std::string> const& names, std::string const& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  auto const hour = seen_in("40 min"), half_a_day = seen_in("12 h");
  EXPECT_FALSE(has(hour, "ambient_cycle"));
  EXPECT_TRUE(has(half_a_day, "ambient_cycle"));
  EXPECT_TRUE(has(hour, "stratification"));
}

/// Heat while the drives are on is constant heat, unless they are switched; at a motor it is copper loss.
TEST(Excitation, OfHeatOfTheDrivesTakesASwitch) {
  Value const document = tests::v450();
  Machine const machine = Machine::build(document);
  auto const bodies = [&](std::string const& servo) {
    auto const run = tests::measured(document, tests::experiment("duration = \"2 h\"\n[servo]\n" + servo +
                                                                 "\n[spindle]\nblocks = "
                                                                 "[{duration = \"1 h\", speed = \"3000 rpm\"}]"));
    std::vector<BinnedRun> const runs = {bin(run, 300.0)};
    std::set<std::string> heated;
    for (auto const& hypothesis : hypotheses(document, machine))
      if (hypothesis.trial->if_changes == "servo.on" && is_excited(hypothesis, document, machine, runs))
        heated.insert(hypothesis.body);
    return heated;
  };
  EXPECT_TRUE(bodies("on = true").empty());
  auto const switched = bodies("blocks = [{duration = \"1 h\", on = true}, {duration = \"1 h\", on = false}]");
  EXPECT_TRUE(switched.contains("head_rear"));
  EXPECT_FALSE(switched.contains("motor"));
}

}  // namespace
}  // namespace thermotwin::twin
