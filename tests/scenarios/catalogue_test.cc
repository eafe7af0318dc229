#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scenarios/course.h"
#include "thermal/units.h"
#include "twin/file/schema.h"
#include "twin/file/value.h"

namespace thermotwin::scenarios {
namespace {

using thermal::from_unit;
using thermal::to_unit;

std::filesystem::path catalogue() { return std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "scenarios/catalogue"; }

std::vector<std::string> names() {
  std::vector<std::string> result;
  for (auto const& entry : std::filesystem::directory_iterator(catalogue())) result.push_back(entry.path().stem());
  std::sort(result.begin(), result.end());
  return result;
}

Experiment read(std::string const& name) {
  Experiment experiment;
  twin::read_fields(twin::read_toml(catalogue() / (name + ".toml")), experiment);
  experiment.directory = catalogue();
  return experiment;
}

/// A machine that can do whatever the catalogue asks for.
MachineLimits machine() { return {from_unit(6000, "rpm"), {{"z", from_unit(24, "m/min"), 0.010, 0.12, 0.72}}}; }

double at(ExperimentCourse const& course, std::string const& channel, double t) {
  std::vector<double> values(course.channels().size());
  course.evaluate(t, values);
  std::size_t i = 0;
  while (course.channels().at(i).name != channel) ++i;
  return values[i];
}

double speed_rpm(ExperimentCourse const& course, double minute) {
  return to_unit(at(course, "spindle.speed", 60.0 * minute), "rpm");
}

class Catalogue : public testing::TestWithParam<std::string> {};

TEST_P(Catalogue, RunsOnAMachine) {
  Experiment const experiment = read(GetParam());
  EXPECT_FALSE(experiment.title.empty());
  for (Recording const& recording : experiment.recorded) {
    auto const file = resolved_path(recording.file, experiment.directory);
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no measured data: " << file;
  }
  ExperimentCourse const course(experiment, machine());
  EXPECT_GE(sample_times(experiment).size(), 30U);
  EXPECT_TRUE(course.next_jump(experiment.duration) > experiment.duration);
}

INSTANTIATE_TEST_SUITE_P(Files, Catalogue, testing::ValuesIn(names()), [](auto const& file) { return file.param; });

TEST(SpindleStandard, RunsFourHoursAndRestsOne) {
  Experiment const experiment = read("spindle_standard");
  ExperimentCourse const course(experiment, machine());
  EXPECT_EQ(experiment.duration, 300 * 60.0);
  std::vector<std::pair<double, double>> const expected = {{0, 1500},   {29.9, 1500},  {30, 3000},  {60, 4500},
                                                           {90, 6000},  {120, 0},      {135, 4500}, {165, 3000},
                                                           {195, 6000}, {239.9, 6000}, {240, 0},    {300, 0}};
  for (auto const& [minute, rpm] : expected) EXPECT_NEAR(speed_rpm(course, minute), rpm, 1e-9) << minute;
}

TEST(Duty003, Runs50Stops10Runs60Stops20) {
  Experiment const experiment = read("duty_003");
  ExperimentCourse const course(experiment, machine());
  for (double minute = 0.0; minute < 140.0; minute += 2.0) {
    bool const running = minute < 50.0 || (minute >= 60.0 && minute < 120.0);
    EXPECT_NEAR(speed_rpm(course, minute), running ? 4500.0 : 0.0, 1e-9) << minute;
    EXPECT_EQ(at(course, "coolant.on", 60.0 * minute), 1.0);
  }
  EXPECT_EQ(experiment.sampling, 120.0);
}

TEST(FeedRuns, TurnTheScrewAsInTheGoldenTable) {
  for (auto const& [feed, rpm] : {std::pair{"8000", 704.0}, std::pair{"12000", 1056.0}, std::pair{"16000", 1408.0}}) {
    Experiment const experiment = read(std::string("feed_") + feed);
    ExperimentCourse const course(experiment, machine());
    EXPECT_NEAR(to_unit(at(course, "z.speed", 0.0), "rpm"), rpm, 1e-9);
    EXPECT_EQ(targets(*experiment.laser).size(), 13U);
    EXPECT_EQ(measurement_times(*experiment.laser, experiment.duration).size(), 17U);
  }
}

TEST(Etve, StandsStillWhileTheAirSwings) {
  Experiment const experiment = read("etve");
  ExperimentCourse const course(experiment, machine());
  double const hour = 3600.0;
  auto const air = [&](double t) { return at(course, "ambient.temperature", t); };
  for (double const t : sample_times(experiment)) EXPECT_EQ(at(course, "spindle.speed", t), 0.0);
  EXPECT_EQ(experiment.duration, 24 * hour);
  EXPECT_NEAR(air(7 * hour) - air(19 * hour), 3.0 - 0.25,
              0.1);  // peak to peak less the drift of half a day, and the door
  EXPECT_LT(air(6 * hour + 1200.0) - air(6 * hour), -2.0);
}

struct Batch {
  double start_degC;
  double rise_K;
  int rpm;
};

Batch batch(std::string const& name) {
  Experiment const experiment = read("batch_004_" + name);
  ExperimentCourse const course(experiment, machine());
  EXPECT_EQ(experiment.duration, 270 * 60.0);
  EXPECT_EQ(experiment.sampling, 180.0);
  double const start = at(course, "ambient.temperature", 0.0);
  double const end = at(course, "ambient.temperature", experiment.duration);
  return {to_unit(start, "degC"), end - start, static_cast<int>(std::lround(speed_rpm(course, 100.0)))};
}

TEST(Batches, CoverTheSeasonsSpeedsAndDrifts) {
  std::vector<std::string> const model = {"K01", "K02", "K03", "K04", "K05", "K06",
                                          "K07", "K08", "K09", "K10", "K11", "K12"};
  std::map<int, int> batches_at;
  std::set<long> rises;
  double coldest = 100.0;
  double warmest = 0.0;
  for (std::string const& name : model) {
    Batch const b = batch(name);
    ++batches_at[b.rpm];
    rises.insert(std::lround(b.rise_K * 10.0));
    coldest = std::min(coldest, b.start_degC);
    warmest = std::max(warmest, b.start_degC);
    EXPECT_GE(std::min(b.start_degC, b.start_degC + b.rise_K), 5.0) << name;
    EXPECT_LE(std::max(b.start_degC, b.start_degC + b.rise_K), 35.0) << name;
    EXPECT_GE(b.rise_K, -1.001) << name;
    EXPECT_LE(b.rise_K, 5.001) << name;
  }
  EXPECT_EQ(batches_at, (std::map<int, int>{{2000, 4}, {4000, 4}, {6000, 4}}));
  EXPECT_EQ(rises.size(), 12U);
  EXPECT_LT(coldest, 10.0);
  EXPECT_GT(warmest, 30.0);
}

TEST(Batches, VerifyInAutumnAndWinter) {
  for (int i = 1; i <= 6; ++i) {
    Batch const b = batch("V" + std::to_string(i));
    EXPECT_EQ(b.rpm, 2000 * ((i - 1) % 3 + 1));
    EXPECT_NEAR(b.start_degC, i <= 3 ? 23.1 : 11.5, 2.01);
  }
}

TEST(Spindle5Probe, TurnsAsRecorded) {
  Experiment const experiment = read("spindle_5probe");
  if (!std::filesystem::exists(resolved_path(experiment.recorded[0].file, experiment.directory))) {
    GTEST_SKIP() << "no measured data: set THERMOTWIN_MEASURED_DATA";
  }
  ExperimentCourse const course(experiment, machine());
  for (auto const& [hour, rpm] :
       {std::pair{2.0, 1250}, {6.0, 0}, {10.0, 2500}, {18.0, 3750}, {26.0, 5000}, {30.0, 0}}) {
    EXPECT_NEAR(speed_rpm(course, 60.0 * hour), rpm, 1e-9) << hour;
  }
  EXPECT_NEAR(to_unit(at(course, "ambient.temperature", 0.0), "degC"), 26.4744, 1e-9);
}

}  // namespace
}  // namespace thermotwin::scenarios
