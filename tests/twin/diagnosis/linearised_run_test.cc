#include "twin/diagnosis/linearised_run.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

#include "tests/thermal/function_course.h"
#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "thermal/integrate.h"
#include "twin/diagnosis/channel_reading.h"
#include "twin/diagnosis/prediction.h"
#include "twin/diagnosis/warmer_air.h"
#include "twin/sensitivity.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using tests::v450;

Machine const& machine() {
  static Machine const v450 = Machine::build(tests::v450());
  return v450;
}

/// A run that is read without noise.
output::Dataset true_run(Machine const& machine, scenarios::Experiment const& experiment) {
  auto dataset = run(machine, experiment, {}).dataset;
  dataset.readings = dataset.truth_readings;
  dataset.displacements = dataset.truth_displacements;
  return dataset;
}

output::Dataset const& dataset() {
  static output::Dataset const truth = true_run(machine(), tests::two_speeds());
  return truth;
}

/// Taken at its word: the speed changes where its record does.
MeasuredRun const& measured() {
  static MeasuredRun const run = [] {
    auto run = measured_run(dataset(), machine(), "truth");
    run.changes.clear();
    return run;
  }();
  return run;
}

TEST(Predict, ALagShowsTheSameHoweverSeldomItIsRead) {
  auto document = v450();
  for (auto const* path : {"temperature_sensor.T1.lag", "temperature_sensor.T4.lag"})
    set_parameter(document, path, "90 s");
  auto const slow = Machine::build(document);
  auto const seen_every = [&](double sampling) {
    auto experiment = tests::two_speeds();
    experiment.sampling = sampling;
    return predict(slow, measured_run(run(machine(), experiment, {}).dataset, slow, "two speeds"));
  };
  MatrixXd const often = seen_every(20.0), seldom = seen_every(600.0);
  for (Index r = 0; r < seldom.rows(); ++r)
    EXPECT_LT((seldom.row(r) - often.row(30 * r)).cwiseAbs().maxCoeff(), 0.01) << "row " << r;
}

char const* const numbers[] = {"bearing.front.grease_factor", "joint.front_seat.coefficient", "film.motor.coefficient",
                               "lump.head_front.mass", "motor_loss.stator.eddy"};

std::vector<thermal::NetworkDerivative> derivatives() {
  std::vector<thermal::NetworkDerivative> result;
  for (auto const* path : numbers) result.push_back(differentiate(v450(), path).network);
  return result;
}

/// Forward sensitivities of CVODES at every sample, seen by the channels and averaged to the rows.
MatrixXd forward(BinnedRun const& binned) {
  auto const& run = *binned.run;
  thermal::IntegrationOptions options;
  options.relative_tolerance = options.absolute_tolerance = 1e-8;
  options.parameters = derivatives();
  auto const rows = binned.time.size();
  auto const channels = Index(run.channels.size());
  std::vector<NodeWeights const*> weights;
  for (auto const& sensor : machine().sensors) weights.push_back(&sensor.weights);
  for (auto const& displacement : machine().displacements) weights.push_back(&displacement.weights);
  EXPECT_EQ(Index(weights.size()), channels);
  std::vector<int> row_of;
  for (Index r = 0; r < rows; ++r) row_of.insert(row_of.end(), std::size_t(binned.samples(r, 0)), int(r));
  MatrixXd result = MatrixXd::Zero(rows * channels, Index(options.parameters.size()));
  std::vector<double> const times(run.time.begin(), run.time.end());
  std::size_t sample = 0;
  thermal::integrate(machine().network(), *run.course, initial_temperatures(machine(), {}, *run.course), times, options,
                     [&](thermal::Sample const& at) {
                       int const row = row_of[sample++];
                       for (Index c = 0; c < channels; ++c)
                         for (Index k = 0; k < result.cols(); ++k)
                           for (auto const& [node, weight] : *weights[std::size_t(c)])
                             result(c * rows + row, k) +=
                                 weight * (*at.sensitivities)(node, k) / binned.samples(row, c);
                     });
  return result;
}

MatrixXd response(BinnedRun const& binned) {
  auto const all = derivatives();
  std::vector<thermal::NetworkDerivative const*> pointers;
  for (auto const& derivative : all) pointers.push_back(&derivative);
  return LinearisedRun(machine(), binned).response(thermal::ParameterColumns(machine().network(), pointers));
}

/// 1 for rows that lie this long behind the last jump, else 0.
Eigen::VectorXd calm_rows(BinnedRun const& binned, double wait) {
  Eigen::VectorXd calm(binned.time.size());
  for (Index r = 0; r < calm.size(); ++r) {
    double jump = 0.0;
    for (double t = 0.0; t < binned.time[r]; t = binned.run->course->next_jump(t)) jump = t;
    calm[r] = binned.time[r] - jump >= wait ? 1.0 : 0.0;
  }
  EXPECT_GT(calm.sum(), 0.0);
  return calm;
}

/// Largest difference of a channel's response to each number, over the largest response of a channel of its kind:
/// sensors, displacements.
std::vector<double> differences(BinnedRun const& binned, double wait = 0.0) {
  MatrixXd const expected = forward(binned), actual = response(binned);
  auto const rows = binned.time.size();
  auto const calm = calm_rows(binned, wait);
  std::vector<double> worst(std::size(numbers));
  for (std::size_t k = 0; k < worst.size(); ++k)
    for (bool const displacement : {false, true}) {
      double largest = 0.0, error = 0.0;
      for (std::size_t c = 0; c < binned.run->channels.size(); ++c) {
        if (binned.run->channels[c].displacement != displacement) continue;
        Eigen::VectorXd const whole = expected.col(Index(k)).segment(Index(c) * rows, rows);
        Eigen::VectorXd const missed = whole - actual.col(Index(k)).segment(Index(c) * rows, rows);
        largest = std::max(largest, whole.cwiseAbs().maxCoeff());
        error = std::max(error, missed.cwiseProduct(calm).cwiseAbs().maxCoeff());
      }
      EXPECT_GT(largest, 0.0) << numbers[k];
      worst[k] = std::max(worst[k], error / largest);
    }
  return worst;
}

/// A seat that conducts 40 W/K is felt in the first minutes of a speed only, which steps of minutes blur.
TEST(LinearisedRun, RespondsAsForwardSensitivities) {
  auto const worst = differences(bin(measured(), 300.0));
  for (std::size_t k = 0; k < worst.size(); ++k)
    EXPECT_LT(worst[k], numbers[k] == std::string("joint.front_seat.coefficient") ? 2.5e-2 : 1e-2) << numbers[k];
}

/// A quarter of the steps: a sixteenth of the error, down to what the tolerance of the course itself leaves.
TEST(LinearisedRun, IsOfSecondOrderWhereTheCourseIsSmooth) {
  auto const coarse = differences(bin(measured(), 600.0, 40.0), 1800.0);
  auto const fine = differences(bin(measured(), 150.0, 10.0), 1800.0);
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    EXPECT_LT(fine[k], std::max(coarse[k] / 5.0, 5e-4)) << numbers[k];
  }
}

/// Of a warm start: every node one kelvin warmer, against two runs.
TEST(LinearisedRun, RespondsToAWarmStart) {
  auto run = measured();
  double const start = dataset().truth_readings.back().values[0] + 273.15 + 3.0;
  run.initial_temperature = start;
  auto const binned = bin(run, 60.0);
  auto warm = run, cold = run;
  warm.initial_temperature = start + 0.5;
  cold.initial_temperature = start - 0.5;
  auto const shown = [&](MeasuredRun const& other) {
    auto moved = binned;
    moved.run = &other;
    return LinearisedRun(machine(), moved).prediction();
  };
  MatrixXd const expected = shown(warm) - shown(cold);
  thermal::ParameterColumns const none(machine().network(), {});
  MatrixXd const actual =
      LinearisedRun(machine(), binned)
          .response([](auto&, double, auto&, auto&, thermal::NodeByParameter& forcing) { forcing.setZero(); },
                    MatrixXd::Ones(machine().network().nodes(), 1));
  auto const rows = binned.time.size();
  for (std::size_t c = 0; c < run.channels.size(); ++c) {
    Eigen::VectorXd const difference = expected.col(Index(c)) - actual.col(0).segment(Index(c) * rows, rows);
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), run.channels[c].displacement ? 3e-8 : 1e-2) << run.channels[c].name;
  }
}

/// Largest difference between prediction and truth: of the sensors [K], of the displacements [m].
std::pair<double, double> missed(double interval, double wait) {
  auto const binned = bin(measured(), interval);
  auto const calm = calm_rows(binned, wait);
  MatrixXd const difference = LinearisedRun(machine(), binned).prediction() - binned.values;
  std::pair<double, double> worst{0.0, 0.0};
  for (std::size_t c = 0; c < measured().channels.size(); ++c) {
    double& own = measured().channels[c].displacement ? worst.second : worst.first;
    own = std::max(own, difference.col(Index(c)).cwiseProduct(calm).cwiseAbs().maxCoeff());
  }
  return worst;
}

TEST(LinearisedRun, PredictsTheRun) {
  auto const [kelvin, metres] = missed(60.0, 0.0);
  EXPECT_LT(kelvin, 5e-3);
  EXPECT_LT(metres, 2e-8);
}

/// No modes can stand for a thermostat; where it switches between two rows, a cubic rounds that off.
TEST(LinearisedRun, PredictsAMachineWithAThermostat) {
  Machine const cooled = Machine::build(tests::with_table(v450(), R"(
[[chiller]]
name = "motor"
cools = "motor"
power = "300 W"
temperature = "24 degC"
while_on = "machine.on"
hysteresis = "1 K")"));
  auto measured = measured_run(true_run(cooled, tests::two_speeds()), cooled, "cooled");
  measured.changes.clear();
  auto const binned = bin(measured, 60.0);
  MatrixXd const missed = LinearisedRun(cooled, binned).prediction() - binned.values;
  for (std::size_t c = 0; c < measured.channels.size(); ++c)
    EXPECT_LT(missed.col(Index(c)).cwiseAbs().maxCoeff(), measured.channels[c].displacement ? 1e-7 : 0.25)
        << measured.channels[c].name;
  MatrixXd const warmer = LinearisedRun(machine(), binned).prediction() - binned.values;
  EXPECT_GT(warmer.maxCoeff(), 3.0);
}

/// Three positions of the nut, of a screw that is supported and of one that is held: up to 60 um.
TEST(LinearisedRun, PredictsErrorsOfPositionAlongAScrew) {
  Machine const vmc850 = Machine::read(std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "twin/machines/vmc850.toml");
  auto const experiment = tests::experiment(R"(
    duration = "2 h"
    ambient.mean = "22 degC"
    [[axes]]
    axis = "z"
    blocks = [{duration = "80 min", feed = "8000 mm/min"}, {duration = "40 min", feed = "0 mm/min"}])");
  auto measured = measured_run(true_run(vmc850, experiment), vmc850, "feed");
  measured.changes.clear();
  auto const binned = bin(measured, 60.0);
  MatrixXd const predicted = LinearisedRun(vmc850, binned).prediction();
  double largest = 0.0;
  for (std::size_t c = 0, found = 0; c < measured.channels.size(); ++c) {
    if (!measured.channels[c].name.starts_with("E_P")) continue;
    VectorXd const missed = predicted.col(Index(c)) - binned.values.col(Index(c));
    EXPECT_LT(missed.cwiseAbs().maxCoeff(), 5e-8) << measured.channels[c].name;
    largest = std::max(largest, binned.values.col(Index(c)).maxCoeff());
    EXPECT_LT(++found, 7u);
  }
  EXPECT_GT(largest, 2e-5);
}

/// Rows of minutes: the mean over their samples, from the ends of few steps, of rises by more than ten kelvin.
TEST(LinearisedRun, PredictsTheMeanOfMinutes) {
  auto const [kelvin, metres] = missed(300.0, 0.0);
  EXPECT_LT(kelvin, 0.01);
  EXPECT_LT(metres, 2e-8);
  auto const [calm_kelvin, calm_metres] = missed(300.0, 1800.0);
  EXPECT_LT(calm_kelvin, 1e-3);
  EXPECT_LT(calm_metres, 2e-9);
}

/// A sensor that lags by next to nothing shows what one without a lag does, after every jump of the speed, too.
TEST(LinearisedRun, ForgetsALagThatGoesToNothing) {
  auto const with_lag = [](double lag) {
    Machine machine = Machine::build(v450());
    for (auto& sensor : machine.sensors) sensor.description.lag = lag;
    return machine;
  };
  auto const binned = bin(measured(), 300.0);
  LinearisedRun const twin(machine(), binned);
  MatrixXd const prompt = twin.prediction_of(with_lag(0.0));
  for (double const lag : {0.01, 1.0}) {
    MatrixXd const difference = twin.prediction_of(with_lag(lag)) - prompt;
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 0.05 * lag) << lag;  // nothing warms faster over minutes
  }
}

/// Sensors that lag, hang in the air or drift, as the prediction of the whole run says (prediction.h).
TEST(LinearisedRun, ReadsThroughTheSensorsOfAnotherMachine) {
  auto document = v450();
  set_parameter(document, "temperature_sensor.T1.lag", "150 s");
  set_parameter(document, "temperature_sensor.T2.stem_loss", "0.1");
  set_parameter(document, "temperature_sensor.T6.offset", "0.4 K");
  set_parameter(document, "temperature_sensor.T7.drift", "0.1 K/h");
  set_parameter(document, "displacement.E_Z.segment.1.growth_factor", "1.3");
  Machine const other = Machine::build(document);
  auto const binned = bin(measured(), 60.0);
  MatrixXd const expected = predict(other, measured());
  MatrixXd const shown = LinearisedRun(machine(), binned).prediction_of(other);
  MatrixXd const plain = LinearisedRun(machine(), binned).prediction();
  for (std::size_t c = 0; c < measured().channels.size(); ++c) {
    auto const& channel = measured().channels[c];
    Eigen::VectorXd const difference = shown.col(Index(c)) - expected.col(Index(c)).head(shown.rows());
    EXPECT_LT(difference.head(shown.rows() - 1).cwiseAbs().maxCoeff(), channel.displacement ? 2e-8 : 2e-2)
        << channel.name;
    bool const differs = channel.name == "T1" || channel.name == "T2" || channel.name == "T6" || channel.name == "T7" ||
                         channel.name == "E_Z";
    EXPECT_EQ((shown - plain).col(Index(c)).cwiseAbs().maxCoeff() > 0.0, differs) << channel.name;
  }
}

Index column_of(std::string const& name) {
  auto const& channels = measured().channels;
  return std::find_if(channels.begin(), channels.end(), [&](auto const& c) { return c.name == name; }) -
         channels.begin();
}

/// What an instrument adds is not late.
TEST(LinearisedRun, HoldsNoDriftBackByALag) {
  auto const with_drift = [](std::string const& drift) {
    auto document = v450();
    set_parameter(document, "temperature_sensor.T1.lag", "10 min");
    set_parameter(document, "temperature_sensor.T1.drift", drift);
    return Machine::build(document);
  };
  auto const binned = bin(measured(), 300.0);
  LinearisedRun const twin(machine(), binned);
  MatrixXd const added = twin.prediction_of(with_drift("0.3 K/h")) - twin.prediction_of(with_drift("0 K/h"));
  VectorXd const drifted = 0.3 / 3600.0 * binned.time;
  EXPECT_LT((added.col(column_of("T1")) - drifted).cwiseAbs().maxCoeff(), 1e-9);
}

/// The run in a room whose air comes to stratify, by 1 K/m in an hour.
MeasuredRun stratifying() {
  auto run = measured();
  auto const still = run.course;
  std::vector<std::string> names;
  for (auto const& channel : still->channels()) names.push_back(channel.name);
  std::vector<double> jumps;
  for (double t = still->next_jump(0.0); std::isfinite(t); t = still->next_jump(t)) jumps.push_back(t);
  auto const gradient = std::size_t(still->index_of("ambient.gradient"));
  run.course = std::make_shared<thermal::FunctionCourse>(
      names,
      [=](double t, std::span<double> values) {
        still->evaluate(t, values);
        values[gradient] += t / 3600.0;
      },
      jumps);
  return run;
}

/// A probe's fixture follows the air 1 m up, as in a simulated run (history.cc) and as the prediction of the whole run
/// says.
TEST(LinearisedRun, MeetsTheAirNearTheTool) {
  auto const run = stratifying();
  Machine const other = Machine::build(
      tests::with_table(v450(), "[[probe_drift]]\nname = \"fixture\"\ndisplacement = \"E_Z\"\nper_air = \"1 um/K\"\n"));
  auto const binned = bin(run, 60.0);
  auto const rows = binned.time.size() - 1, column = column_of("E_Z");  // the last row has two samples
  LinearisedRun const twin(machine(), binned);
  VectorXd const followed = (twin.prediction_of(other) - twin.prediction()).col(column).head(rows);
  VectorXd const predicted = (predict(other, run) - predict(machine(), run)).col(column).head(rows);
  std::vector<double> start(run.course->channels().size()), now(start.size());
  auto const floor = std::size_t(run.course->index_of("ambient.floor_temperature"));
  auto const gradient = std::size_t(run.course->index_of("ambient.gradient"));
  run.course->evaluate(0.0, start);
  for (Index r = 0; r < rows; ++r) {
    run.course->evaluate(binned.time[r], now);
    double const warmer = now[floor] - start[floor] + now[gradient] - start[gradient];
    EXPECT_NEAR(followed[r], 1e-6 * warmer, 1e-9) << r;
    EXPECT_NEAR(predicted[r], 1e-6 * warmer, 1e-9) << r;
  }
}

/// 80 W into the motor, 0.4 m² between two bodies: what each body receives of it, while the spindle turns and stands.
TEST(LinearisedRun, TellsWhichBodiesReceiveMoreHeatThanInAnotherMachine) {
  auto const with = [](double share) {
    return Machine::build(tests::with_table(
        v450(), fmt::format("[[heat]]\nname = \"h\"\nat = \"motor\"\npower = \"{} W\"\n"
                            "[[radiation]]\nname = \"r\"\non = \"front_ring\"\nto = \"bed\"\narea = \"{} m^2\"\n",
                            80.0 * share, 0.4 * share)));
  };
  BinnedRun const binned = bin(measured(), 300.0);
  Machine const machine = with(1.0);
  LinearisedRun const twin(machine, binned);
  auto const more = twin.more_heat_than(with(1e-9));
  EXPECT_NEAR(more.at("motor").minCoeff(), 80.0, 1e-6);
  EXPECT_NEAR(more.at("motor").maxCoeff(), 80.0, 1e-6);
  EXPECT_NEAR(twin.mean(more.at("motor")).moving, 80.0, 1e-6);
  EXPECT_NEAR(twin.mean(more.at("motor")).standing, 80.0, 1e-6);
  EXPECT_LT(twin.mean(more.at("front_ring")).moving, -1.0);
  EXPECT_NEAR((more.at("bed") + more.at("front_ring")).cwiseAbs().maxCoeff(), 0.0, 1e-9);
  EXPECT_NEAR(more.at("column_front").cwiseAbs().maxCoeff(), 0.0, 1e-9);
}

/// A millikelvin of the air at six in the morning, by the machine that has it.
TEST(LinearisedRun, TellsWhatEveryBodyTakesUpPerKelvinOfTheAir) {
  BinnedRun const binned = bin(measured(), 300.0);
  Machine const warmer = Machine::build(tests::with_table(v450(), R"(
    [[ambient_cycle]]
    name = "more"
    sine = "1 mK")"));
  auto const per_kelvin = LinearisedRun(machine(), binned).more_heat_per_unit(warmer_air(machine().network()));
  auto const more = LinearisedRun(warmer, binned).more_heat_than(machine());
  double const eight = 8 * 3600.0;
  for (std::size_t s = 0; s < binned.steps.size(); ++s) {
    double const rise = 1e-3 * std::sin(2.0 * std::numbers::pi * (eight + binned.steps[s].begin) / 86400.0);
    for (auto const& [body, heat] : per_kelvin)
      EXPECT_NEAR(heat[Index(s)] * rise, more.at(body)[Index(s)], 3e-6 + 2e-3 * std::abs(more.at(body)[Index(s)]))
          << body << " at " << binned.steps[s].begin << " s";
  }
  EXPECT_GT(per_kelvin.at("bed").minCoeff(), 1.0);
  EXPECT_EQ(per_kelvin.at("front_ring").cwiseAbs().maxCoeff(), 0.0);  // within the spindle
}

/// Blocks that end 20 s earlier than the record tells, by a run of the machine.
TEST(LinearisedRun, KnowsWhatASpeedDoesThatChangedBeforeItsRecord) {
  auto const early = tests::two_speeds("4780 s", "50 min", "3020 s", "1 h");
  auto truth = true_run(machine(), early);
  truth.inputs = dataset().inputs;
  auto as_recorded = measured();
  as_recorded.changes = {{4800.0, 60.0, 1.0}, {7800.0, 60.0, 1.0}};
  auto hidden = measured_run(truth, machine(), "early");
  hidden.changes = as_recorded.changes;
  auto const binned = bin(as_recorded, 300.0), shown = bin(hidden, 300.0);
  LinearisedRun const twin(machine(), binned);
  MatrixXd const earlier = twin.response_to_earlier({4800.0, 7800.0});
  VectorXd const expected = (shown.values - twin.prediction()).reshaped();
  VectorXd const foreseen = 20.0 * earlier.rowwise().sum();
  MatrixXd const all_earlier = twin.response_to_all_earlier();
  MatrixXd const each = twin.response_to_earlier({4800.0, 7800.0, 10800.0});
  EXPECT_LT((all_earlier - each.rowwise().sum()).norm(), 1e-9 * each.norm());
  auto const rows = binned.time.size();
  for (std::size_t c = 0; c < measured().channels.size(); ++c) {
    auto const of = [&](VectorXd const& all) { return all.segment(Index(c) * rows, rows); };
    double const scale = measured().channels[c].displacement ? 1e-6 : 1.0;
    EXPECT_LT((of(foreseen) - of(expected)).norm(), 0.1 * of(expected).norm() + 0.02 * scale)
        << measured().channels[c].name;
  }
  EXPECT_GT(expected.cwiseAbs().maxCoeff(), 0.1);
}

}  // namespace
}  // namespace thermotwin::twin
