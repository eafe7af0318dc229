#include "twin/diagnosis/estimation.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/instruments/first_order_lag.h"
#include "twin/sensitivity.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using tests::v450;

constexpr double kelvin = 0.03, metres = 0.1e-6;

struct Change {
  char const* path;
  double factor;
};
constexpr Change changes[] = {
    {"bearing.front.grease_factor", 1.2}, {"film.motor.coefficient", 0.8}, {"bearing.rear.grease_factor", 1.2}};

/// The machine as it is: three numbers differ by a fifth, one sensor lags, one is off.
Value truth() {
  Value document = v450();
  for (auto const& [path, factor] : changes) {
    auto const number = find_number(document, path);
    set_number(document, number, factor * number.value);
  }
  set_parameter(document, "temperature_sensor.T4.lag", "60 s");
  set_parameter(document, "temperature_sensor.T6.offset", "0.4 K");
  return document;
}

Index index_of(Estimation const& estimation, std::string const& name) {
  auto const& all = estimation.unknowns();
  auto const it = std::find_if(all.begin(), all.end(), [&](auto const& u) { return u.name == name; });
  EXPECT_NE(it, all.end()) << name;
  return Index(it - all.begin());
}

/// Its twin, which knows the numbers of the file, fitted to a noisy run of it.
struct Question {
  Question() : run(tests::measured(truth(), tests::two_speeds())) {
    tests::add_noise(run, kelvin, metres, 5);
    data.push_back(bin(run, 120.0));
    estimation.emplace(v450(), data, tests::channels_of(run), tests::noise_of(run, kelvin, metres));
    fit = estimation->fit(estimation->prior_mean());
  }
  [[nodiscard]] Index index(std::string const& name) const { return index_of(*estimation, name); }
  [[nodiscard]] double error(std::string const& name) const {
    Index const i = index(name);
    return std::sqrt(fit.covariance(i, i));
  }

  MeasuredRun run;
  std::vector<BinnedRun> data;
  std::optional<Estimation> estimation;
  Fit fit;
};

Question const& question() {
  static Question const once;
  return once;
}

TEST(Estimation, FindsTheNumbersThatDiffer) {
  auto const& q = question();
  EXPECT_TRUE(q.fit.converged);
  for (auto const& [path, factor] : changes) {
    double const estimate = q.fit.x[q.index(path)], error = q.error(path);
    EXPECT_NEAR(estimate, std::log(factor), 3.0 * error) << path;
    EXPECT_LT(error, 0.65 * q.estimation->unknowns()[std::size_t(q.index(path))].deviation) << path;
  }
}

TEST(Estimation, FindsOffsetAndLag) {
  auto const& q = question();
  for (auto const& [name, value, known] : {std::tuple{"offset of T6", 0.4, 0.2},
                                           {"offset of T8", 0.0, 0.2},
                                           {"lag of T4", 60.0, 5.0},
                                           {"lag of T8", 30.0, 20.0}}) {
    EXPECT_NEAR(q.fit.x[q.index(name)], value, 3.0 * q.error(name)) << name;
    EXPECT_LT(q.error(name), known) << name;
  }
}

/// Probes are set to zero whenever somebody likes. With other zeros the same machine is found.
TEST(Estimation, DoesNotMindWhereAProbesZeroIs) {
  auto const& q = question();
  MeasuredRun moved = q.run;
  double by = 40e-6;
  for (auto& channel : moved.channels)
    if (channel.displacement) channel.values.array() += (by = -1.5 * by);
  std::vector<BinnedRun> const data = {bin(moved, 120.0)};
  Estimation const estimation(v450(), data, tests::channels_of(moved), tests::noise_of(moved, kelvin, metres));
  auto const fit = estimation.fit(estimation.prior_mean());
  for (auto const& [path, factor] : changes) EXPECT_NEAR(fit.x[q.index(path)], q.fit.x[q.index(path)], 1e-6) << path;
  EXPECT_NEAR(fit.cost, q.fit.cost, 1e-6 * q.fit.cost);
}

/// The others are where they were, within what the data leave open.
TEST(Estimation, LeavesTheOtherNumbersWhereTheyAre) {
  auto const& q = question();
  for (std::size_t u = 0; u < q.estimation->unknowns().size(); ++u) {
    auto const& unknown = q.estimation->unknowns()[u];
    if (unknown.kind != Unknown::Kind::number) continue;
    double expected = 0.0;
    for (auto const& [path, factor] : changes)
      if (unknown.name == path) expected = std::log(factor);
    double const error = std::sqrt(q.fit.covariance(Index(u), Index(u)));
    EXPECT_LE(error, unknown.deviation * (1.0 + 1e-9)) << unknown.name;
    EXPECT_NEAR(q.fit.x[Index(u)], expected, 3.5 * error) << unknown.name;
  }
}

/// Of a law that is as good as known the data say nothing; with its whole prior the question is the same.
TEST(Estimation, LawsAreAsUncertainAsTheirShare) {
  auto const& q = question();
  auto const slope = q.index("bearing.front.viscosity_temperature");
  auto const fit = [&](double share) { return q.estimation->with_laws(share).fit(q.fit.x); };
  EXPECT_LT(std::abs(fit(1e-4).x[slope]), 1e-5);
  EXPECT_NEAR(fit(1.0).evidence, q.fit.evidence, 1e-3);
  double const deviation = q.estimation->unknowns()[std::size_t(slope)].deviation;
  EXPECT_DOUBLE_EQ(q.estimation->with_laws(0.25).unknowns()[std::size_t(slope)].deviation, 0.25 * deviation);
}

/// What is left is less than the noise, of which a part is the model's error that this twin does not have.
TEST(Estimation, LeavesNoMoreThanTheNoise) {
  auto const& q = question();
  auto const rows = q.estimation->rows();
  EXPECT_LT(q.fit.residual.head(rows).squaredNorm(), double(rows));
  EXPECT_DOUBLE_EQ(q.fit.cost, q.fit.residual.squaredNorm());
  auto const left = q.estimation->residuals_at(q.fit.x).at(0);
  for (std::size_t c = 0; c < q.run.channels.size(); ++c) {
    double const rms = std::sqrt(left.col(Index(c)).squaredNorm() / double(left.rows()));
    EXPECT_LT(rms, q.run.channels[c].displacement ? 0.2e-6 : 0.1) << q.run.channels[c].name;
  }
}

/// The Jacobian that the fit ends with, by differences of the residual: of a number, an offset, a lag.
TEST(Estimation, JacobianAgreesWithDifferences) {
  auto const& q = question();
  auto const whitened = [&](VectorXd const& x) {
    VectorXd residual = q.estimation->residuals_at(x)[0].reshaped();
    q.estimation->whiten(residual);
    return residual;
  };
  for (auto const& [name, step, tolerance] : {std::tuple{"bearing.front.grease_factor", 0.02, 0.02},
                                              {"film.motor.coefficient", 0.05, 0.02},
                                              {"joint.motor_flange.conductance", 0.05, 0.02},
                                              {"displacement.E_Z.segment.1.growth_factor", 0.05, 1e-3},
                                              {"offset of T6", 0.1, 1e-9},
                                              {"zero of E_Z, run 1", 1e-6, 1e-9},
                                              {"lag of T4", 2.0, 0.05},
                                              {"warm start of run 1", 0.1, 1e-9},
                                              {"air in run 1", 0.1, 1e-9}}) {
    VectorXd plus = q.fit.x, minus = q.fit.x;
    plus[q.index(name)] += step;
    minus[q.index(name)] -= step;
    VectorXd const expected = (whitened(plus) - whitened(minus)) / (2.0 * step);
    VectorXd const actual = q.fit.jacobian.column(q.index(name));
    EXPECT_GT(expected.norm(), 0.0) << name;
    EXPECT_LT((actual - expected).norm(), tolerance * expected.norm()) << name;
  }
}

/// 30 % more of a film in series with another conductance is not 30 % more of what both conduct, and less the more it
/// is.
TEST(Estimation, JacobianOfAJointInSeriesIsThatOfWhereTheFitIs) {
  Value const g200 = read_toml(machine_file("g200"));
  auto const run = tests::measured(g200, tests::experiment(R"(
    duration = "3 h"
    [spindle]
    blocks = [{duration = "3 h", speed = "3000 rpm"}])"));
  std::vector<BinnedRun> const data = {bin(run, 300.0)};
  Estimation const estimation(g200, data, tests::channels_of(run), tests::noise_of(run, kelvin, metres));
  auto const& unknowns = estimation.unknowns();
  Index const seat = std::find_if(unknowns.begin(), unknowns.end(),
                                  [](auto const& u) { return u.name == "joint.front_seat.coefficient"; }) -
                     unknowns.begin();
  ASSERT_LT(seat, Index(unknowns.size()));
  VectorXd x = estimation.prior_mean();
  x[seat] = 0.4;
  Fit const fit = estimation.fit(x, 0);
  auto const whitened = [&](double step) {
    VectorXd there = fit.x;
    there[seat] += step;
    VectorXd residual = estimation.residuals_at(there)[0].reshaped();
    estimation.whiten(residual);
    return residual;
  };
  VectorXd const expected = (whitened(0.05) - whitened(-0.05)) / 0.1;
  EXPECT_NEAR(fit.x[seat], 0.4, 1e-12);
  EXPECT_GT(expected.norm(), 0.0);
  EXPECT_LT((fit.jacobian.column(seat) - expected).norm(), 0.05 * expected.norm());
}

/// The logger is off while the spindle goes from 5000 to 2500 rpm. With what it was given there among the unknowns, the
/// numbers are found; with the last speed held, the machine is made to fit heat that it never had.
TEST(Estimation, FindsTheNumbersThoughTheSpeedChangedInAGap) {
  auto run = tests::measured(truth(), tests::two_speeds(), 3600.0, 2.0 * 3600.0);
  ASSERT_EQ(run.alternatives.size(), 6U);  // two halves of the gap, the room earlier, its walls, and its day
  tests::add_noise(run, kelvin, metres, 5);
  auto const fitted = [&] {
    std::vector<BinnedRun> const data = {bin(run, 120.0)};
    Estimation const estimation(v450(), data, tests::channels_of(run), tests::noise_of(run, kelvin, metres));
    return estimation.fit(estimation.prior_mean());
  };
  auto const& q = question();
  auto const worst = [&](Fit const& fit) {
    double deviations = 0.0;
    for (auto const& [path, factor] : changes) {
      Index const i = q.index(path);
      deviations = std::max(deviations, std::abs(fit.x[i] - std::log(factor)) / std::sqrt(fit.covariance(i, i)));
    }
    return deviations;
  };
  Fit const estimated = fitted();
  EXPECT_LT(worst(estimated), 3.0);
  run.alternatives.clear();
  Fit const held = fitted();
  EXPECT_GT(worst(held), 3.0);
  EXPECT_GT(held.cost, estimated.cost + 100.0);
}

/// A thermometer in still air shows late what the coolant that follows the room brings at once. Where that is not
/// asked, the sensors of the coolant and of what it cools seem to have no lag.
TEST(Estimation, FindsThatTheRoomsRecordIsLate) {
  Machine machine = Machine::build(read_toml(machine_file("g200")));
  for (auto& sensor : machine.sensors) sensor.description.lag = 30.0;
  auto dataset = run(machine, tests::experiment(R"(
    duration = "6 h"
    ambient.mean = "20 degC"
    ambient.air_conditioning = {amplitude = "0.5 K", period = "15 min"}
    [spindle]
    blocks = [{duration = "2 h", speed = "3000 rpm"}, {duration = "1 h", speed = "0 rpm"},
              {duration = "3 h", speed = "2000 rpm"}])"),
                     {})
                     .dataset;
  for (auto& input : dataset.inputs)
    if (input.name == "ambient.temperature") {
      auto const after_first = input.values.size() - 1;
      input.values.tail(after_first) = input.values.head(after_first).eval();  // 60 s late
    }
  auto measured = measured_run(dataset, machine, "late");
  tests::add_noise(measured, kelvin, metres, 5);
  Value const document = read_toml(machine_file("g200"));
  auto const noise = tests::noise_of(measured, kelvin, metres);
  std::vector<BinnedRun> const data = {bin(measured, 120.0)};
  Estimation const estimation(document, data, tests::channels_of(measured), noise);
  auto const fit = estimation.fit(estimation.prior_mean());
  Index const late = index_of(estimation, "ambient.temperature 30 s before its record, run 1");
  ASSERT_LT(late, Index(estimation.unknowns().size()));
  EXPECT_NEAR(fit.x[late], 2.0, 0.5);  // of half a minute; a delay of a cycle is not quite its slope
  EXPECT_LT(std::sqrt(fit.covariance(late, late)), 0.25);
  measured.alternatives.clear();
  std::vector<BinnedRun> const literal_data = {bin(measured, 120.0)};
  Estimation const literal(document, literal_data, tests::channels_of(measured), noise);
  EXPECT_GT(literal.fit(literal.prior_mean()).cost, fit.cost + 100.0);
}

/// A v450 that felt this air [K] through 20 h, while the room's sensor recorded another.
MeasuredRun in_another_air(VectorXd const& time, VectorXd const& felt, VectorXd const& recorded) {
  auto experiment = tests::experiment(R"(
    duration = "20 h"
    [spindle]
    blocks = [{duration = "6 h", speed = "3000 rpm"}, {duration = "5 h", speed = "0 rpm"},
              {duration = "9 h", speed = "2000 rpm"}])");
  experiment.driven.push_back(
      {{"ambient.temperature", "K", "felt"},
       scenarios::Signal({time.begin(), time.end()}, {felt.begin(), felt.end()}, scenarios::Interpolation::linear)});
  Machine machine = Machine::build(v450());
  for (auto& sensor : machine.sensors) sensor.description.lag = 30.0;
  auto dataset = run(machine, experiment, {}).dataset;
  FirstOrderLag const record(time, recorded, 0.0);
  for (auto& input : dataset.inputs)
    if (input.name == "ambient.temperature")
      input.values = dataset.time_s.unaryExpr([&](double t) { return record.at(t) - 273.15; });
  auto measured = measured_run(dataset, machine, "in a hall");
  tests::add_noise(measured, kelvin, metres, 5);
  return measured;
}

/// Half of what painted surfaces exchange with a room is radiation, and walls are not as warm as the air. This machine
/// feels 0.6 of the air and 0.4 of walls that follow it by six hours; recorded is the air.
TEST(Estimation, FindsThatSurfacesSeeWallsThatFollowTheAirSlowly) {
  Index const rows = 121;
  double const minutes_10 = 600.0, day = 86400.0, door = 5.0 * 3600.0;  // by which walls are no daily cycle
  Eigen::VectorXd const time = minutes_10 * Eigen::VectorXd::LinSpaced(rows, 0.0, double(rows - 1));
  auto const angle = 2.0 * std::numbers::pi * time.array();
  Eigen::VectorXd const air = 294.15 + 2.0 * (angle / day).sin() + (angle / door).sin();
  FirstOrderLag const walls(time, air, 6.0 * 3600.0);
  VectorXd const felt = 0.6 * air + 0.4 * time.unaryExpr([&](double t) { return walls.at(t); });
  auto measured = in_another_air(time, felt, air);
  auto const noise = tests::noise_of(measured, kelvin, metres);
  std::vector<BinnedRun> const data = {bin(measured, 300.0)};
  Estimation const estimation(v450(), data, tests::channels_of(measured), noise);
  auto const fit = estimation.fit(estimation.prior_mean());
  Index const share = index_of(estimation, "ambient.temperature as walls follow it, run 1");
  ASSERT_LT(share, Index(estimation.unknowns().size()));
  EXPECT_NEAR(fit.x[share], 0.4, 3.0 * std::sqrt(fit.covariance(share, share)));
  EXPECT_LT(std::sqrt(fit.covariance(share, share)), 0.08);
  measured.alternatives.clear();
  std::vector<BinnedRun> const literal_data = {bin(measured, 300.0)};
  Estimation const literal(v450(), literal_data, tests::channels_of(measured), noise);
  EXPECT_GT(literal.fit(literal.prior_mean()).cost, fit.cost + 20.0);
}

/// The room's sensor hangs at another wall: the machine's air goes through a cosine of 0.25 K a day beside it. Nothing
/// else takes that up; a machine whose loop may be anything is not asked.
TEST(Estimation, FindsADailyCycleOfTheAirThatTheRoomsSensorDoesNotTell) {
  double const day = 86400.0, door = 5.0 * 3600.0;
  Eigen::VectorXd const time = 600.0 * Eigen::VectorXd::LinSpaced(121, 0.0, 120.0);
  auto const angle = 2.0 * std::numbers::pi * time.array();
  Eigen::VectorXd const air = 294.15 + (angle / day).sin() + (angle / door).sin();
  Eigen::VectorXd const felt = air.array() + 0.25 * (angle / day).cos();
  auto const measured = in_another_air(time, felt, air);
  auto const noise = tests::noise_of(measured, kelvin, metres);
  std::vector<BinnedRun> const data = {bin(measured, 300.0)};
  Estimation const estimation(v450(), data, tests::channels_of(measured), noise);
  auto const fit = estimation.fit(estimation.prior_mean());
  for (auto const& [name, truth] : {std::pair{"cosine", 0.25}, {"sine", 0.0}}) {
    auto const u = index_of(estimation, fmt::format("ambient.temperature and a {} of the day, run 1", name));
    ASSERT_LT(u, Index(estimation.unknowns().size()));
    double const error = std::sqrt(fit.covariance(u, u));
    EXPECT_NEAR(fit.x[u], truth, 3.0 * error) << name;
    EXPECT_LT(error, 0.08) << name;
  }
  Value any_step = v450();
  set_parameter(any_step, "displacement.E_X.segment.0.weight", "0");
  Estimation const without_drawings(any_step, data, tests::channels_of(measured), noise);
  for (auto const& unknown : without_drawings.unknowns())
    EXPECT_FALSE(unknown.name.ends_with("of the day, run 1")) << unknown.name;
}

/// The record has a row each minute, and the speed changes 45 s before one. When it did is found, and so are the
/// numbers; with the record taken at its word it is a machine that loses less.
TEST(Estimation, FindsWhenTheSpeedChangedBetweenTwoRows) {
  auto const between = tests::two_speeds("4755 s", "50 min", "50 min", "3645 s");
  auto run = tests::measured(truth(), between);
  tests::add_noise(run, kelvin, metres, 5);
  std::vector<BinnedRun> const data = {bin(run, 120.0)};
  auto const noise = tests::noise_of(run, kelvin, metres);
  Estimation const estimation(v450(), data, tests::channels_of(run), noise);
  auto const fit = estimation.fit(estimation.prior_mean());
  int found = 0;
  Index together = 0;
  for (std::size_t u = 0; u < estimation.unknowns().size(); ++u) {
    auto const i = Index(u);
    if (estimation.unknowns()[u].kind == Unknown::Kind::moments) together = i;
    if (estimation.unknowns()[u].kind != Unknown::Kind::moment) continue;
    ASSERT_GT(together, 0);
    double const minute = 60.0;
    double const error = std::sqrt(fit.covariance(i, i) + 2.0 * minute * fit.covariance(i, together) +
                                   minute * minute * fit.covariance(together, together));
    EXPECT_NEAR(fit.x[i] + minute * fit.x[together], 45.0, 3.0 * error) << estimation.unknowns()[u].name;
    EXPECT_LT(error, 15.0) << estimation.unknowns()[u].name;
    ++found;
  }
  EXPECT_EQ(found, 3);
  run.changes.clear();
  std::vector<BinnedRun> const literal_data = {bin(run, 120.0)};
  Estimation const literal(v450(), literal_data, tests::channels_of(run), noise);
  EXPECT_GT(literal.fit(literal.prior_mean()).cost, fit.cost + 100.0);
}

/// A logger that writes down a time 12 s too early: the clock is found beside the numbers, while sensors are slower.
TEST(Estimation, FindsThatALoggersClockIsBehind) {
  auto run = tests::measured(truth(), tests::two_speeds("4788 s", "50 min", "50 min", "3612 s"));
  tests::add_noise(run, kelvin, metres, 5);
  run.changes.clear();
  for (auto& channel : run.channels) channel.clock = "logger.csv";
  std::vector<BinnedRun> const data = {bin(run, 120.0)};
  Estimation const estimation(v450(), data, tests::channels_of(run), tests::noise_of(run, kelvin, metres));
  auto const fit = estimation.fit(estimation.prior_mean());
  auto const clock = index_of(estimation, "clock of logger.csv behind, run 1");
  double const error = std::sqrt(fit.covariance(clock, clock));
  EXPECT_NEAR(fit.x[clock], 12.0, 2.0 * error);
  EXPECT_LT(error, 4.0);
}

TEST(Estimation, WritesWhatItFoundIntoTheMachine) {
  auto const& q = question();
  auto const document = q.estimation->document_at(q.fit.x);
  for (auto const& [path, factor] : changes)
    EXPECT_NEAR(find_number(document, path).value, find_number(v450(), path).value * std::exp(q.fit.x[q.index(path)]),
                1e-9 * find_number(v450(), path).value)
        << path;
  auto const machine = q.estimation->machine_at(q.fit.x);
  for (auto const& sensor : machine.sensors)
    EXPECT_NEAR(*sensor.description.lag, q.fit.x[q.index("lag of " + sensor.description.name)], 1e-9);
}

/// An effect that was added gets an amplitude, in units of its largest, and the evidence knows that it is there.
TEST(Estimation, FindsTheAmplitudeOfAnAddedEffect) {
  auto const hidden = tests::with_table(v450(), R"(
    [[heat]]
    name = "hidden"
    at = "motor"
    power = "60 W")");
  auto run = tests::measured(hidden, tests::two_speeds());
  tests::add_noise(run, kelvin, metres, 6);
  std::vector<BinnedRun> const data = {bin(run, 300.0)};
  Estimation const without(v450(), data, tests::channels_of(run), tests::noise_of(run, kelvin, metres));
  Fit const before = without.fit(without.prior_mean());
  std::vector<Hypothesis> heat;
  for (auto const& hypothesis : hypotheses(v450(), Machine::build(v450())))
    if (heat.empty() && hypothesis.label() == "heat at motor") heat.push_back(hypothesis);
  ASSERT_EQ(heat.size(), 1U);
  auto const with = without.with(heat);
  ASSERT_EQ(with.unknowns().back().kind, Unknown::Kind::amplitude);
  VectorXd start(before.x.size() + 1);
  start << before.x, 0.01;
  Fit const after = with.fit(start);
  Index const last = after.x.size() - 1;
  double const error = std::sqrt(after.covariance(last, last)), unit = heat[0].largest;
  EXPECT_NEAR(after.x[last] * unit, 60.0, 3.0 * error * unit);
  EXPECT_LT(error * unit, 15.0);
  EXPECT_LT(after.evidence, before.evidence - 20.0);
  auto const amended = with.document_at(after.x);
  EXPECT_NEAR(find_number(amended, "heat.diagnosed_1.power").value, after.x[last] * unit, 1e-6);
}

}  // namespace
}  // namespace thermotwin::twin
