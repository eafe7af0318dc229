#include "twin/diagnosis/binned_run.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "tests/thermal/function_course.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Two channels sampled evenly, along a course that jumps.
MeasuredRun run_of(double duration, double sampling, std::vector<double> jumps,
                   std::function<double(double)> const& signal) {
  MeasuredRun run;
  run.course = std::make_shared<thermal::FunctionCourse>(
      std::vector<std::string>{}, [](double, std::span<double>) {}, std::move(jumps));
  auto const count = Index(std::floor(duration / sampling)) + 1;
  run.time = VectorXd::LinSpaced(count, 0.0, sampling * double(count - 1));
  VectorXd const values = run.time.unaryExpr(signal);
  run.channels = {{"T1", false, values}, {"T2", false, -values}};
  return run;
}

double line(double t) { return 20.0 + t / 900.0; }

/// What a prediction that is linear in time between the ends of every step makes of a channel's rows.
VectorXd predicted(BinnedRun const& binned, std::function<double(double)> const& signal, std::size_t channel = 0) {
  VectorXd rows = VectorXd::Zero(binned.time.size());
  for (std::size_t s = 0; s < binned.steps.size(); ++s) {
    auto const& step = binned.steps[s];
    auto const& readings = binned.readings[channel][s];
    rows[step.row] += readings.at_begin * signal(step.begin) + readings.at_end * signal(step.end);
  }
  return rows;
}

struct Case {
  char const* name;
  double duration, sampling, interval;
  std::vector<double> jumps;
};

class Binned : public testing::TestWithParam<Case> {
 protected:
  MeasuredRun run = run_of(GetParam().duration, GetParam().sampling, GetParam().jumps, line);
  BinnedRun binned = bin(run, GetParam().interval);
};

TEST_P(Binned, StepsFollowEachOtherFromTheFirstSampleToTheLast) {
  EXPECT_EQ(binned.steps.front().begin, run.time[0]);
  EXPECT_NEAR(binned.steps.back().end, run.time[run.time.size() - 1], 1e-6);
  for (std::size_t s = 0; s + 1 < binned.steps.size(); ++s) {
    EXPECT_NEAR(binned.steps[s].end, binned.steps[s + 1].begin, 1e-6);
    int const on = binned.steps[s + 1].row - binned.steps[s].row;
    EXPECT_TRUE(on == 0 || on == 1);
  }
  EXPECT_EQ(binned.steps.back().row, int(binned.time.size()) - 1);
}

TEST_P(Binned, RowsAreShortAndNeverCrossAJump) {
  std::vector<double> begin(std::size_t(binned.time.size()), INFINITY), end(begin.size(), 0.0);
  for (auto const& step : binned.steps) {
    begin[std::size_t(step.row)] = std::min(begin[std::size_t(step.row)], step.begin);
    end[std::size_t(step.row)] = std::max(end[std::size_t(step.row)], step.end);
  }
  for (std::size_t r = 0; r < begin.size(); ++r) {
    EXPECT_LE(end[r] - begin[r], GetParam().interval * (1.0 + 1e-9));
    EXPECT_GE(run.course->next_jump(begin[r]), end[r] - 1e-6) << begin[r];
    EXPECT_GE(binned.time[Index(r)], begin[r]);
    EXPECT_LE(binned.time[Index(r)], end[r]);
  }
}

/// 20 s, 40 s, 80 s, …; a rest of less than half a step is not left alone.
TEST_P(Binned, StepsGrowFromTheLastJump) {
  for (auto const& step : binned.steps) {
    double jump = 0.0;
    for (double const j : GetParam().jumps)
      if (j <= step.begin + 1e-6) jump = j;
    EXPECT_LE(step.end - step.begin, 1.5 * (20.0 + step.begin - jump) + 1e-6) << step.begin;
  }
}

TEST_P(Binned, WeightsOfEveryRowAddUpToOne) {
  VectorXd const sums = predicted(binned, [](double) { return 1.0; });
  EXPECT_TRUE(sums.isApprox(VectorXd::Ones(sums.size()), 1e-12));
  for (auto const& readings : binned.readings[0]) EXPECT_GE(std::min(readings.at_begin, readings.at_end), -1e-9);
}

/// A signal that is linear within each step has the prediction's mean, to round-off, wherever the samples lie.
TEST_P(Binned, MeanOfALinearSignalIsExact) {
  VectorXd const prediction = predicted(binned, line);
  for (Index r = 0; r < binned.time.size(); ++r) {
    if (binned.samples(r, 0) == 0.0) continue;
    EXPECT_NEAR(binned.values(r, 0), prediction[r], 1e-9);
    EXPECT_NEAR(binned.values(r, 0), line(binned.time[r]), 1e-9);
    EXPECT_EQ(binned.values(r, 1), -binned.values(r, 0));
  }
}

/// And so has one that is cubic within each step, by its slopes at the ends.
TEST_P(Binned, MeanOfACubicSignalIsExact) {
  auto const cubic = [](double t) { return 20.0 + std::pow(t / 1000.0 - 2.0, 3); };
  auto const slope = [](double t) { return 3e-3 * std::pow(t / 1000.0 - 2.0, 2); };
  auto const curved =
      bin(run_of(GetParam().duration, GetParam().sampling, GetParam().jumps, cubic), GetParam().interval);
  VectorXd rows = predicted(curved, cubic);
  for (std::size_t s = 0; s < curved.steps.size(); ++s) {
    auto const& step = curved.steps[s];
    auto const& readings = curved.readings[0][s];
    double const straight = (cubic(step.end) - cubic(step.begin)) / step.length();
    rows[step.row] +=
        readings.bend_at_begin * (slope(step.begin) - straight) + readings.bend_at_end * (slope(step.end) - straight);
  }
  for (Index r = 0; r < rows.size(); ++r) {
    if (curved.samples(r, 0) == 0.0) continue;
    EXPECT_NEAR(curved.values(r, 0), rows[r], 1e-8);
  }
}

TEST_P(Binned, EverySampleIsInOneRow) {
  EXPECT_EQ(binned.samples.col(0).sum(), double(run.time.size()));
  EXPECT_NEAR((binned.samples.col(0).array() * binned.time.array()).sum(), run.time.sum(), 1e-6 * run.time.sum());
}

INSTANTIATE_TEST_SUITE_P(
    Runs, Binned,
    testing::Values(Case{"even", 7200.0, 60.0, 300.0, {}},
                    Case{"jumps_between_samples", 7200.0, 60.0, 300.0, {1830.0, 5000.0}},
                    Case{"jumps_at_samples", 7200.0, 60.0, 300.0, {1800.0, 5040.0}},
                    Case{"jumps_closer_than_samples", 7200.0, 60.0, 600.0, {1801.0, 1815.0, 1850.0, 1900.0}},
                    Case{"jumps_a_rounding_error_apart", 7200.0, 60.0, 300.0, {4.1 * 60.0, 246.0, 5000.0}},
                    Case{"jump_at_the_end_but_for_rounding", 7200.0, 60.0, 300.0, {1800.0, 7200.0 - 1e-12}},
                    Case{"one_row", 600.0, 10.0, 3600.0, {}}, Case{"one_sample_a_row", 3600.0, 60.0, 60.0, {130.0}},
                    Case{"uneven_end", 7013.0, 7.0, 300.0, {3333.0}}),
    [](auto const& info) { return std::string(info.param.name); });

TEST(BinnedRun, MissingSamplesAreNotAveraged) {
  double const nan = std::nan("");
  auto run = run_of(1800.0, 60.0, {}, [](double t) { return t; });
  run.channels[0].values.segment(0, 3).setConstant(nan);
  run.channels[0].values.segment(10, 5).setConstant(nan);
  auto const binned = bin(run, 300.0);
  ASSERT_EQ(binned.time.size(), 6);
  EXPECT_EQ(binned.samples(0, 0), 2.0);
  EXPECT_DOUBLE_EQ(binned.values(0, 0), 210.0);  // 180 s and 240 s
  EXPECT_EQ(binned.samples(2, 0), 0.0);
  EXPECT_TRUE(std::isnan(binned.values(2, 0)));
  EXPECT_EQ(binned.samples(2, 1), 5.0);
  EXPECT_DOUBLE_EQ(binned.values(2, 1), -720.0);
}

/// Beside a thermometer that is read every ten seconds a laser that is read every ten minutes, along a course that
/// turns between two of its readings: each is held against the twin at its own time, and none before the turn has
/// anything of what comes after.
TEST(BinnedRun, ReadingsOfASlowerLoggerAreThoseOfTheirOwnTime) {
  auto const turning = [](double t) { return 20.0 + std::max(0.0, t - 4000.0) / 60.0; };
  auto run = run_of(4 * 3600.0, 10.0, {4000.0}, turning);
  for (Index i = 0; i < run.time.size(); ++i)
    if (i % 60 != 37) run.channels[1].values[i] = std::nan("");
  auto const binned = bin(run, 300.0);
  VectorXd const expected = predicted(binned, turning, 1);
  int rows = 0;
  for (Index r = 0; r < binned.time.size(); ++r) {
    if (binned.samples(r, 1) == 0.0) continue;
    EXPECT_EQ(binned.samples(r, 1), 1.0);
    EXPECT_NEAR(binned.values(r, 1), -expected[r], 1e-9) << r;
    EXPECT_TRUE((run.channels[1].values.array() == binned.values(r, 1)).any()) << "a reading, not what lies between";
    ++rows;
  }
  EXPECT_EQ(rows, 24);
}

/// The response to what may have been given instead is as exact as that to what was.
TEST(BinnedRun, RowsDoNotCrossAJumpOfAnAlternative) {
  auto run = run_of(1800.0, 60.0, {900.0}, line);
  run.alternatives = {{"other", run_of(1800.0, 60.0, {400.0}, line).course}};
  std::vector<double> ends;
  for (auto const& step : bin(run, 300.0).steps) ends.push_back(step.end);
  EXPECT_EQ(std::count(ends.begin(), ends.end(), 400.0), 1);
  EXPECT_EQ(std::count(ends.begin(), ends.end(), 900.0), 1);
}

/// Between two jumps closer than the samples nothing was measured.
TEST(BinnedRun, RowsBetweenTwoSamplesHaveNoData) {
  auto const run = run_of(1200.0, 60.0, {601.0, 650.0}, line);
  auto const binned = bin(run, 600.0);
  bool found = false;
  for (Index r = 0; r < binned.time.size(); ++r)
    if (binned.samples(r, 0) == 0.0) {
      EXPECT_TRUE(std::isnan(binned.values(r, 0)));
      EXPECT_TRUE(binned.time[r] >= 601.0 && binned.time[r] <= 650.0);
      found = true;
    }
  EXPECT_TRUE(found);
}

/// A table in minutes may begin to move a rounding error after the run.
TEST(BinnedRun, JumpAtTheStartButForRoundingMakesNoRow) {
  auto const run = run_of(1800.0, 60.0, {1e-13}, line);
  auto const binned = bin(run, 300.0);
  ASSERT_EQ(binned.time.size(), 6);
  EXPECT_EQ(binned.steps.front().begin, 0.0);
  for (auto const& step : binned.steps) EXPECT_GT(step.length(), 1.0);
  EXPECT_TRUE(predicted(binned, line).isApprox(binned.values.col(0), 1e-12));
}

TEST(BinnedRun, FittingIntervalKeepsTheNumberOfRows) {
  for (double const hours : {0.5, 4.0, 24.0, 100.0}) {
    auto const run = run_of(3600.0 * hours, 60.0, {}, line);
    double const interval = fitting_interval(run, 200);
    auto const rows = bin(run, interval).time.size();
    EXPECT_LE(rows, 200) << hours;
    EXPECT_GE(interval, hours > 5.0 ? 300.0 : 60.0);
  }
}

/// The programme changed at some time between 3540 s and 3600 s, so that the sample at 3600 s may be of before or
/// after.
TEST(Binned, LeavesOutTheSampleThatShowsAChangeFirst) {
  auto run = run_of(7200.0, 60.0, {3600.0}, [](double t) { return t == 3600.0 ? 1e6 : line(t); });
  run.changes = {{3600.0, 60.0, 1.0}};
  auto const binned = bin(run, 600.0);
  EXPECT_EQ(binned.samples.col(0).sum(), double(run.time.size() - 1));
  EXPECT_LT((predicted(binned, line) - binned.values.col(0)).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace thermotwin::twin
