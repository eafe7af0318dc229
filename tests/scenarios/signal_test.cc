#include "scenarios/signal.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace thermotwin::scenarios {
namespace {

Signal steps() { return {{0.0, 10.0, 30.0}, {1.0, 5.0, 5.0}, Interpolation::step}; }
Signal slopes() { return {{0.0, 10.0, 30.0}, {0.0, 5.0, 0.0}, Interpolation::linear}; }

TEST(Signal, StepHasTheLimitFromTheRightAtItsJump) {
  EXPECT_EQ(steps().at(std::nextafter(10.0, 0.0)), 1.0);
  EXPECT_EQ(steps().at(10.0), 5.0);
}

TEST(Signal, LinearIsTheStraightLineBetweenItsPoints) {
  EXPECT_DOUBLE_EQ(slopes().at(4.0), 2.0);
  EXPECT_DOUBLE_EQ(slopes().at(10.0), 5.0);
  EXPECT_DOUBLE_EQ(slopes().at(26.0), 1.0);
}

TEST(Signal, HoldsItsEnds) {
  EXPECT_EQ(steps().at(-5.0), 1.0);
  EXPECT_EQ(steps().at(1e9), 5.0);
  EXPECT_EQ(slopes().at(1e9), 0.0);
}

TEST(Signal, JumpsOnlyWhereItsValueChanges) {
  EXPECT_EQ(steps().jumps(), (std::vector<double>{10.0}));
  EXPECT_TRUE(slopes().jumps().empty());
}

TEST(Signal, BendsWhereAStraightLineWouldMissIt) {
  auto const bends = [](std::vector<double> const& values) {
    std::vector<double> times(values.size());
    for (std::size_t k = 0; k < times.size(); ++k) times[k] = 60.0 * double(k);
    auto seconds = Signal(times, values, Interpolation::linear).bends();
    for (double& t : seconds) t /= 60.0;
    return seconds;
  };
  EXPECT_EQ(bends({3, 3, 3, 6, 6, 6, 3, 3, 3}), (std::vector<double>{0, 2, 3, 5, 6, 8}));
  EXPECT_EQ(bends({0, 1, 2, 3, 4, 3, 2, 1, 0}), (std::vector<double>{0, 4, 8}));
  EXPECT_EQ(bends({0, 1.04, 1.96, 3.04, 3.96, 5}), (std::vector<double>{0, 5}));  // but for less than a twentieth
  EXPECT_EQ(bends({295.0, 295.08, 295.0, 295.08, 295.0}), (std::vector<double>{0, 4}));  // and 0.09 K of air
  EXPECT_TRUE(Signal({0, 1}, {1, 2}, Interpolation::step).bends().empty());
}

TEST(Signal, APieceStandsInPlaceOfWhatWasThere) {
  auto const changed = steps().with_piece(5.0, 20.0, 3.0);
  EXPECT_EQ(changed.jumps(), (std::vector<double>{5.0, 20.0}));
  EXPECT_EQ(changed.at(0.0), 1.0);
  EXPECT_EQ(changed.at(12.0), 3.0);
  EXPECT_EQ(changed.at(20.0), 5.0);
}

TEST(Signal, IntegralIsTheAreaUnderIt) {
  EXPECT_DOUBLE_EQ(steps().integral(20.0), 10.0 + 50.0);
  EXPECT_DOUBLE_EQ(slopes().integral(10.0), 25.0);
  EXPECT_DOUBLE_EQ(slopes().integral(30.0), 25.0 + 50.0);
  EXPECT_DOUBLE_EQ(slopes().integral(4.0), 4.0);
}

TEST(Signal, IntegralStartsAtZeroWhereverTheSignalDoes) {
  Signal const late({5.0, 10.0}, {2.0, 3.0}, Interpolation::step);
  EXPECT_DOUBLE_EQ(late.integral(0.0), 0.0);
  EXPECT_DOUBLE_EQ(late.integral(6.0), 12.0);
  Signal const early({-10.0, 10.0}, {0.0, 20.0}, Interpolation::linear);
  EXPECT_DOUBLE_EQ(early.integral(10.0), 150.0);
}

TEST(Signal, IntegralOfItsDerivativeIsItself) {
  Signal const rate({0.0, 3.0, 7.0}, {2.0, -1.0, 4.0}, Interpolation::step);
  double const h = 1e-6;
  for (double const t : {1.0, 5.0, 9.0}) {
    EXPECT_NEAR((rate.integral(t + h) - rate.integral(t - h)) / (2 * h), rate.at(t), 1e-8);
  }
}

TEST(Signal, RunsWhereItIsNotZeroThroughout) {
  Signal const running = Signal({0.0, 10.0, 20.0, 30.0}, {0.0, 0.0, 4.0, 0.0}, Interpolation::linear).running();
  EXPECT_EQ(running.at(9.0), 0.0);
  EXPECT_EQ(running.at(10.0), 1.0);
  EXPECT_EQ(running.at(29.0), 1.0);
  EXPECT_EQ(running.at(30.0), 0.0);
}

TEST(Signal, ANewSpeedIsNoNewStart) {
  Signal const running = Signal({0.0, 10.0, 20.0}, {0.0, 4.0, 8.0}, Interpolation::step).running();
  EXPECT_EQ(running.piece_start(25.0), 10.0);
}

TEST(Signal, ScalesAndLosesItsSign) {
  Signal const signal({0.0, 1.0}, {-2.0, 3.0}, Interpolation::step);
  EXPECT_EQ(signal.scaled(2.0).values(), (std::vector<double>{-4.0, 6.0}));
  EXPECT_EQ(signal.magnitude().values(), (std::vector<double>{2.0, 3.0}));
}

TEST(Schedule, PutsBlocksOneAfterAnother) {
  Signal const signal = schedule({{10.0, 1.0}, {20.0, 2.0}}, 1, 0.0, 100.0);
  EXPECT_EQ(signal.times(), (std::vector<double>{0.0, 10.0, 30.0}));
  EXPECT_EQ(signal.values(), (std::vector<double>{1.0, 2.0, 0.0}));
}

TEST(Schedule, RunsThroughItsBlocksCycleByCycle) {
  Signal const signal = schedule({{10.0, 1.0}, {20.0, 0.0}}, 3, 7.0, 1000.0);
  EXPECT_EQ(signal.jumps(), (std::vector<double>{10.0, 30.0, 40.0, 60.0, 70.0, 90.0}));
  EXPECT_EQ(signal.at(90.0), 7.0);
}

TEST(Schedule, EndsWithTheRunAndHoldsItsLastBlockThere) {
  Signal const signal = schedule({{10.0, 1.0}, {20.0, 2.0}}, 1'000'000'000, 0.0, 60.0);
  EXPECT_EQ(signal.times().size(), 4U);
  EXPECT_EQ(signal.at(60.0), 2.0);
}

TEST(Schedule, WithoutBlocksIsConstant) { EXPECT_EQ(schedule({}, 1, 3.0, 10.0).at(5.0), 3.0); }

}  // namespace
}  // namespace thermotwin::scenarios
