#include "twin/diagnosis/measured_run.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "output/csv.h"
#include "output/dataset_file.h"
#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/diagnosis/measured_data.h"
#include "twin/diagnosis/prediction.h"
#include "twin/experiment_file.h"
#include "twin/run.h"

/// What was measured, laid over a machine: a simulated run read back is the run, and whatever is wrong with a record is
/// told.
namespace thermotwin::twin {
namespace {

using testing::Contains;
using testing::HasSubstr;
using thermotwin::tests::refusal;
using thermotwin::tests::TemporaryDirectory;
using thermotwin::twin::tests::value_at;

Machine const& machine() {
  static Machine const v450 = Machine::read(machine_file("v450"));
  return v450;
}

output::Dataset const& simulated() {
  static output::Dataset const dataset = [] {
    auto const document = parse_toml(R"(
      title = "speeds, feeds and a warming room"
      machine = "v450"
      duration = "3 h"
      ambient.mean = "22 degC"
      ambient.drift = "1.2 K/h"
      ambient.stratification = "0.5 K/m"
      ambient.daily_cycle.amplitude = "2 K"
      [spindle]
      blocks = [{duration = "50 min", speed = "4000 rpm"}, {duration = "40 min", speed = "0 rpm"},
                {duration = "30 min", speed = "6000 rpm"}]
      [[axes]]
      axis = "z"
      blocks = [{duration = "1 h", feed = "6000 mm/min"}])",
                                     "experiment.toml");
    return run(machine(), read_experiment(document, "experiment.toml"), {}).dataset;
  }();
  return dataset;
}

output::Channel& channel(std::vector<output::Channel>& channels, std::string const& name) {
  return *std::find_if(channels.begin(), channels.end(), [&](auto const& c) { return c.name == name; });
}

void keep_inputs(output::Dataset& dataset, std::vector<std::string> const& names) {
  std::erase_if(dataset.inputs,
                [&](auto const& c) { return std::find(names.begin(), names.end(), c.name) == names.end(); });
}

/// What the machine itself does along the run, against what it did [K], sensors' own errors left out.
double worst_temperature(MeasuredRun const& run, output::Dataset const& dataset) {
  auto sensors = machine();
  for (auto& sensor : sensors.sensors) sensor.description.lag = sensor.description.stem_loss = 0.0;
  auto const predicted = predict(sensors, run);
  double worst = 0.0;
  for (std::size_t c = 0; c < run.channels.size(); ++c) {
    if (run.channels[c].displacement) continue;
    auto truth = dataset.truth_readings;
    Eigen::VectorXd const true_course = channel(truth, run.channels[c].name).values.array() + 273.15;
    worst = std::max(worst, (predicted.col(Eigen::Index(c)) - true_course).cwiseAbs().maxCoeff());
  }
  return worst;
}

TEST(MeasuredRun, SimulatedDataLeadTheMachineThroughTheSameTemperatures) {
  auto const run = measured_run(simulated(), machine(), "simulated");
  EXPECT_EQ(run.time.size(), 181);
  EXPECT_LT(worst_temperature(run, simulated()), 1e-3);
}

TEST(MeasuredRun, DisplacementsAreThoseOfTheRunAndInMetres) {
  auto const run = measured_run(simulated(), machine(), "simulated");
  auto const predicted = predict(machine(), run);
  int displacements = 0;
  for (std::size_t c = 0; c < run.channels.size(); ++c) {
    if (!run.channels[c].displacement) continue;
    auto truth = simulated().truth_displacements;
    Eigen::VectorXd const course = channel(truth, run.channels[c].name).values * 1e-6;
    EXPECT_LT((predicted.col(Eigen::Index(c)) - course).cwiseAbs().maxCoeff(), 2e-8) << run.channels[c].name;
    ++displacements;
  }
  EXPECT_EQ(displacements, int(machine().displacements.size()));
}

TEST(MeasuredRun, WhatFollowsFromSpeedAndAirNeedNotBeRecorded) {
  auto dataset = simulated();
  keep_inputs(dataset, {"spindle.speed", "ambient.temperature", "ambient.gradient", "z.feed"});
  auto const run = measured_run(dataset, machine(), "bare");
  EXPECT_LT(worst_temperature(run, dataset), 1e-3);
}

TEST(MeasuredRun, SuppositionsAreTold) {
  auto dataset = simulated();
  keep_inputs(dataset, {"spindle.speed", "ambient.temperature"});
  auto const run = measured_run(dataset, machine(), "bare");
  EXPECT_THAT(run.remarks, Contains(HasSubstr("as warm above as below")));
  EXPECT_THAT(run.remarks, testing::Not(Contains(HasSubstr("the coolant is supplied at 20 degC"))));
}

/// No machine part asks for it; the flood that is tried does.
TEST(MeasuredRun, TheTemperatureOfCoolantThatIsSwitchedIsSupposed) {
  auto dataset = simulated();
  keep_inputs(dataset, {"spindle.speed", "ambient.temperature"});
  dataset.inputs.push_back({"coolant.on", "1", "", (dataset.time_s.array() > 3600.0).cast<double>().matrix()});
  EXPECT_THAT(measured_run(dataset, machine(), "wet").remarks,
              Contains(HasSubstr("the coolant is supplied at 20 degC")));
}

TEST(MeasuredRun, AnInputThatBeginsLaterThanReadingsIsTold) {
  auto dataset = simulated();
  channel(dataset.inputs, "spindle.speed").values.head(60).setConstant(std::nan(""));
  EXPECT_THAT(measured_run(dataset, machine(), "late").remarks,
              Contains("'spindle.speed' is recorded from 1.00 h on only; for the readings before that its first value "
                       "is taken"));
}

/// What a digital sensor shows that was just switched on, unless it is that warm.
TEST(MeasuredRun, APowerOnValueIsLeftOut) {
  auto dataset = simulated();
  dataset.readings[4].values[7] = dataset.readings[4].values[90] = 85.0;
  auto const run = measured_run(dataset, machine(), "cold");
  EXPECT_THAT(run.remarks, Contains("'" + dataset.readings[4].name +
                                    "' reads 85 degC in 2 rows from 0.12 h on, as a "
                                    "DS18B20 does that was switched on: left out"));
  EXPECT_TRUE(std::isnan(run.channels[4].values[7]));
  dataset.readings[4].values.segment(5, 4) << 82.0, 84.0, 85.0, 83.0;  // it is as hot as that
  EXPECT_FALSE(std::isnan(measured_run(dataset, machine(), "hot").channels[4].values[7]));
}

/// Whose counter of revolutions goes on by 55 % of what the rows show, as where it stands for 27 s of each minute.
TEST(MeasuredRun, ASpeedThatChangesBetweenRowsIsTold) {
  auto dataset = simulated();
  EXPECT_THAT(measured_run(dataset, machine(), "whole").remarks,
              testing::Not(Contains(HasSubstr("spindle.revolutions"))));
  channel(dataset.inputs, "spindle.revolutions").values *= 0.55;
  EXPECT_THAT(measured_run(dataset, machine(), "coarse").remarks,
              Contains("'spindle.speed' makes 380000 revolutions in all, 'spindle.revolutions' 209000: the speed "
                       "changes between two rows, where nothing is known of it; rows closer together show what was "
                       "given"));
}

/// A challenge's runs keep no file of a machine; the name of the finer form is that of the machine.
TEST(MeasuredRun, OfAnotherMachineIsTold) {
  auto dataset = simulated();
  auto const remarks = [&] { return measured_run(dataset, machine(), "monday").remarks; };
  EXPECT_THAT(remarks(), testing::Not(Contains(HasSubstr("it is a run of"))));
  for (std::string const same : {"v450", "v450_fine"}) {
    dataset.provenance["machine.file"] = "name = \"" + same + "\"\n";
    EXPECT_THAT(remarks(), testing::Not(Contains(HasSubstr("it is a run of")))) << same;
  }
  dataset.provenance["machine.file"] = "name = \"g200\"\n";
  EXPECT_THAT(remarks(), Contains("it is a run of 'g200', the machine file is 'v450'"));
}

TEST(MeasuredRun, NoisySpeedJumpsWhereTheProgrammeDoesOnly) {
  auto dataset = simulated();
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, 15.0);
  for (double& rpm : channel(dataset.inputs, "spindle.speed").values) rpm += noise(random);
  auto const run = measured_run(dataset, machine(), "noisy");
  std::vector<double> jumps;
  for (double t = run.course->next_jump(0.0); t < 3 * 3600.0; t = run.course->next_jump(t)) jumps.push_back(t / 60.0);
  EXPECT_THAT(jumps, testing::IsSupersetOf({50.0, 90.0, 120.0}));
  EXPECT_LE(jumps.size(), 4u);  // and the end of the feed programme
  EXPECT_LT(worst_temperature(run, dataset), 0.05);
}

TEST(MeasuredRun, TableOfAnyoneGivesTheSameRunAsTheDataSet) {
  TemporaryDirectory const folder;
  output::write(simulated(), folder / "run.h5");
  output::export_csv(simulated(), folder / "run.csv");
  auto const from_h5 = read_measured_run(folder / "run.h5", machine());
  auto const from_csv = read_measured_run(folder / "run.csv", machine());
  ASSERT_EQ(from_h5.channels.size(), from_csv.channels.size());
  EXPECT_TRUE(predict(machine(), from_h5).isApprox(predict(machine(), from_csv), 1e-9));
}

TEST(MeasuredRun, DeadSensorsAndGapsBecomeRemarks) {
  auto dataset = simulated();
  dataset.readings[0].values.setConstant(21.0);
  dataset.readings[1].values.setConstant(std::nan(""));
  dataset.readings[2].values.tail(60).setConstant(dataset.readings[2].values[120]);
  dataset.readings[3].values.segment(60, 30).setConstant(std::nan(""));
  dataset.readings[4].values[7] = -127.0;  // what a digital sensor says when nobody answers
  auto const run = measured_run(dataset, machine(), "poor");
  auto const name = [&](int i) { return "'" + dataset.readings[std::size_t(i)].name + "'"; };
  EXPECT_THAT(run.remarks, Contains(HasSubstr(name(0) + " is dead: it never moves")));
  EXPECT_THAT(run.remarks, Contains(HasSubstr(name(1) + " is dead: no reading")));
  EXPECT_THAT(run.remarks, Contains(HasSubstr(name(2) + " is dead from 2.0")));
  EXPECT_THAT(run.remarks, Contains(HasSubstr(name(3) + " has no reading for 0.52 h from 0.98 h on")));
  EXPECT_TRUE(run.channels[0].values.array().isNaN().all());
  EXPECT_TRUE(run.channels[2].values.tail(59).array().isNaN().all());
  EXPECT_TRUE(std::isfinite(run.channels[2].values[100]));
  EXPECT_TRUE(std::isnan(run.channels[4].values[7]));
}

/// Coarse readings of a body that warms to a steady state stand for longer and longer; those of one that was cut off
/// do so at once.
TEST(MeasuredRun, ASensorThatIsNearlySteadyIsNotDead) {
  MeasuredData data;
  data.time = Eigen::VectorXd::LinSpaced(151, 0.0, 5 * 3600.0);
  Eigen::VectorXd const rising = 22.0 + 5.0 * (1.0 - (-data.time.array() / 5400.0).exp());
  auto const coarse = [](Eigen::VectorXd const& values) -> Eigen::VectorXd {
    return 0.0625 * (values / 0.0625).array().round();
  };
  Eigen::VectorXd cut = rising;
  cut.tail(100).setConstant(rising[50]);
  data.readings = {{"T1", "degC", "", coarse(rising)}, {"T2", "degC", "", coarse(cut)}, {"T3", "degC", "", rising}};
  data.inputs = {{"spindle.speed", "rad/s", {0.0}, {0.0}}, {"ambient.temperature", "K", {0.0}, {293.0}}};
  auto const run = measured_run(std::move(data), machine(), "coarse");
  EXPECT_FALSE(run.channels[0].dead_from);
  EXPECT_TRUE(run.channels[1].dead_from);
  EXPECT_FALSE(run.channels[2].dead_from);
}

/// A value of one row, there and back; what goes there and stays is none, nor what noise does.
TEST(MeasuredRun, AValueThatStandsAloneIsLeftOutAndTold) {
  MeasuredData data;
  data.time = Eigen::VectorXd::LinSpaced(121, 0.0, 2 * 3600.0);
  Eigen::VectorXd const rising = 22.0 + data.time.array() / 3600.0;
  Eigen::VectorXd spiked = rising, jumped = rising, noisy = rising, moved = 10.0 * (rising.array() - 22.0);
  spiked[60] += 40.0;
  spiked[90] -= 15.0;
  jumped.tail(60).array() += 10.0;
  for (Eigen::Index r = 0; r < noisy.size(); ++r) noisy[r] += (r % 2 == 0 ? 1.5 : -1.5);
  moved[30] = 500.0;
  data.readings = {{"T1", "degC", "", spiked}, {"T2", "degC", "", jumped}, {"T3", "degC", "", noisy}};
  data.displacements = {{"E_Z", "um", "", moved}};
  data.inputs = {{"spindle.speed", "rad/s", {0.0}, {0.0}}, {"ambient.temperature", "K", {0.0}, {293.0}}};
  auto const run = measured_run(std::move(data), machine(), "spiked");
  auto const missing = [&](int channel) { return run.channels[std::size_t(channel)].values.array().isNaN().count(); };
  EXPECT_TRUE(std::isnan(run.channels[0].values[60]) && std::isnan(run.channels[0].values[90]));
  EXPECT_EQ(missing(0), 2);
  EXPECT_EQ(missing(1) + missing(2), 0);
  EXPECT_TRUE(std::isnan(run.channels[3].values[30]));
  EXPECT_EQ(missing(3), 1);
  EXPECT_THAT(run.remarks, Contains("'T1' reads 63 degC in one row at 1.00 h, and so in 1 more, far from the rows "
                                    "before and after: left out"));
  EXPECT_THAT(run.remarks, Contains(HasSubstr("'E_Z' reads 500 um in one row at 0.50 h, far")));
}

/// The rows of two tables lie between one another, and a frozen sensor has readings in one of them.
TEST(MeasuredRun, ASensorThatStopsIsDeadWhereOtherTablesHaveRowsToo) {
  MeasuredData data;
  data.time = Eigen::VectorXd::LinSpaced(361, 0.0, 3 * 3600.0);
  Eigen::VectorXd const rising = 22.0 + data.time.array() / 3600.0;
  Eigen::VectorXd frozen = rising.cwiseMin(24.0), late = frozen, alive = rising;
  for (Eigen::Index r = 0; r < data.time.size(); ++r) {
    if (r % 2 == 0) frozen[r] = std::nan("");
    if (r % 2 == 0 || r > 260) late[r] = std::nan("");  // 10 rows stand still, too few
    if (r % 2 == 1) alive[r] = std::nan("");
  }
  data.readings = {{"T1", "degC", "", frozen}, {"T2", "degC", "", alive}, {"T3", "degC", "", late}};
  data.inputs = {{"spindle.speed", "rad/s", {0.0}, {0.0}}, {"ambient.temperature", "K", {0.0}, {293.0}}};
  auto const run = measured_run(std::move(data), machine(), "two tables");
  EXPECT_THAT(run.remarks, Contains("'T1' is dead from 2.01 h on: it moves no more"));
  EXPECT_EQ(run.channels[0].dead_from, run.time[241]);
  EXPECT_FALSE(run.channels[1].dead_from);
  EXPECT_TRUE(run.channels[0].values.tail(361 - 241).array().isNaN().all());
  EXPECT_TRUE(std::isfinite(run.channels[0].values[239]));
  EXPECT_THAT(run.remarks, testing::Not(Contains(HasSubstr("'T2' is dead"))));
  EXPECT_THAT(run.remarks, testing::Not(Contains(HasSubstr("'T3' is dead"))));
}

TEST(MeasuredRun, WhatMayHaveBeenGivenInAGapIsTheOtherExtremeInEachHalf) {
  auto dataset = tests::without_rows(simulated(), 54.0 * 60.0, 74.0 * 60.0);
  keep_inputs(dataset, {"spindle.speed", "ambient.temperature", "z.feed", "machine.on"});
  auto run = measured_run(dataset, machine(), "gap");
  std::erase_if(run.alternatives, [](auto const& alternative) { return alternative.name.starts_with("ambient"); });
  std::vector<std::string> names;
  for (auto const& alternative : run.alternatives) names.push_back(alternative.name);
  EXPECT_THAT(names, testing::UnorderedElementsAre("spindle.speed from 0.90 h to 1.23 h, first half",
                                                   "spindle.speed from 0.90 h to 1.23 h, second half",
                                                   "z.feed from 0.90 h to 1.23 h, first half",
                                                   "z.feed from 0.90 h to 1.23 h, second half"));
  double const fastest = thermal::from_unit(6000.0, "rpm");
  for (auto const& [name, course, deviation, for_drawn] : run.alternatives) {
    EXPECT_EQ(deviation, 0.7);
    EXPECT_FALSE(for_drawn);
    bool const spindle = name.starts_with("spindle"), first = name.ends_with("first half");
    for (double const minute : {53.0, 58.0, 70.0, 75.0}) {
      bool const other = first ? minute == 58.0 : minute == 70.0;
      double const t = 60.0 * minute;
      EXPECT_NEAR(value_at(*course, "spindle.speed", t), spindle && other ? fastest : 0.0, 1e-9) << name << minute;
      EXPECT_NEAR(value_at(*course, "z.feed", t), minute > 74.0 || (!spindle && other) ? 0.0 : 0.1, 1e-9)
          << name << minute;
      EXPECT_EQ(value_at(*course, "machine.on", t), 1.0);
    }
  }
}

/// Of what goes along straight lines and changes at all.
TEST(MeasuredRun, TheRoomMayBeOtherThanItsRecord) {
  auto dataset = simulated();
  keep_inputs(dataset, {"spindle.speed", "ambient.temperature"});
  auto& room = channel(dataset.inputs, "ambient.temperature").values;
  room.setConstant(22.0);
  EXPECT_TRUE(measured_run(dataset, machine(), "constant").alternatives.empty());
  room = 20.0 + dataset.time_s.array() / 3600.0;
  auto const run = measured_run(dataset, machine(), "rising");
  ASSERT_EQ(run.alternatives.size(), 4U);
  EXPECT_EQ(run.alternatives[0].name, "ambient.temperature 30 s before its record");
  EXPECT_EQ(run.alternatives[1].name, "ambient.temperature as walls follow it");
  EXPECT_EQ(run.alternatives[2].name, "ambient.temperature and a cosine of the day");
  EXPECT_EQ(run.alternatives[3].name, "ambient.temperature and a sine of the day");
  auto const at = [](thermal::Course const& course, double t) { return value_at(course, "ambient.temperature", t); };
  for (double const t : {600.0, 2000.0}) {
    EXPECT_NEAR(at(*run.alternatives[0].course, t), at(*run.course, t + 30.0), 1e-9);
    double const hours = t / 3600.0, lag = 6.0;  // a kelvin an hour, through a lag, from row to row
    EXPECT_NEAR(at(*run.alternatives[1].course, t), 293.15 + hours - lag * (1.0 - std::exp(-hours / lag)), 1e-5);
    double const angle = 2.0 * std::numbers::pi * hours / 24.0;
    EXPECT_NEAR(at(*run.alternatives[2].course, t), at(*run.course, t) + std::cos(angle), 1e-5);
    EXPECT_NEAR(at(*run.alternatives[3].course, t), at(*run.course, t) + std::sin(angle), 1e-5);
    for (auto const& alternative : run.alternatives)
      EXPECT_EQ(value_at(*alternative.course, "spindle.speed", t), value_at(*run.course, "spindle.speed", t));
  }
}

/// A speed in one table and its share in another: the screw turned as fast as recorded, for a share that nobody knows.
TEST(MeasuredRun, OfAnAxisOnlyWhatWasNotRecordedMayHaveBeenOtherwise) {
  auto dataset = simulated();
  keep_inputs(dataset, {"spindle.speed", "ambient.temperature", "z.feed", "z.duty"});
  channel(dataset.inputs, "z.duty").values.segment(35, 20).setConstant(std::nan(""));
  auto const run = measured_run(dataset, machine(), "gap");
  ASSERT_EQ(run.alternatives.size(), 6U);  // the last four are of the room
  EXPECT_EQ(run.alternatives[0].name, "z.duty from 0.57 h to 0.92 h, first half");
  EXPECT_EQ(run.alternatives[1].name, "z.duty from 0.57 h to 0.92 h, second half");
  EXPECT_THAT(run.remarks, Contains(HasSubstr("not recorded from 0.57 h to 0.92 h: z.duty, which a fit")));
  for (std::size_t half : {0U, 1U})
    for (double const minute : {33.0, 40.0, 50.0, 57.0}) {
      auto const& course = *run.alternatives[half].course;
      bool const other = minute == (half == 0 ? 40.0 : 50.0);
      EXPECT_NEAR(value_at(course, "z.feed", 60.0 * minute), 0.1, 1e-9) << minute;
      EXPECT_EQ(value_at(course, "z.duty", 60.0 * minute), other ? 0.0 : 1.0) << minute;
      EXPECT_EQ(value_at(course, "z.speed", 60.0 * minute) == 0.0, other) << minute;
    }
  EXPECT_EQ(run.time.size(), dataset.time_s.size() - 35);
}

/// A mean speed that was recorded is that of an axis that moves for a part of the time only.
TEST(MeasuredRun, TheFeedOfAScrewIsThatWhileItMoves) {
  auto dataset = simulated();
  keep_inputs(dataset, {"spindle.speed", "ambient.temperature", "z.speed", "z.duty"});
  double const feed = value_at(*measured_run(dataset, machine(), "all the time").course, "z.feed", 2400.0);
  for (auto const* name : {"z.speed", "z.duty"}) channel(dataset.inputs, name).values *= 0.5;
  EXPECT_GT(feed, 0.0);
  EXPECT_NEAR(value_at(*measured_run(dataset, machine(), "half").course, "z.feed", 2400.0), feed, 1e-12);
}

TEST(MeasuredRun, ALoggerThatWasOffBecomesOneRemarkOnInputsAndOneOnReadings) {
  auto dataset = tests::without_rows(simulated(), 54.0 * 60.0, 74.0 * 60.0);
  keep_inputs(dataset, {"spindle.speed", "ambient.temperature"});
  auto const run = measured_run(dataset, machine(), "gap");
  std::vector<std::string> told;
  for (auto const& remark : run.remarks)
    if (remark.find("0.90 h") != std::string::npos) told.push_back(remark);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_THAT(told[0], testing::StartsWith(fmt::format(
                           "{} channels have no reading for 0.33 h from 0.90 h on, where the data have no rows: T1, T2",
                           run.channels.size())));
  EXPECT_EQ(told[1],
            "not recorded from 0.90 h to 1.23 h: spindle.speed, which a fit to this run estimates; without a fit the "
            "last value is held, and readings after the gap depend on it (until 15 min after it they are left out); "
            "ambient.temperature, taken from the rows beside the gap");
}

TEST(MeasuredRun, ReadingsInAGapOfTheSpeedAndSoonAfterItAreLeftOut) {
  auto dataset = simulated();
  channel(dataset.inputs, "spindle.speed").values.segment(55, 20).setConstant(std::nan(""));
  auto const run = measured_run(dataset, machine(), "gap");
  EXPECT_EQ(run.time.size(), dataset.time_s.size() - 35);
  EXPECT_EQ(run.time[54], 54.0 * 60.0);
  EXPECT_EQ(run.time[55], (75.0 + 15.0) * 60.0);
  for (auto const& one : run.channels) EXPECT_EQ(one.values.size(), run.time.size()) << one.name;
}

TEST(MeasuredRun, AFeedWithoutItsDutyIsSaidToBeMotionAllTheTime) {
  Machine const vmc850 = Machine::read(machine_file("vmc850"));
  MeasuredData data;
  data.time = Eigen::VectorXd::LinSpaced(181, 0.0, 3 * 3600.0);
  data.readings = {{"S1", "degC", "", data.time / 3600.0}};
  data.inputs = {{"z.feed", "m/s", {0.0}, {0.2}}, {"ambient.temperature", "K", {0.0}, {293.0}}};
  EXPECT_THAT(measured_run(data, vmc850, "feed").remarks, Contains(HasSubstr("axis z moves whenever it has a feed")));
  data.inputs.push_back({"z.duty", "1", {0.0}, {0.8}});
  EXPECT_THAT(measured_run(data, vmc850, "duty").remarks,
              testing::Not(Contains(HasSubstr("axis z moves whenever it has a feed"))));
}

/// A feed every minute and a duty that is one number for all are in different tables.
TEST(MeasuredRun, TheDutyCountsWhateverItsRows) {
  Machine const vmc850 = Machine::read(machine_file("vmc850"));
  MeasuredData data;
  data.time = Eigen::VectorXd::LinSpaced(181, 0.0, 3 * 3600.0);
  data.readings = {{"S1", "degC", "", data.time / 3600.0}};
  data.inputs = {{"z.feed", "m/s", {0.0, 60.0, 3600.0, 7200.0, 10800.0}, {0.2, 0.2, 0.1, 0.2, 0.1}},
                 {"z.duty", "1", {0.0}, {0.5}},
                 {"ambient.temperature", "K", {0.0}, {293.0}}};
  auto const run = measured_run(data, vmc850, "duty");
  std::vector<double> values(run.course->channels().size());
  run.course->evaluate(90.0, values);
  auto const at = [&](std::string const& name) { return values[std::size_t(run.course->index_of(name))]; };
  EXPECT_NEAR(at("z.speed"), 0.5 * at("z.moving_speed"), 1e-12);
  EXPECT_GT(at("z.speed"), 0.0);
  data.inputs[1].values = {50.0};
  EXPECT_THAT(refusal([&] { (void)measured_run(data, vmc850, "percent"); }),
              HasSubstr("input 'z.duty' reaches 50, and the most is 1; is its unit right?"));
}

/// A programme that is written down where it changes has no gap, nor has what never changes.
TEST(MeasuredRun, WhatIsRecordedWhereItChangesHasNoGap) {
  MeasuredData data;
  data.time = Eigen::VectorXd::LinSpaced(181, 0.0, 3 * 3600.0);
  data.readings = {{"T1", "degC", "", data.time / 3600.0}};
  data.inputs = {{"spindle.speed", "rad/s", {0.0, 1800.0, 9000.0}, {100.0, 0.0, 200.0}},
                 {"ambient.temperature", "K", {0.0}, {293.0}},
                 {"ambient.gradient", "K/m", {0.0}, {0.0}}};
  auto const run = measured_run(std::move(data), machine(), "programme");
  EXPECT_TRUE(run.alternatives.empty());
  EXPECT_THAT(run.remarks, testing::Not(Contains(HasSubstr("not recorded"))));
}

/// Two hours at constant inputs, and a clock.
MeasuredRun with_clock(std::vector<double> times, std::vector<double> clock) {
  MeasuredData data;
  data.time = Eigen::VectorXd::LinSpaced(121, 0.0, 2 * 3600.0);
  data.readings = {{"T1", "degC", "", 22.0 + data.time.array() / 3600.0}};
  data.inputs = {{"spindle.speed", "rad/s", {0.0}, {100.0}},
                 {"ambient.temperature", "K", {0.0}, {293.0}},
                 {"time_of_day", "s", std::move(times), std::move(clock)}};
  return measured_run(std::move(data), machine(), "clock");
}

TEST(MeasuredRun, StartsWhenItsClockSays) {
  constexpr double h = 3600.0;
  auto const start = [](MeasuredRun const& run) { return value_at(*run.course, "time_of_day", 0.0) / 3600.0; };
  EXPECT_DOUBLE_EQ(start(with_clock({0.0, h, 2 * h}, {10 * h, 11 * h, 12 * h})), 10.0);
  EXPECT_DOUBLE_EQ(start(with_clock({-6 * h, 0.0, 2 * h}, {8 * h, 14 * h, 16 * h})), 14.0);      // recorded from before
  EXPECT_DOUBLE_EQ(start(with_clock({-6 * h, 0.0, 2 * h}, {22 * h, 4 * h, 6 * h})), 4.0);        // past midnight
  EXPECT_DOUBLE_EQ(start(with_clock({0.0, h, 2 * h}, {std::nan(""), 0.5 * h, 1.5 * h})), 23.5);  // an empty cell
  EXPECT_DOUBLE_EQ(start(with_clock({0.0, h}, {std::nan(""), std::nan("")})), 8.0);  // the experiment's default
}

/// Their tables have other units of time.
TEST(MeasuredRun, ChangesOfTwoInputsARoundingErrorApartAreOne) {
  MeasuredData data;
  data.time = Eigen::VectorXd::LinSpaced(101, 0.0, 600.0);
  data.readings = {{"T1", "degC", "", 22.0 + data.time.array() / 3600.0}};
  data.inputs = {
      {"spindle.speed", "rad/s", {}, {}}, {"coolant.on", "1", {}, {}}, {"ambient.temperature", "K", {0.0}, {293.0}}};
  for (int i = 0; i <= 100; ++i) {
    data.inputs[0].times.push_back(i / 10.0 * 60.0);
    data.inputs[0].values.push_back(i < 41 ? 0.0 : 100.0);
    data.inputs[1].times.push_back(6.0 * i);
    data.inputs[1].values.push_back(i < 41 ? 0.0 : 1.0);
  }
  ASSERT_LT(data.inputs[0].times[41], data.inputs[1].times[41]);
  auto const run = measured_run(std::move(data), machine(), "two tables");
  ASSERT_EQ(run.changes.size(), 1U);
  EXPECT_EQ(run.changes[0].time, 246.0);
  EXPECT_EQ(run.changes[0].size, 2.0);
  EXPECT_EQ(run.course->next_jump(0.0), 246.0);
}

TEST(MeasuredRun, MissingInputsAreNamed) {
  auto dataset = simulated();
  keep_inputs(dataset, {"z.feed"});
  EXPECT_THAT(refusal([&] { (void)measured_run(dataset, machine(), "x"); }),
              HasSubstr("the machine 'v450' needs inputs that the data lack: ambient.temperature, spindle.speed; the "
                        "data have z.feed"));
}

/// A name that the machine's file gives, or that the data give.
TEST(MeasuredRun, MisspeltInputsAreOfferedTheNearest) {
  auto document = read_toml(machine_file("v450"));
  set_parameter(document, "motor_loss.stator.while_on", "machin.on");
  EXPECT_THAT(refusal([&] { (void)measured_run(simulated(), Machine::build(document), "x"); }),
              HasSubstr("'machin.on': did you mean 'machine.on'?"));
  auto dataset = simulated();
  channel(dataset.inputs, "spindle.speed").name = "spindel.speed";
  EXPECT_THAT(refusal([&] { (void)measured_run(dataset, machine(), "x"); }),
              HasSubstr("'spindle.speed': is it 'spindel.speed'?"));
}

TEST(MeasuredRun, RefusesDataOfAnotherMachine) {
  auto dataset = simulated();
  for (auto* group : {&dataset.readings, &dataset.displacements})
    for (auto& c : *group) c.name = "other_" + c.name;
  EXPECT_THAT(refusal([&] { (void)measured_run(dataset, machine(), "x"); }),
              HasSubstr("no channel of the data is one of the machine 'v450'"));
}

TEST(MeasuredRun, RefusesUnitsThatContradict) {
  auto dataset = simulated();
  dataset.readings[0].unit = "um";
  EXPECT_THAT(refusal([&] { (void)measured_run(dataset, machine(), "x"); }), HasSubstr("is in um"));
  dataset = simulated();
  dataset.readings[0].values.array() += 273.15;
  EXPECT_THAT(refusal([&] { (void)measured_run(dataset, machine(), "x"); }), HasSubstr("is its unit right?"));
  dataset = simulated();
  channel(dataset.inputs, "spindle.speed").unit = "rad/s";
  EXPECT_THAT(refusal([&] { (void)measured_run(dataset, machine(), "x"); }),
              HasSubstr("and the machine's maximum is 6000 rpm; is its unit right?"));
  dataset = simulated();
  channel(dataset.inputs, "ambient.temperature").unit = "um";
  EXPECT_THAT(refusal([&] { (void)measured_run(dataset, machine(), "x"); }), HasSubstr("ambient.temperature"));
}

TEST(MeasuredRun, RefusesWhatIsTooShortOrDead) {
  auto dataset = simulated();
  output::resize_rows(dataset, 5);
  EXPECT_THAT(refusal([&] { (void)measured_run(dataset, machine(), "x"); }), HasSubstr("5 rows, too few"));
  dataset = simulated();
  for (auto* group : {&dataset.readings, &dataset.displacements})
    for (auto& c : *group) c.values.setConstant(20.0);
  EXPECT_THAT(refusal([&] { (void)measured_run(dataset, machine(), "x"); }), HasSubstr("every sensor is dead"));
}

}  // namespace
}  // namespace thermotwin::twin
