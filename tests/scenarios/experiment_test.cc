#include "scenarios/experiment.h"

#include <gtest/gtest.h>

#include "tests/scenarios/refusal.h"

namespace thermotwin::scenarios {
namespace {

TEST(SampleTimes, GoFromZeroToTheEnd) {
  Experiment experiment;
  experiment.duration = 140 * 60.0;
  experiment.sampling = 120.0;
  std::vector<double> const times = sample_times(experiment);
  EXPECT_EQ(times.size(), 71U);
  EXPECT_EQ(times.front(), 0.0);
  EXPECT_EQ(times.back(), 8400.0);
}

/// 3 · 0.1 is more than 0.3, and 0.7/0.1 less than 7.
TEST(SampleTimes, ReachTheEndInSpiteOfRounding) {
  Experiment experiment;
  experiment.sampling = 0.1;
  for (int const tenths : {3, 6, 7, 9, 12, 1000}) {
    experiment.duration = tenths / 10.0;
    std::vector<double> const times = sample_times(experiment);
    EXPECT_EQ(times.size(), std::size_t(tenths) + 1) << tenths;
    EXPECT_EQ(times.back(), experiment.duration);
  }
}

TEST(SampleTimes, StopBeforeAnUnfinishedInterval) {
  Experiment experiment;
  experiment.duration = 100.0;
  experiment.sampling = 30.0;
  EXPECT_EQ(sample_times(experiment).back(), 90.0);
}

TEST(Experiment, IsReadMoreThanOnce) {
  Experiment experiment;
  experiment.duration = 60.0;
  auto const refused = [&] { return tests::refusal([&] { check_readings(experiment); }); };
  EXPECT_EQ(refused(), "accepted");
  experiment.sampling = 120.0;
  EXPECT_EQ(refused(), "sampling: 2 min is longer than the run, 1 min");
}

TEST(Experiment, RefusesTimesThatCannotBe) {
  auto const refused = [](Experiment const& experiment) { return tests::refusal([&] { check(experiment); }); };
  Experiment experiment;
  experiment.duration = -60.0;
  EXPECT_EQ(refused(experiment), "duration: -1 min must be above 0 s, for example \"4 h\"");
  experiment.duration = 60.0;
  EXPECT_EQ(refused(experiment), "accepted");
  experiment.sampling = 0.0;
  EXPECT_EQ(refused(experiment), "sampling: 0 min must be above 0 s, for example \"4 h\"");
  experiment.sampling = 1e-7;
  EXPECT_EQ(refused(experiment), "sampling: 1e-07 s makes 6.0e+08 readings of 1 min; at most 1e+08 are possible");
  experiment.sampling = 1.0;
  experiment.seed = -2;
  EXPECT_EQ(refused(experiment), "seed: -2 must be 0 or more");
  experiment.seed = 1;
  experiment.start_time_of_day = 90000.0;
  EXPECT_EQ(refused(experiment), "start_time_of_day: 25 h must be from 0 h to below 24 h");
}

}  // namespace
}  // namespace thermotwin::scenarios
