#include "twin/compensation/compensator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace thermotwin::twin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

/// E = 2 ΔT1 + ΔT2 µm.
LiveModel model() {
  models::LinearForm form;
  form.coefficients = Eigen::Vector2d(2.0, 1.0);
  return SavedModel({"linear", {"T1", "T2"}, 0.0, 3.0, form, ""});
}

/// Stale after 30 s, stuck after 100; held for 60 s, faded in 40.
CompensationSettings const settings{{0.1, 0.0, 1000.0, 50.0}, {30.0, 100.0, 0.3, 0.1, 0.0, 100.0}, {60.0, 40.0}};

class Compensated : public testing::Test {
 protected:
  Decision step(std::vector<Reading> const& readings) { return compensator_.step(time_ += 10.0, readings, 10.0); }
  /// T1 rises by 0.2 K per step, T2 by 0.1: the error by 0.5 um.
  Decision good_step() { return step({t1(), t2()}); }
  Reading t1() { return {"T1", one_ += 0.2, "degC", time_ + 10.0, "good"}; }
  Reading t2() { return {"T2", two_ += 0.1, "degC", time_ + 10.0, "good"}; }
  void warm_up(int steps) {
    for (int i = 0; i < steps; ++i) good_step();
  }

  Compensator compensator_{model(), settings};
  double time_ = 0.0, one_ = 20.0, two_ = 25.0;
};

TEST_F(Compensated, CommandsTheNegativeError) {
  EXPECT_EQ(good_step().offset, 0.0);
  for (int i = 1; i < 50; ++i) {
    auto const decision = good_step();
    EXPECT_EQ(decision.support, Support::good);
    EXPECT_NEAR(decision.error, 0.5 * i, 1e-9);
    EXPECT_NEAR(decision.offset, -0.5 * i, 1e-9);
  }
}

TEST(Compensator, SaysWhatItExtrapolatesAndGoesOn) {
  models::LinearForm form;
  form.coefficients = Eigen::VectorXd::Constant(1, 2.0);
  Compensator compensator(SavedModel({"linear", {"T1"}, 0.0, 2.0, form, ""}, {{0.0, 1.05}}), settings);
  for (int i = 0; i < 20; ++i) {
    Reading const reading{"T1", 20.0 + 0.1 * i, "degC", 10.0 * i, "good"};
    auto const decision = compensator.step(10.0 * i, std::span(&reading, 1), 10.0);
    EXPECT_EQ(decision.extrapolated.size(), i > 11 ? 1U : 0U) << i;
    EXPECT_NEAR(decision.offset, -0.2 * i, 0.05 + 1e-9);
  }
}

TEST_F(Compensated, WaitsUntilEveryInputHasBeenRead) {
  for (int i = 0; i < 5; ++i) EXPECT_EQ(step({t1()}).support, Support::waiting);
  EXPECT_THAT(compensator_.unread(), ElementsAre("T2"));
  EXPECT_EQ(good_step().support, Support::good);
  EXPECT_EQ(good_step().offset, -0.5);
}

TEST_F(Compensated, HoldsThenFadesWhenASensorGoesSilent) {
  warm_up(21);
  double const silent_since = time_;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(step({t1()}).support, Support::good);
  for (int i = 0; i < 3; ++i) {
    auto const decision = step({t1()});
    EXPECT_EQ(decision.support, Support::held);
    EXPECT_NEAR(decision.offset, -10.0, 1e-9);  // that of the last message, not what T1 alone made of it since
    EXPECT_THAT(decision.faults, ElementsAre(Pair("T2", SensorFault::stale)));
  }
  while (time_ < silent_since + 80.0) step({t1()});
  EXPECT_NEAR(step({t1()}).offset, -10.0 * 0.25, 0.05 + 1e-9);
  EXPECT_EQ(step({t1()}).support, Support::off);
  EXPECT_EQ(step({t1()}).offset, 0.0);
}

TEST_F(Compensated, ComesBackWithTheSensor) {
  warm_up(21);
  for (int i = 0; i < 20; ++i) step({t1()});
  EXPECT_EQ(step({}).offset, 0.0);
  auto const decision = good_step();
  EXPECT_EQ(decision.support, Support::good);
  EXPECT_NEAR(decision.offset, -(2.0 * (one_ - 20.2) + (two_ - 25.1)), 0.05 + 1e-9);
}

TEST_F(Compensated, NeverFollowsALeap) {
  warm_up(21);
  for (int i = 0; i < 6; ++i) {
    auto leapt = t1();
    leapt.value += 5.0;
    auto const decision = step({leapt, t2()});
    EXPECT_THAT(decision.faults, ElementsAre(Pair("T1", SensorFault::jump)));
    EXPECT_NEAR(decision.offset, -10.0, 1e-9);
  }
}

TEST_F(Compensated, GoesBackToBeforeTheSensorStuck) {
  warm_up(21);
  double const frozen = one_;
  Decision decision;
  for (int i = 0; i < 9; ++i) decision = step({{"T1", frozen, "degC", time_ + 10.0, "good"}, t2()});
  EXPECT_EQ(decision.support, Support::good);
  EXPECT_NEAR(decision.offset, -10.9, 1e-9);
  decision = step({{"T1", frozen, "degC", time_ + 10.0, "good"}, t2()});
  EXPECT_THAT(decision.faults, ElementsAre(Pair("T1", SensorFault::stuck)));
  EXPECT_NE(decision.support, Support::good);
  EXPECT_LE(std::abs(decision.offset), 10.0 + 1e-9);
}

TEST_F(Compensated, BelievesASensorThatSaysItIsBad) {
  warm_up(21);
  auto bad = t1();
  bad.quality = "uncertain";
  EXPECT_THAT(step({bad, t2()}).faults, ElementsAre(Pair("T1", SensorFault::missing)));
}

TEST_F(Compensated, RefusesReadingsBySentence) {
  warm_up(21);
  auto const decision = step({{"T3", 20.0, "degC", time_, "good"},
                              {"T1", 290.0, "K", time_ + 10.0, "good"},
                              {"T2", 90.0, "degC", time_ + 11.0, "good"},
                              {"T2", 90.0, "degC", time_ - 10.0, "good"}});
  EXPECT_THAT(decision.refused,
              ElementsAre("the model has no input 'T3'; did you mean 'T1'?", "T1 comes in 'K'; the model wants 'degC'",
                          "T2 comes from the future", "T2 repeats a time or goes back in it"));
  EXPECT_THAT(decision.faults, IsEmpty());
  EXPECT_NEAR(decision.offset, -10.0, 1e-9);
}

TEST_F(Compensated, SlewsWithTheTimeThatPassed) {
  auto slow = settings;
  slow.shift.slew = 0.02;
  compensator_ = Compensator(model(), slow);
  warm_up(1);
  for (int i = 1; i < 40; ++i) EXPECT_NEAR(good_step().offset, -0.2 * i, 0.05 + 1e-9);
}

}  // namespace
}  // namespace thermotwin::twin
