#include "twin/diagnosis/unknown_heat.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "scenarios/course.h"
#include "thermal/error.h"
#include "thermal/integrate.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// --- one body: C dT/dt = q − G T, seen by sensors of its temperature
// --------------------------------------------------

struct Body {
  double capacity = 35e3;    ///< [J/K]
  double conductance = 5.0;  ///< [W/K]

  [[nodiscard]] double rate() const { return conductance / capacity; }
};

ResidualModel model_of(Body const& body, VectorXd const& noise, double interval) {
  ResidualModel model;
  model.interval = interval;
  model.regimes = {{0, MatrixXd::Constant(1, 1, -body.rate()), MatrixXd::Ones(noise.size(), 1)}};
  model.capacity = VectorXd::Constant(1, body.capacity);
  model.noise = noise;
  model.disturbance = 0.0;
  return model;
}

/// Exact step of (T, q) of a body with G > 0 over t, by hand: F, and Q of q̇ = s·white noise.
std::pair<Eigen::Matrix2d, Eigen::Matrix2d> exact_step(Body const& body, double s, double t) {
  double const a = body.rate(), g = body.conductance, e = std::exp(-a * t);
  Eigen::Matrix2d F, Q;
  F << e, (1.0 - e) / g, 0.0, 1.0;
  Q(0, 0) = (t - 2.0 * (1.0 - e) / a + (1.0 - e * e) / (2.0 * a)) / (g * g);
  Q(0, 1) = Q(1, 0) = (t - (1.0 - e) / a) / g;
  Q(1, 1) = t;
  return {F, s * s * Q};
}

/// Steady covariance of the filter after its update, from the stable subspace of the symplectic matrix of the discrete
/// algebraic Riccati equation P = F (P − P Hᵀ (H P Hᵀ + r)⁻¹ H P) Fᵀ + Q (Vaughan 1970); no recursion.
Eigen::Matrix2d steady_covariance(Eigen::Matrix2d const& F, Eigen::Matrix2d const& Q, double r) {
  Eigen::Vector2d const h(1.0, 0.0);
  Eigen::Matrix2d const S = h * h.transpose() / r, back = F.inverse();
  Eigen::Matrix4d symplectic;
  symplectic << F.transpose() + S * back * Q, -S * back, -back * Q, back;
  Eigen::EigenSolver<Eigen::Matrix4d> const eigen(symplectic);
  Eigen::Matrix<std::complex<double>, 4, 2> stable;
  int found = 0;
  for (int i = 0; i < 4; ++i)
    if (std::abs(eigen.eigenvalues()[i]) < 1.0) stable.col(found++) = eigen.eigenvectors().col(i);
  Eigen::Matrix2d const P = (stable.bottomRows<2>() * stable.topRows<2>().inverse()).real();
  return P - P * h * h.transpose() * P / (P(0, 0) + r);
}

TEST(UnknownHeat, StandardErrorInTheLongRunSolvesTheRiccatiEquation) {
  double const sigma = 0.1;
  for (double capacity : {500.0, 35e3})
    for (double interval : {10.0, 60.0})
      for (double intensity : {0.03, 0.3}) {
        Body const body{capacity, 5.0};
        auto const model = model_of(body, VectorXd::Constant(1, sigma), interval);
        auto const estimate = estimate_heat(model, MatrixXd::Zero(4000, 1), {0, intensity});
        auto const [F, Q] = exact_step(body, intensity, interval);
        double const expected = std::sqrt(steady_covariance(F, Q, sigma * sigma)(1, 1));
        EXPECT_NEAR(estimate.filtered.standard_error[3999], expected, 1e-7 * expected)
            << fmt::format("C = {} J/K, {} s, {} W/s^0.5", capacity, interval, intensity);
      }
}

/// Where samples come fast, the continuous Riccati equation has a closed form: with ρ = σ² Δt, c = s √ρ,
/// var q = C c √((G/C)² + 2 c/(C ρ)). It forgets that a sample is 10 s old at worst: 1 %.
TEST(UnknownHeat, StandardErrorInTheLongRunHasAClosedForm) {
  double const sigma = 0.1, interval = 10.0, intensity = 0.03;
  Body const body;
  auto const model = model_of(body, VectorXd::Constant(1, sigma), interval);
  auto const estimate = estimate_heat(model, MatrixXd::Zero(4000, 1), {0, intensity});
  double const density = sigma * sigma * interval, c = intensity * std::sqrt(density);
  double const variance =
      body.capacity * c * std::sqrt(body.rate() * body.rate() + 2.0 * c / (body.capacity * density));
  EXPECT_NEAR(estimate.filtered.standard_error[3999], std::sqrt(variance), 0.01 * std::sqrt(variance));
}

/// Constant heat, nothing lost, start unknown: the slope of a line, σ_q = C σ √(12/N)/W (1 − 1/N²)^−½, W = N Δt.
TEST(UnknownHeat, ResolutionOfAConstantHeatIsThatOfASlope) {
  struct Window {
    int samples;
    double watts;  ///< of physics.md 8.3
  };
  for (auto const& [samples, watts] : {Window{10, 6.4}, Window{30, 1.2}}) {
    Body const body{35e3, 0.0};
    auto model = model_of(body, VectorXd::Constant(1, 0.1), 60.0);
    model.initial_deviation = 1e3;
    model.prior_heat = 1e5;
    auto const estimate = estimate_heat(model, MatrixXd::Zero(samples, 1), {0, 0.0});
    double const rule = body.capacity * 0.1 * std::sqrt(12.0 / samples) / (samples * 60.0);
    double const exact = rule / std::sqrt(1.0 - 1.0 / (samples * samples));
    EXPECT_NEAR(estimate.filtered.standard_error[samples - 1], exact, 1e-6 * exact);
    EXPECT_NEAR(rule, watts, 0.05);
  }
}

// --- against the whole posterior at once
// ------------------------------------------------------------------------------

struct Posterior {
  VectorXd heat, standard_error;
  double log_likelihood;
};

/// All rows as one Gaussian vector, conditioned in one step; the rate of the body may change from row to row.
Posterior condition(std::vector<Body> const& bodies, ResidualModel const& model, double intensity,
                    MatrixXd const& residuals) {
  Index const rows = residuals.rows();
  MatrixXd states = MatrixXd::Zero(2 * rows, 2 * rows);
  states(0, 0) = model.initial_deviation * model.initial_deviation;
  states(1, 1) = model.prior_heat * model.prior_heat;
  for (Index k = 1; k < rows; ++k) {
    auto const [F, Q] = exact_step(bodies[std::size_t(k - 1)], intensity, model.interval);
    states.block(2 * k, 0, 2, 2 * k) = F * states.block(2 * (k - 1), 0, 2, 2 * k);
    states.block(0, 2 * k, 2 * k, 2) = states.block(2 * k, 0, 2, 2 * k).transpose();
    states.block(2 * k, 2 * k, 2, 2) = F * states.block(2 * (k - 1), 2 * (k - 1), 2, 2) * F.transpose() + Q;
  }
  std::vector<Index> seen, heat;
  std::vector<double> data, variance;
  for (Index k = 0; k < rows; ++k) {
    heat.push_back(2 * k + 1);
    for (Index c = 0; c < residuals.cols(); ++c)
      if (!std::isnan(residuals(k, c))) {
        seen.push_back(2 * k);
        data.push_back(residuals(k, c));
        variance.push_back(model.noise[c] * model.noise[c]);
      }
  }
  MatrixXd spread = states(seen, seen);
  spread.diagonal() += Eigen::Map<VectorXd>(variance.data(), Index(variance.size()));
  Eigen::Map<VectorXd> const r(data.data(), Index(data.size()));
  Eigen::LLT<MatrixXd> const solver(spread);
  MatrixXd const cross = states(heat, seen);
  MatrixXd const left = states(heat, heat) - cross * solver.solve(cross.transpose());
  double const logarithm = 2.0 * solver.matrixLLT().diagonal().array().log().sum();
  return {cross * solver.solve(r), left.diagonal().cwiseSqrt(),
          -0.5 * (r.dot(solver.solve(r)) + logarithm + double(r.size()) * std::log(2.0 * M_PI))};
}

MatrixXd noise_of(Index rows, VectorXd const& sigma, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  MatrixXd noise(rows, sigma.size());
  for (Index k = 0; k < rows; ++k)
    for (Index c = 0; c < sigma.size(); ++c) noise(k, c) = sigma[c] * normal(random);
  return noise;
}

class AgainstThePosterior : public testing::TestWithParam<double> {};

/// Filter and smoother are the posterior, whatever is missing and however fast the body is; two sensors of different
/// noise, a change of regime at row 15.
TEST_P(AgainstThePosterior, FilterAndSmootherAgree) {
  double const capacity = GetParam(), nan = std::numeric_limits<double>::quiet_NaN();
  Body const slow{capacity, 5.0}, fast{capacity, 9.0};
  auto model = model_of(slow, Eigen::Vector2d(0.1, 0.4), 60.0);
  model.initial_deviation = 0.2;
  model.regimes.push_back({15, MatrixXd::Constant(1, 1, -fast.rate()), MatrixXd::Ones(2, 1)});
  MatrixXd residuals = noise_of(40, Eigen::Vector2d(0.5, 0.5), 7);
  for (Index k : {0, 5, 6, 7, 15, 23, 39}) residuals(k, 0) = nan;
  for (Index k : {5, 6, 7, 20, 39}) residuals(k, 1) = nan;
  std::vector<Body> bodies(15, slow);
  bodies.resize(40, fast);
  double const intensity = 0.3;

  auto const estimate = estimate_heat(model, residuals, {0, intensity});
  auto const whole = condition(bodies, model, intensity, residuals);
  EXPECT_NEAR(estimate.log_likelihood, whole.log_likelihood, 1e-7);
  for (Index k = 0; k < 40; ++k) {
    EXPECT_NEAR(estimate.smoothed.heat[k], whole.heat[k], 1e-6) << k;
    EXPECT_NEAR(estimate.smoothed.standard_error[k], whole.standard_error[k], 1e-6) << k;
    MatrixXd const until = residuals.topRows(k + 1);
    if (!until.array().isNaN().all()) {
      auto const known = condition(bodies, model, intensity, until);
      EXPECT_NEAR(estimate.filtered.heat[k], known.heat[k], 1e-6) << k;
      EXPECT_NEAR(estimate.filtered.standard_error[k], known.standard_error[k], 1e-6) << k;
    }
  }
}

/// Time constants of two hours, a minute and half a second, sampled once a minute.
INSTANTIATE_TEST_SUITE_P(Capacity, AgainstThePosterior, testing::Values(36e3, 300.0, 2.5));

/// The step is exact, so what is not seen does not matter: every second row missing is twice the interval.
TEST(UnknownHeat, RowsWithoutSamplesAreOnlyTime) {
  Body const body{282.0, 50.0};
  VectorXd const sigma = VectorXd::Constant(1, 0.1);
  MatrixXd const coarse = noise_of(60, sigma, 3);
  MatrixXd fine = MatrixXd::Constant(119, 1, std::numeric_limits<double>::quiet_NaN());
  for (Index k = 0; k < 60; ++k) fine(2 * k, 0) = coarse(k, 0);
  auto with_disturbance = [&](double interval) {
    auto model = model_of(body, sigma, interval);
    model.disturbance = 1e-3;
    return model;
  };
  auto const a = estimate_heat(with_disturbance(60.0), coarse, {0, 0.3});
  auto const b = estimate_heat(with_disturbance(30.0), fine, {0, 0.3});
  EXPECT_NEAR(a.log_likelihood, b.log_likelihood, 1e-8);
  EXPECT_NEAR(a.nis, b.nis, 1e-10);
  for (Index k = 0; k < 60; ++k) {
    EXPECT_NEAR(a.smoothed.heat[k], b.smoothed.heat[2 * k], 1e-8);
    EXPECT_NEAR(a.smoothed.standard_error[k], b.smoothed.standard_error[2 * k], 1e-8);
  }
}

/// The last row is the same before and after smoothing; everywhere else more data never widen the error.
TEST(UnknownHeat, SmoothingStartsFromTheFilterAndNarrowsIt) {
  auto const model = model_of({}, VectorXd::Constant(1, 0.1), 60.0);
  auto const estimate = estimate_heat(model, noise_of(100, model.noise, 1), {0, 0.03});
  EXPECT_DOUBLE_EQ(estimate.smoothed.heat[99], estimate.filtered.heat[99]);
  EXPECT_DOUBLE_EQ(estimate.smoothed.standard_error[99], estimate.filtered.standard_error[99]);
  for (Index k = 0; k < 99; ++k) EXPECT_LT(estimate.smoothed.standard_error[k], estimate.filtered.standard_error[k]);
}

// --- scans
// ------------------------------------------------------------------------------------------------------------

TEST(HeatScan, OfAHeatThatMustBeZeroGainsNothing) {
  auto model = model_of({}, VectorXd::Constant(1, 0.1), 60.0);
  model.prior_heat = 0.0;
  auto const scan = scan_for_heat(model, noise_of(50, model.noise, 2), {0}, {0.0});
  EXPECT_NEAR(scan.ranking.at(0).gain, 0.0, 1e-12);
  EXPECT_NEAR(scan.ranking.at(0).weight, 0.5, 1e-12);
  EXPECT_NEAR(scan.weight_without, 0.5, 1e-12);
}

TEST(HeatScan, GivesEachSetOfDataItsOwnRanking) {
  auto const model = model_of({}, VectorXd::Constant(1, 0.1), 60.0);
  MatrixXd const quiet = noise_of(100, model.noise, 4);
  MatrixXd const rising = quiet + VectorXd::LinSpaced(100, 0.0, 5.0);
  auto const together = scan_for_heat(model, std::vector<MatrixXd>{quiet, rising}, {0});
  for (std::size_t s = 0; s < 2; ++s) {
    auto const alone = scan_for_heat(model, s == 0 ? quiet : rising, {0});
    EXPECT_EQ(together[s].ranking[0].gain, alone.ranking[0].gain);
    EXPECT_EQ(together[s].ranking[0].source.intensity, alone.ranking[0].source.intensity);
    auto const estimate = estimate_heat(model, s == 0 ? quiet : rising, alone.ranking[0].source);
    EXPECT_EQ(estimate.nis, alone.ranking[0].nis);
  }
  EXPECT_LT(together[0].ranking[0].gain, 0.0);
  EXPECT_GT(together[1].ranking[0].gain, 100.0);
}

TEST(HeatScan, SaysWhatDoesNotFit) {
  auto const model = model_of({}, VectorXd::Constant(1, 0.1), 60.0);
  MatrixXd const data = MatrixXd::Zero(5, 1);
  auto const complaint = [&](auto change, MatrixXd const& residuals, HeatSource const& source) -> std::string {
    auto changed = model;
    change(changed);
    try {
      (void)estimate_heat(changed, residuals, source);
    } catch (thermal::InputError const& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  using testing::AllOf, testing::HasSubstr;
  auto const as_is = [](ResidualModel&) {};
  EXPECT_THAT(complaint(as_is, data, {3, 0.03}), AllOf(HasSubstr("node 3"), HasSubstr("0 to 0")));
  EXPECT_THAT(complaint(as_is, data, {0, -1.0}), HasSubstr("intensity -1"));
  EXPECT_THAT(complaint(as_is, MatrixXd::Zero(5, 2), {}), AllOf(HasSubstr("2 channels"), HasSubstr("model of 1")));
  MatrixXd const infinite = MatrixXd::Constant(5, 1, std::numeric_limits<double>::infinity());
  EXPECT_THAT(complaint(as_is, infinite, {}), HasSubstr("infinite"));
  EXPECT_THAT(complaint([](auto& m) { m.noise[0] = 0.0; }, data, {}), HasSubstr("noise of channel 0 is 0"));
  EXPECT_THAT(complaint([](auto& m) { m.capacity[0] = -1.0; }, data, {}), HasSubstr("node 0 is -1"));
  EXPECT_THAT(complaint([](auto& m) { m.interval = 0.0; }, data, {}), HasSubstr("interval"));
  EXPECT_THAT(complaint([](auto& m) { m.regimes.clear(); }, data, {}), HasSubstr("at least one regime"));
  EXPECT_THAT(complaint([](auto& m) { m.regimes[0].first_row = 1; }, data, {}), HasSubstr("row 0"));
  EXPECT_THAT(complaint([](auto& m) { m.regimes[0].dynamics.resize(2, 2); }, data, {}), HasSubstr("2 x 2"));
  EXPECT_THAT(complaint([](auto& m) { m.regimes[0].observation.resize(1, 2); }, data, {}), HasSubstr("1 x 2"));
  MatrixXd gap = data;
  gap(2, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)scan_for_heat(model, std::vector<MatrixXd>{data, gap}, {0}), thermal::InputError);
  EXPECT_THROW((void)scan_for_heat(model, data, {}), thermal::InputError);
}

// --- physics.md 8.3 on Set B: v450, 4000 rpm, eight sensors of 0.1 K once a minute for four hours
// ---------------------

constexpr double sigma = 0.1;

struct Place {
  char const* body;
  int cell;
};
constexpr Place sensors[] = {{"cartridge", 0},  {"cartridge", 2}, {"cartridge", 6}, {"front_ring", 0},
                             {"head_front", 0}, {"head_rear", 0}, {"motor", 0},     {"column_front", 0}};
constexpr Place candidates[] = {{"shaft", 2},        {"front_ring", 0}, {"cartridge", 0}, {"cartridge", 6},
                                {"head_front", 0},   {"head_rear", 0},  {"motor", 0},     {"shaft", 19},
                                {"column_front", 0}, {"column_rear", 0}};

Value v450() { return read_toml(std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "twin/machines/v450.toml"); }

/// The machine with a source that its twin does not know.
Value with_heat(std::string const& at, double watts, std::string const& while_on) {
  Value document = v450();
  Value const addition = parse_toml(fmt::format("[[heat]]\nname = \"hidden\"\nat = \"{}\"\npower = \"{} W\"\n"
                                                "while_on = \"{}\"\n",
                                                at, watts, while_on),
                                    "hidden.toml");
  std::get<Value::Table>(document.content).push_back(std::get<Value::Table>(addition.content).front());
  return document;
}

/// Four hours at 4000 rpm; "hidden.on" rises after half an hour.
scenarios::Experiment warm_up() {
  scenarios::Experiment experiment;
  experiment.duration = 4 * 3600.0;
  experiment.ambient.mean = 295.15;
  experiment.spindle.emplace();
  experiment.spindle->blocks.push_back({experiment.duration, 4000.0 * 2.0 * M_PI / 60.0, {}});
  experiment.inputs.push_back({"hidden.on", {{1800.0, "0 %"}, {experiment.duration - 1800.0, "100 %"}}});
  return experiment;
}

/// A run of a machine: every node once a minute, and the operating point, which does not change.
struct Course {
  explicit Course(Value const& document) : machine(Machine::build(document)) {
    auto const experiment = warm_up();
    scenarios::ExperimentCourse const input(experiment, machine.limits);
    auto const times = scenarios::sample_times(experiment);
    std::vector<double> const start(std::size_t(machine.network().nodes()), 295.15);
    temperatures.resize(Index(times.size()), machine.network().nodes());
    Index row = 0;
    thermal::integrate(machine.network(), input, start, times, {}, [&](thermal::Sample const& sample) {
      temperatures.row(row++) = Eigen::Map<VectorXd const>(sample.temperatures.data(), temperatures.cols());
      operating_point.assign(sample.input.begin(), sample.input.end());
    });
  }
  [[nodiscard]] Index node(Place const& place) const { return machine.network().range(place.body).first + place.cell; }

  Machine machine;
  MatrixXd temperatures;
  std::vector<double> operating_point;
};

/// The twin, which knows nothing of the source, linearised at the end of its run.
struct Twin {
  Course course{v450()};
  ResidualModel model;
  std::vector<Index> seen, nodes;

  Twin() {
    for (auto const& place : sensors) seen.push_back(course.node(place));
    for (auto const& place : candidates) nodes.push_back(course.node(place));
    auto const& network = course.machine.network();
    model.regimes = {regime(240, 0)};
    model.capacity = Eigen::Map<VectorXd const>(network.capacity().data(), network.nodes());
    model.noise = VectorXd::Constant(Index(seen.size()), sigma);
  }
  /// The machine as it is at a minute, for the rows from `first_row` on.
  [[nodiscard]] Regime regime(Index minute, Index first_row) const {
    auto const& network = course.machine.network();
    std::vector<double> state;
    for (int i = 0; i < network.nodes(); ++i)
      state.push_back(network.state_of_temperature(i, course.temperatures(minute, i)));
    std::vector<NodeWeights> channels;
    for (Index node : seen) channels.push_back({{int(node), 1.0}});
    auto result = linearise(network, state, course.operating_point, channels);
    result.first_row = first_row;
    return result;
  }
  [[nodiscard]] MatrixXd deviation(Value const& truth) const {
    MatrixXd const difference = Course(truth).temperatures - course.temperatures;
    return difference(Eigen::all, seen);
  }
  /// What a machine shows that hides something, once per seed of the noise.
  [[nodiscard]] std::vector<MatrixXd> residuals(Value const& truth, unsigned seeds) const {
    MatrixXd const quiet = deviation(truth);
    std::vector<MatrixXd> sets;
    for (unsigned seed = 1; seed <= seeds; ++seed) sets.push_back(quiet + noise(seed));
    return sets;
  }
  [[nodiscard]] MatrixXd noise(unsigned seed) const { return noise_of(course.temperatures.rows(), model.noise, seed); }
  [[nodiscard]] std::string name(Index node) const { return course.machine.network().node_name(int(node)); }
};

/// physics.md 8.3: what is hidden, and what the scan and the smoother say of it.
struct Hidden {
  char const* at;
  char const* node;
  double watts;
  char const* while_on;
  double standard_error;  ///< of q at most [W]
  char const* runner_up;
  double margin_from, margin_to;  ///< gain over the runner-up
};

class HiddenHeat : public testing::TestWithParam<Hidden> {};

TEST_P(HiddenHeat, IsFoundAndMeasuredWithinItsErrors) {
  auto const& hidden = GetParam();
  Twin const twin;
  auto const sets = twin.residuals(with_heat(hidden.at, hidden.watts, hidden.while_on), 5);
  auto const scans = scan_for_heat(twin.model, sets, twin.nodes);
  double squares = 0.0;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    SCOPED_TRACE(fmt::format("seed {}", s + 1));
    auto const& winner = scans[s].ranking[0];
    auto const& second = scans[s].ranking[1];
    EXPECT_EQ(twin.name(winner.source.node), hidden.node);
    EXPECT_EQ(twin.name(second.source.node), hidden.runner_up);
    EXPECT_GT(winner.gain - second.gain, hidden.margin_from);
    EXPECT_LT(winner.gain - second.gain, hidden.margin_to);
    EXPECT_LT(scans[s].weight_without, 1e-100);
    EXPECT_NEAR(winner.nis, 1.0, 0.1);
    auto const estimate = estimate_heat(twin.model, sets[s], winner.source);
    for (int minute : {15, 60, 120, 180, 230}) {
      bool const on = minute > 30 || hidden.while_on == std::string("machine.on");
      double const error = estimate.smoothed.heat[minute] - (on ? hidden.watts : 0.0);
      double const standard_error = estimate.smoothed.standard_error[minute];
      EXPECT_LT(standard_error, hidden.standard_error) << minute;
      EXPECT_LT(std::abs(error), 3.0 * standard_error + 0.015 * hidden.watts) << minute;  // and what is not linear
      squares += std::pow(error / standard_error, 2) / 25.0;
    }
  }
  EXPECT_LT(squares, 2.0);
}

INSTANTIATE_TEST_SUITE_P(
    V450, HiddenHeat,
    testing::Values(Hidden{"head_front", "head_front", 20.0, "hidden.on", 3.2, "shaft[19]", 300.0, 800.0},
                    Hidden{"motor", "motor", 40.0, "machine.on", 0.3, "head_rear", 1e5, 2e5},
                    Hidden{"shaft[390 mm]", "shaft[19]", 25.0, "machine.on", 1.5, "head_front", 100.0, 800.0},
                    Hidden{"column_rear", "column_rear", 40.0, "machine.on", 3.0, "column_front", 0.0, 20.0}),
    [](auto const& info) { return std::string(info.param.node).substr(0, std::string(info.param.node).find('[')); });

/// The oil of a cold spindle brakes more, so one linearisation for the whole warm-up bends q; five do not.
TEST(HiddenHeat, IsConstantWhenTheTwinIsLinearisedAlongItsCourse) {
  Twin const twin;
  MatrixXd const quiet = twin.deviation(with_heat("shaft[390 mm]", 25.0, "machine.on"));
  HeatSource const source{twin.course.node({"shaft", 19}), 0.03};
  auto along = twin.model;
  along.regimes = {twin.regime(7, 0), twin.regime(22, 15), twin.regime(45, 30), twin.regime(90, 60),
                   twin.regime(180, 120)};
  auto const drift = [&](ResidualModel const& model) {
    auto const heat = estimate_heat(model, quiet, source).smoothed.heat;
    EXPECT_NEAR(heat[230], 25.0, 0.02 * 25.0);
    return std::abs(heat[230] - heat[5]);
  };
  EXPECT_GT(drift(twin.model), 1.0);
  EXPECT_LT(drift(along), 0.3);
}

TEST(HiddenHeat, ThatIsNotThereRaisesNoAlarm) {
  Twin const twin;
  std::vector<MatrixXd> sets;
  for (unsigned seed = 1; seed <= 20; ++seed) sets.push_back(twin.noise(seed));
  for (auto const& scan : scan_for_heat(twin.model, sets, twin.nodes)) {
    EXPECT_LT(scan.ranking.front().gain, 0.0) << twin.name(scan.ranking.front().source.node);
    EXPECT_GT(scan.weight_without, 0.5);
    EXPECT_NEAR(scan.nis_without, 1.0, 0.1);
  }
}

}  // namespace
}  // namespace thermotwin::twin
