#include "twin/diagnosis/free_heat.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "scenarios/course.h"
#include "tests/twin/diagnosis/diagnosis_bench.h"

namespace thermotwin::twin {
namespace {

using tests::v450;

constexpr double kelvin = 0.02, metres = 0.05e-6;

scenarios::Experiment with_step() {
  auto experiment = tests::two_speeds();
  experiment.inputs.push_back({"hidden.on", {{4000.0, "0 %"}, {experiment.duration - 4000.0, "100 %"}}});
  return experiment;
}

/// What a machine showed, with noise, and the estimation of v450 from it.
struct Asked {
  Asked(MeasuredRun shown, unsigned seed)
      : run(noisy(std::move(shown), seed)),
        data{bin(run, 300.0)},
        estimation(v450(), data, tests::channels_of(run), tests::noise_of(run, kelvin, metres)) {}
  Asked(Asked const&) = delete;
  Asked& operator=(Asked const&) = delete;
  static MeasuredRun noisy(MeasuredRun shown, unsigned seed) {
    tests::add_noise(shown, kelvin, metres, seed);
    return shown;
  }

  MeasuredRun run;
  std::vector<BinnedRun> data;
  Estimation estimation;
};

std::vector<FreeHeat> scan(Value const& truth, unsigned seed) {
  Asked const asked(tests::measured(truth, with_step()), seed);
  return scan_for_free_heat(asked.estimation, asked.estimation.fit(asked.estimation.prior_mean()));
}

TEST(FreeHeat, SitesAreAllNodesOnce) {
  auto const machine = Machine::build(v450());
  std::set<int> nodes;
  for (auto const& site : heat_sites(machine))
    for (int i = 0; i < site.nodes; ++i) EXPECT_TRUE(nodes.insert(site.first_node + i).second) << site.body;
  std::size_t cells = 0;
  for (auto const& body : machine.geometry) cells += body.cells.size();
  EXPECT_EQ(nodes.size(), cells);
}

TEST(FreeHeat, OfAStepIsFoundWhereAndWhenItEnters) {
  auto const found = scan(tests::with_table(v450(), R"(
    [[heat]]
    name = "hidden"
    at = "column_rear"
    power = "30 W"
    while_on = "hidden.on")"),
                          3);
  auto const& best = found.front();
  EXPECT_EQ(best.site.body, "column_rear");
  EXPECT_GT(best.gain, 10.0);
  EXPECT_GT(best.gain, found[1].gain + 2.0);
  double watts = 0.0, before = 0.0, count = 0.0, count_before = 0.0;
  for (Eigen::Index k = 0; k < best.knots[0].size(); ++k) {
    if (best.knots[0][k] > 5500.0) {
      watts += best.heat[0][k];
      ++count;
    } else if (best.knots[0][k] < 3000.0) {
      before += best.heat[0][k];
      ++count_before;
    }
  }
  EXPECT_NEAR(watts / count, 30.0, 6.0);
  EXPECT_NEAR(before / count_before, 0.0, 6.0);
}

/// What an input switches on is there at once, not half an hour later.
TEST(FreeHeat, JumpsWithAnInput) {
  auto const found = scan(tests::with_table(v450(), R"(
    [[heat]]
    name = "hidden"
    at = "column_rear"
    power = "60 W"
    while_on = "hidden.on")"),
                          3);
  auto const& best = found.front();
  Eigen::Index before = 0;
  while (before + 2 < best.knots[0].size() && best.knots[0][before] < 4000.0 - 60.0) ++before;
  EXPECT_NEAR(best.knots[0][before], 4000.0, 60.0);  // recorded once a minute
  EXPECT_NEAR(best.knots[0][before + 1] - best.knots[0][before], 60.0, 1e-9);
  EXPECT_GT(best.heat[0][before + 1] - best.heat[0][before], 30.0);
}

/// And so where (t + 60 s) - t is a little more than 60 s.
TEST(FreeHeat, JumpsWithAnInputWhateverIsRoundedOff) {
  constexpr double jump = 4080.1;
  ASSERT_GT((jump + 60.0) - jump, 60.0);
  auto experiment = tests::two_speeds();
  experiment.inputs.push_back({"hidden.on", {{jump, "0 %"}, {experiment.duration - jump, "100 %"}}});
  auto run = tests::measured(tests::with_table(v450(), R"(
    [[heat]]
    name = "hidden"
    at = "column_rear"
    power = "60 W"
    while_on = "hidden.on")"),
                             experiment);
  run.course = std::make_shared<scenarios::ExperimentCourse const>(experiment, Machine::build(v450()).limits);
  run.changes.clear();
  Asked const asked(std::move(run), 3);
  auto const& estimation = asked.estimation;
  auto const best = scan_for_free_heat(estimation, estimation.fit(estimation.prior_mean())).front();
  EXPECT_EQ(best.site.body, "column_rear");
  auto const& knots = best.knots[0];
  auto const before = std::find(knots.begin(), knots.end(), jump) - knots.begin();
  ASSERT_LT(before + 1, knots.size());
  EXPECT_GT(best.heat[0][before + 1] - best.heat[0][before], 30.0);
}

/// Straight lines between knots, told apart by whether the spindle turns: 80 min, 50 min, then 50 min of rest, 1 h.
TEST(FreeHeat, HasAMeanForEachRegime) {
  auto const run = tests::measured(v450(), tests::two_speeds());
  FreeHeat heat;
  heat.knots = {Eigen::Vector4d(0.0, 7800.0, 10800.0, 14400.0)};
  heat.heat = {Eigen::Vector4d(10.0, 10.0, 30.0, 0.0)};
  auto const [moving, standing] = mean_heat(heat, 0, bin(run, 300.0));
  EXPECT_NEAR(standing, 20.0, 1e-9);
  EXPECT_NEAR(moving, (7800.0 * 10.0 + 3600.0 * 15.0) / 11400.0, 1e-9);
}

TEST(FreeHeat, ThatIsNotThereGainsNothing) {
  for (unsigned const seed : {1U, 2U})
    for (auto const& site : scan(v450(), seed)) {
      EXPECT_LT(site.gain, 0.0) << site.site.body;
    }
}

/// 150 W that are always there, and nothing calibrated: the other numbers give way within the one linearisation.
TEST(FreeHeat, IsFoundAboutTheNumbersOfTheFile) {
  Asked const asked(tests::measured(tests::with_table(v450(), R"(
    [[heat]]
    name = "hidden"
    at = "motor"
    power = "150 W")"),
                                    tests::two_speeds()),
                    5);
  auto const& estimation = asked.estimation;
  auto const best = scan_for_free_heat(estimation, estimation.fit(estimation.prior_mean(), 0)).front();
  EXPECT_EQ(best.site.body, "motor");
  auto const [mean, error] = best.mean_of_all();
  EXPECT_NEAR(mean, 150.0, 30.0);
  EXPECT_NEAR(mean, 150.0, 2.0 * error);
  EXPECT_LT(error, 30.0);
}

/// 60 W while the machine is on and 40 W more while the spindle turns: what both bring, as surely as both are known.
TEST(FreeHeat, OfTwoEffectsIsWhatTheyBringTogether) {
  Asked const asked(tests::measured(tests::with_table(v450(), R"(
    [[heat]]
    name = "pump"
    at = "motor"
    power = "60 W"
    [[heat]]
    name = "drive"
    at = "motor"
    power = "40 W"
    while_on = "spindle.running")"),
                                    tests::two_speeds()),
                    5);
  std::vector<Hypothesis> both;
  for (auto const& hypothesis : hypotheses(v450(), Machine::build(v450())))
    if (hypothesis.label() == "heat at motor" && hypothesis.keys.back().second != "coolant.on")
      both.push_back(hypothesis);
  ASSERT_EQ(both.size(), 2);
  auto const estimation = asked.estimation.with(both);
  auto const fit = estimation.fit(estimation.prior_mean());
  auto const heat = heat_of_effects(estimation, fit, "motor");
  auto const [moving, standing] = mean_heat(heat, 0, asked.data[0]);
  double const error = heat.standard_error(0).maxCoeff();
  EXPECT_NEAR(moving, 100.0, 3.0 * error);
  EXPECT_NEAR(standing, 60.0, 3.0 * error);
  EXPECT_NEAR(heat.mean_of_all().mean, moving - (moving - standing) * 50.0 / 240.0, 2.0);  // 50 min of 4 h it stands
  Eigen::Vector2d const each = fit.covariance.bottomRightCorner(2, 2).diagonal().cwiseSqrt() * both[0].largest;
  EXPECT_GT(error, 0.3 * each.maxCoeff());
  EXPECT_LT(error, each.sum());
  EXPECT_EQ(heat_of_effects(estimation, fit, "bed").heat[0].cwiseAbs().maxCoeff(), 0.0);
}

/// A column radiates to a test bar, and gets what the bar loses, but is a hundred times as heavy; heat has one place.
TEST(FreeHeat, OfAnEffectBetweenTwoBodiesIsToldOfTheLighterOne) {
  Asked const asked(tests::measured(v450(), tests::two_speeds()), 5);
  std::vector<Hypothesis> both;
  for (auto const& hypothesis : hypotheses(v450(), Machine::build(v450())))
    if (hypothesis.label() == "radiation at column_front to test_bar" ||
        (hypothesis.label() == "heat at motor" && hypothesis.keys.back().second == "machine.on"))
      both.push_back(hypothesis);
  ASSERT_EQ(both.size(), 2);
  if (both[0].body == "motor") std::swap(both[0], both[1]);
  ASSERT_EQ(both[0].body, "column_front");
  auto const estimation = asked.estimation.with(both);
  Fit fit;
  fit.x = estimation.prior_mean();
  fit.x.tail(2) = Eigen::Vector2d(0.5, 0.5);
  EXPECT_EQ(warmed_most(estimation, fit, 0), "test_bar");
  EXPECT_EQ(warmed_most(estimation, fit, 1), "motor");
}

/// 30 W in the run that turns, none in the one that stands.
TEST(FreeHeat, IsToldBySpeedOfRunsAtOneSpeed) {
  auto const run_at = [](std::string const& speed) {
    return tests::measured(v450(), tests::experiment("duration = \"2 h\"\nambient.daily_cycle.amplitude = \"3 K\"\n"
                                                     "[spindle]\nblocks = [{duration = \"2 h\", speed = \"" +
                                                     speed + "\"}]"));
  };
  auto const turning = run_at("4000 rpm"), standing = run_at("0 rpm");
  std::vector<BinnedRun> const data = {bin(turning, 60.0), bin(standing, 60.0)};
  FreeHeat heat;
  heat.knots = {Eigen::Vector2d(0.0, 7200.0), Eigen::Vector2d(0.0, 7200.0)};
  heat.heat = {Eigen::Vector2d(30.0, 30.0), Eigen::Vector2d(0.0, 0.0)};
  heat.spread = Eigen::Vector4d::Constant(1.0);
  auto const [mean, swing] = heat_by_speed(heat, data);
  std::map<std::string, Watts> const means(mean.begin(), mean.end());
  EXPECT_EQ(means.size(), 2U);
  EXPECT_NEAR(means.at("4000 rpm").mean, 30.0, 1e-9);
  EXPECT_NEAR(means.at("idle").mean, 0.0, 1e-9);
}

/// A watt more every hour: its means in the hours of each speed, and D/√12 about each of these, D its hours.
TEST(FreeHeat, IsToldBySpeed) {
  auto const run = tests::measured(v450(), tests::two_speeds());
  std::vector<BinnedRun> const data = {bin(run, 60.0)};
  FreeHeat rising;
  rising.knots = {Eigen::Vector3d(0.0, 7200.0, 14400.0)};
  rising.heat = {Eigen::Vector3d(0.0, 2.0, 4.0)};
  rising.spread = Eigen::Vector3d(0.0, 0.5, 1.0);  // known to a quarter, at all times the same
  auto const [mean, swing] = heat_by_speed(rising, data);
  std::map<std::string, Watts> const means(mean.begin(), mean.end());
  EXPECT_NEAR(means.at("5000 rpm").mean, 40.0 / 60.0, 0.02);
  EXPECT_NEAR(means.at("2500 rpm").mean, 105.0 / 60.0, 0.02);
  EXPECT_NEAR(means.at("idle").mean, 155.0 / 60.0, 0.02);
  EXPECT_NEAR(means.at("4000 rpm").mean, 210.0 / 60.0, 0.02);
  double const square = (std::pow(80.0, 3) + 2.0 * std::pow(50.0, 3) + std::pow(60.0, 3)) / (12.0 * 240.0 * 3600.0);
  EXPECT_NEAR(swing, std::sqrt(square), 0.02 * std::sqrt(square));
  for (auto const& [name, watts] : means)
    EXPECT_NEAR(watts.standard_error, std::hypot(1.2 * 0.25, 0.1) * watts.mean, 1e-12) << name;
}

/// Three hours of 30 W and one of 90 W that are known to 4 W each: to √(3² + 1²) W in the mean of these weights, to 4 W
/// if both err by the same, by no more than 2 W if what one lacks the other has.
TEST(FreeHeat, HasAMeanThatIsKnownAsWellAsItsRunsTogether) {
  FreeHeat heat;
  heat.knots = {Eigen::Vector2d(0.0, 10800.0), Eigen::Vector2d(0.0, 3600.0)};
  heat.heat = {Eigen::Vector2d(20.0, 40.0), Eigen::Vector2d(90.0, 90.0)};
  auto const error_for = [&](Eigen::MatrixXd const& spread) {
    heat.spread = spread;
    EXPECT_DOUBLE_EQ(heat.standard_error(0)[0], 4.0);
    EXPECT_DOUBLE_EQ(heat.standard_error(1)[1], 4.0);
    return heat.mean_of_all().standard_error;
  };
  auto const whole = [](double of_fit) { return std::hypot(1.2 * of_fit, 4.5); };  // finding.h
  Eigen::MatrixXd each = Eigen::MatrixXd::Zero(4, 2);
  each << 4.0, 0.0, 4.0, 0.0, 0.0, 4.0, 0.0, 4.0;
  EXPECT_DOUBLE_EQ(error_for(each), whole(std::sqrt(10.0)));
  EXPECT_DOUBLE_EQ(error_for(Eigen::Vector4d(4.0, 4.0, 4.0, 4.0)), whole(4.0));
  EXPECT_DOUBLE_EQ(error_for(Eigen::Vector4d(4.0, 4.0, -4.0, -4.0)), whole(2.0));
  EXPECT_DOUBLE_EQ(heat.mean_of_all().mean, 45.0);
}

}  // namespace
}  // namespace thermotwin::twin
