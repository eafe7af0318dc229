#include "twin/diagnosis/faulty_sensor.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "scenarios/course.h"
#include "tests/twin/diagnosis/diagnosis_bench.h"

namespace thermotwin::twin {
namespace {

using Eigen::VectorXd;

/// v450, and a sensor of the room.
Machine machine() {
  return Machine::build(tests::with_table(tests::v450(), R"(
    [[temperature_sensor]]
    name = "room"
    at = "ambient")"));
}

/// Readings of a body that warms within an hour, and a quantiser of a sixteenth.
VectorXd warming() {
  return VectorXd::NullaryExpr(
      480, [](Eigen::Index i) { return 295.15 + std::round(16.0 * 8.0 * (1.0 - std::exp(-double(i) / 60.0))) / 16.0; });
}

VectorXd with_leaps(VectorXd values, int count) {
  for (int k = 0; k < count; ++k) values.segment(100 + 50 * k, 20).array() += k % 2 == 0 ? 3.0 : -3.0;
  return values;
}

/// One sample a minute, or an interval [s]; `missing` of these without any after the 200th.
std::optional<FaultySensor> found(std::vector<MeasuredChannel> channels, double missing = 0.0, double interval = 60.0) {
  MeasuredRun run;
  run.name = "monday";
  run.time = VectorXd::NullaryExpr(channels[0].values.size(),
                                   [&](Eigen::Index i) { return interval * (double(i) + (i < 200 ? 0.0 : missing)); });
  run.channels = std::move(channels);
  auto const driven = tests::experiment(R"(
    duration = "10 h"
    ambient.mean = "22 degC"
    [spindle]
    blocks = [{duration = "50 min", speed = "0 rpm"}, {duration = "10 h", speed = "3000 rpm"}])");
  run.course = std::make_shared<scenarios::ExperimentCourse const>(driven, machine().limits);
  BinnedRun binned;
  binned.run = &run;
  return faulty_sensor(machine(), {binned});
}

TEST(FaultySensor, IsNoneWhereBodiesWarm) {
  EXPECT_FALSE(found({{"T1", false, warming()}, {"T2", false, warming().reverse()}}));
}

TEST(FaultySensor, IsOneWhoseReadingsLeapAndStayForAWhile) {
  auto const sensor = found({{"T1", false, warming()}, {"T2", false, with_leaps(warming(), 3)}});
  ASSERT_TRUE(sensor);
  EXPECT_EQ(sensor->name, "T2");
  EXPECT_EQ(sensor->what, "jumps about as no body's temperature does");
}

VectorXd with_step(double size) {
  VectorXd values = warming();
  values.tail(280).array() += size;
  return values;
}

TEST(FaultySensor, IsOneWhoseReadingsLeapOnceForEver) {
  auto const sensor = found({{"T1", false, warming()}, {"T2", false, with_step(-1.0)}});
  ASSERT_TRUE(sensor);
  EXPECT_EQ(sensor->name, "T2");
  EXPECT_EQ(sensor->what, "jumps by -1 K at 3.33 h of monday and stays there, as no body's temperature does");
}

/// A light ring takes up half a kelvin in the minute after the spindle started, and less in the next.
/// With white noise of 0.1 K.
VectorXd noisy(VectorXd values, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> white(0.0, 0.1);
  for (double& value : values) value += white(random);
  return values;
}

/// Three leaps of seven times the noise are told, but not one in the noise of a body that warms.
TEST(FaultySensor, IsOneWhoseReadingsLeapByLittleMoreThanTheirNoise) {
  constexpr double shrink = 0.7 / 3.0;
  int told = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    VectorXd const leaps = warming() + shrink * (with_leaps(warming(), 3) - warming());
    told += found({{"T1", false, noisy(warming(), 100 + seed)}, {"T2", false, noisy(leaps, seed)}}).has_value();
    EXPECT_FALSE(found({{"T1", false, noisy(warming(), 200 + seed)}, {"T2", false, noisy(warming(), 300 + seed)}}));
  }
  EXPECT_GE(told, 45);
}

TEST(FaultySensor, IsNoneWhereTheSpindleStarts) {
  VectorXd values = warming();
  values.tail(480 - 51).array() += 1.0;
  EXPECT_FALSE(found({{"T1", false, warming()}, {"T2", false, values}}));
}

/// Read every five minutes, oil that answers within two has done so from one sample to the next.
TEST(FaultySensor, IsNoneWhereTheSpindleStartsBetweenTwoSamples) {
  VectorXd oil = VectorXd::Constant(120, 295.15);
  for (Eigen::Index i = 11; i < oil.size(); ++i)
    oil[i] += 3.0 * (1.0 - std::exp(-(300.0 * double(i) - 3000.0) / 100.0));
  EXPECT_FALSE(found({{"T1", false, oil}}, 0.0, 300.0));
  EXPECT_TRUE(found({{"T1", false, oil.reverse()}}, 0.0, 300.0));  // nothing happens then
}

TEST(FaultySensor, IsNoneThatIsDisturbedForASample) {
  VectorXd values = warming();
  values[300] += 3.0;
  EXPECT_FALSE(found({{"T1", false, warming()}, {"T2", false, values}}));
}

TEST(FaultySensor, IsNoneWhereNobodyLookedForAnHour) {
  EXPECT_FALSE(found({{"T1", false, warming()}, {"T2", false, with_step(-1.0)}}, 60.0));
}

/// Each channel from a table of its own: in the rows of one the other has no reading.
std::optional<FaultySensor> found_in_two_tables(VectorXd const& first, VectorXd const& second) {
  double const none = std::numeric_limits<double>::quiet_NaN();
  Eigen::Index const rows = 2 * first.size();
  VectorXd const own = VectorXd::NullaryExpr(rows, [&](Eigen::Index i) { return i % 2 == 0 ? first[i / 2] : none; });
  VectorXd const other = VectorXd::NullaryExpr(rows, [&](Eigen::Index i) { return i % 2 == 0 ? none : second[i / 2]; });
  return found({{"T1", false, own}, {"T2", false, other}});
}

TEST(FaultySensor, IsFoundWhereOtherTablesHaveRowsBetweenItsOwn) {
  auto const sensor = found_in_two_tables(warming(), with_leaps(warming(), 3));
  ASSERT_TRUE(sensor);
  EXPECT_EQ(sensor->name, "T2");
  EXPECT_FALSE(found_in_two_tables(warming(), warming()));
}

/// As in one table: across a missing sample anything may happen.
TEST(FaultySensor, IsNoneAcrossAMissingSampleWhereOtherTablesHaveRowsBetweenItsOwn) {
  VectorXd leaps = with_leaps(warming(), 3);
  for (int k = 0; k < 3; ++k) leaps[100 + 50 * k] = leaps[120 + 50 * k] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(found_in_two_tables(warming(), leaps));
}

/// A body that warms fast goes farther between samples that are farther apart.
TEST(FaultySensor, IsNoneWhereRowsAreKeptAtRandom) {
  VectorXd const rising = 295.15 + 8.0 * (1.0 - (-VectorXd::LinSpaced(480, 0.0, 479.0).array() / 25.0).exp());
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    VectorXd kept = rising;
    for (double& value : kept)
      if (random() % 10 >= 3) value = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(found({{"T1", false, kept}, {"T2", false, warming()}})) << seed;
  }
}

TEST(FaultySensor, IsOneThatShowsNothing) {
  VectorXd const nothing = VectorXd::Constant(480, std::numeric_limits<double>::quiet_NaN());
  auto const sensor = found({{"T1", false, nothing}, {"T2", false, warming()}});
  ASSERT_TRUE(sensor);
  EXPECT_EQ(sensor->name, "T1");
  EXPECT_EQ(sensor->what, "shows nothing in a run");
}

TEST(FaultySensor, IsOneThatMovesNoMore) {
  MeasuredChannel died{"T1", false, warming()};
  died.dead_from = 90.0 * 60.0;
  died.values.tail(390).setConstant(std::numeric_limits<double>::quiet_NaN());
  auto const sensor = found({died, {"T2", false, warming()}});
  ASSERT_TRUE(sensor);
  EXPECT_EQ(sensor->name, "T1");
  EXPECT_EQ(sensor->what, "moves no more from 1.50 h of monday on");
}

TEST(FaultySensor, MayLeapWhereItHangsInTheAir) {
  EXPECT_FALSE(found({{"T1", false, warming()}, {"room", false, with_leaps(warming(), 6)}}));
}

TEST(FaultySensor, IsNotTheMachineWhereSeveralLeap) {
  EXPECT_FALSE(found({{"T1", false, with_leaps(warming(), 3)}, {"T2", false, with_leaps(warming(), 4)}}));
}

TEST(FaultySensor, IsNoDisplacement) { EXPECT_FALSE(found({{"E_Z", true, with_leaps(warming(), 3)}})); }

}  // namespace
}  // namespace thermotwin::twin
