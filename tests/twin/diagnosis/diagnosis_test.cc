#include "twin/diagnosis/diagnosis.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <set>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/diagnosis/birge_ratio.h"
#include "twin/diagnosis/diagnosis_json.h"
#include "twin/diagnosis/separation.h"
#include "twin/sensitivity.h"

namespace thermotwin::twin {
namespace {

Diagnosis diagnosed(std::string const& hidden, DiagnosisOptions options = {}) {
  auto run = tests::measured(tests::with_table(tests::v450(), hidden), tests::two_speeds());
  tests::add_noise(run, 0.02, 0.05e-6, 7);
  options.least_share = 0.0;
  return diagnose(tests::v450(), {bin(run, 300.0)}, options);
}

std::string const growth = R"(
  [[centrifugal_growth]]
  name = "hidden"
  displacement = "E_Z"
  growth = "-12 um")";

std::string const left_on = R"(
  [[compensation]]
  name = "hidden"
  displacement = "E_Z"
  at = "rear_ring"
  gain = "2 um/K")";

TEST(Diagnosis, NamesWhatMovesADisplacement) {
  auto const diagnosis = diagnosed(growth);
  EXPECT_EQ(name_of(diagnosis.verdict), "effect");
  ASSERT_EQ(diagnosis.effects.size(), 1);
  EXPECT_EQ(diagnosis.effects[0].effect->name, "centrifugal_growth");
}

/// Ten times as much as the file has there: no number is as wrong as that.
TEST(Diagnosis, NamesMoreOfWhatStandsInTheFile) {
  ASSERT_EQ(find_number(tests::v450(), "motor_loss.stator.eddy").value, 30.0);
  auto const diagnosis = diagnosed(R"(
    [[motor_loss]]
    name = "hidden"
    at = "motor"
    eddy = "300 W")");
  EXPECT_EQ(name_of(diagnosis.verdict), "effect");
  ASSERT_EQ(diagnosis.explanations.size(), 1);
  auto const& finding = diagnosis.explanations[0].alternatives[0];
  EXPECT_EQ(finding.hypothesis.label(), "motor_loss at motor");
  EXPECT_TRUE(finding.hypothesis.stands);
  EXPECT_NEAR(finding.amplitude, 300.0, 2.0 * finding.standard_error);
}

/// The same growth where more evidence is asked for than there is: not named, but told with an experiment that would
/// show it; and where less than half of that is there, not even told. Twice the threshold is asked, since without it
/// the law of a bearing leaves the file.
TEST(Diagnosis, SuspectsWhatIsNotEvidentEnough) {
  double const evidence = diagnosed(growth).explanations.at(0).alternatives[0].strength;
  auto const asking = [&](double threshold) {
    DiagnosisOptions options;
    options.threshold = threshold;
    DiagnosisReport report;
    report.diagnosis = diagnosed(growth, options);
    return report;
  };
  auto const report = asking(0.75 * evidence);
  auto const& diagnosis = report.diagnosis;
  EXPECT_EQ(name_of(diagnosis.verdict), "nothing");
  EXPECT_TRUE(diagnosis.effects.empty());
  ASSERT_TRUE(diagnosis.suspicion);
  auto const& suspect = diagnosis.suspicion->explanation.alternatives.at(0);
  EXPECT_EQ(suspect.hypothesis.effect->name, "centrifugal_growth");
  EXPECT_NEAR(suspect.amplitude, -12e-6, 1.5 * suspect.standard_error);
  EXPECT_NEAR(diagnosis.suspicion->asked, 1.5 * evidence, 1e-9 * evidence);
  ASSERT_FALSE(diagnosis.proposals.empty());
  EXPECT_GT(diagnosis.proposals[0].distance, wanted_distance);
  EXPECT_THAT(report_text(report),
              testing::AllOf(testing::HasSubstr("one is suspected"), testing::HasSubstr("show it")));
  EXPECT_THAT(report_json(report), testing::HasSubstr("\"suspicion\""));
  auto const deaf = asking(1.25 * evidence);
  EXPECT_EQ(name_of(deaf.diagnosis.verdict), "nothing");
  EXPECT_FALSE(deaf.diagnosis.suspicion);
  EXPECT_TRUE(deaf.diagnosis.proposals.empty());
  EXPECT_THAT(report_text(deaf), testing::Not(testing::HasSubstr("Suspected")));
}

/// What the program named before they had numbers of their own were bearings that drag more, and seals.
TEST(Diagnosis, AGreaseOfAnotherLawIsNoEffect) {
  for (auto const& [key, text] : {std::pair{"viscosity_temperature", "950 K"}, {"viscous_exponent", "0.4"}}) {
    Value truth = tests::v450();
    for (std::string const bearing : {"front", "rear"}) set_parameter(truth, "bearing." + bearing + "." + key, text);
    auto run = tests::measured(truth, tests::experiment(R"(
      duration = "20 h"
      ambient.mean = "22 degC"
      ambient.daily_cycle.amplitude = "1.5 K"
      [spindle]
      blocks = [{duration = "3 h", speed = "5000 rpm"}, {duration = "2 h", speed = "1500 rpm"},
                {duration = "2 h", speed = "0 rpm"}, {duration = "4 h", speed = "6000 rpm"},
                {duration = "3 h", speed = "3000 rpm"}, {duration = "2 h", speed = "0 rpm"},
                {duration = "2 h", speed = "4000 rpm"}])"));
    tests::add_noise(run, 0.02, 0.05e-6, 7);
    EXPECT_TRUE(diagnose(tests::v450(), {bin(run, 300.0)}, {}).effects.empty()) << key;
  }
}

/// In a room where nothing happens a sensor that lags reads a smooth version of a noisy record.
TEST(Diagnosis, TakesNoiseInTheRecordOfTheRoomForNoLagOfItsSensor) {
  Machine const machine = Machine::build(tests::v450());
  auto dataset = run(machine, tests::experiment(R"(
    duration = "24 h"
    ambient.mean = "22 degC"
    ambient.daily_cycle.amplitude = "1.5 K"
    [spindle]
    blocks = [{duration = "12 h", speed = "3000 rpm"}])"),
                     {})
                     .dataset;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (auto& input : dataset.inputs)
    if (input.name == "ambient.temperature")
      for (double& value : input.values) value += 0.1 * normal(random);
  auto measured = measured_run(dataset, machine, "quiet");
  tests::add_noise(measured, 0.02, 0.05e-6, 7);
  auto const diagnosis = diagnose(tests::v450(), {bin(measured, 300.0)}, {});
  EXPECT_EQ(name_of(diagnosis.verdict), "nothing");
}

/// 80 W in the motor on both days: one effect. Gone on the day that was held out, they were something else.
TEST(Diagnosis, LetsARunHeldOutSpeakAgainstWhatItFound) {
  auto const on_a_day = [](Value const& truth, unsigned seed, scenarios::Experiment const& experiment) {
    auto run = tests::measured(truth, experiment);
    tests::add_noise(run, 0.02, 0.05e-6, seed);
    return run;
  };
  Value const hot = tests::with_table(tests::v450(), R"(
    [[heat]]
    name = "hidden"
    at = "motor"
    power = "80 W")");
  auto const fitted = on_a_day(hot, 7, tests::two_speeds());
  auto const other = tests::two_speeds("50 min", "80 min", "1 h", "50 min");
  auto const same = on_a_day(hot, 8, other), cold = on_a_day(tests::v450(), 9, other);
  auto const with = [&](MeasuredRun const& unseen) {
    return diagnose(tests::v450(), {bin(fitted, 300.0)}, {}, {bin(unseen, 300.0)});
  };
  auto const confirmed = with(same);
  EXPECT_NE(name_of(confirmed.verdict), "none_known");
  EXPECT_EQ(confirmed.effects.size(), 1);
  ASSERT_TRUE(confirmed.vote);
  EXPECT_GT(*confirmed.vote, 0.0);
  DiagnosisReport report;
  report.diagnosis = with(cold);
  EXPECT_EQ(name_of(report.diagnosis.verdict), "none_known");
  ASSERT_TRUE(report.diagnosis.vote);
  EXPECT_LT(*report.diagnosis.vote, 0.0);
  ASSERT_TRUE(report.diagnosis.unknown_heat);
  EXPECT_EQ(report.diagnosis.unknown_heat->site.body, "motor");
  EXPECT_NEAR(report.diagnosis.unknown_heat->mean_of_all().mean, 80.0, 20.0);
  EXPECT_THAT(report_text(report), testing::HasSubstr("The runs held out speak against it"));
}

/// A thermometer that was mounted after the runs that were fitted has its say, too.
TEST(Diagnosis, ARunHeldOutMayHaveAChannelMore) {
  Value const hot = tests::with_table(tests::v450(), R"(
    [[heat]]
    name = "hidden"
    at = "motor"
    power = "80 W")");
  auto fitted = tests::measured(hot, tests::two_speeds());
  auto unseen = tests::measured(hot, tests::two_speeds("50 min", "80 min", "1 h", "50 min"));
  tests::add_noise(fitted, 0.02, 0.05e-6, 7);
  tests::add_noise(unseen, 0.02, 0.05e-6, 8);
  std::erase_if(fitted.channels, [](auto const& channel) { return channel.name == "T8"; });
  auto const diagnosis = diagnose(tests::v450(), {bin(fitted, 300.0)}, {}, {bin(unseen, 300.0)});
  EXPECT_EQ(diagnosis.effects.size(), 1);
  ASSERT_TRUE(diagnosis.vote);
  EXPECT_GT(*diagnosis.vote, 10.0);
}

/// A cycle of the room's air warms no one body: refuted, it leaves no body to tell the watts of.
TEST(Diagnosis, KnowsNoneWhereARunHeldOutSpeaksAgainstTheAir) {
  auto const on_a_day = [](std::string const& sine, unsigned seed) {
    auto run = tests::measured(tests::with_table(tests::v450(), R"(
      [[ambient_cycle]]
      name = "hidden"
      sine = ")" + sine + "\""),
                               tests::experiment(R"(
      duration = "24 h"
      ambient.mean = "22 degC"
      [spindle]
      blocks = [{duration = "6 h", speed = "3000 rpm"}, {duration = "18 h", speed = "0 rpm"}])"));
    tests::add_noise(run, 0.02, 0.05e-6, seed);
    return run;
  };
  auto const fitted = on_a_day("0.6 K", 7), other = on_a_day("-3 K", 8);
  auto const diagnosis = diagnose(tests::v450(), {bin(fitted, 300.0)}, {}, {bin(other, 300.0)});
  EXPECT_EQ(name_of(diagnosis.verdict), "none_known");
  ASSERT_FALSE(diagnosis.effects.empty());
  EXPECT_EQ(diagnosis.effects[0].effect->name, "ambient_cycle");
  EXPECT_TRUE(diagnosis.is_refuted());
}

/// Two effects may act on one displacement.
TEST(Diagnosis, NamesBothOfTwoThatMoveADisplacement) {
  auto const diagnosis = diagnosed(growth + left_on);
  EXPECT_EQ(name_of(diagnosis.verdict), "effect");
  ASSERT_EQ(diagnosis.effects.size(), 2);
  std::set<std::string> names;
  for (auto const& effect : diagnosis.effects) names.insert(effect.effect->name);
  EXPECT_EQ(names, (std::set<std::string>{"centrifugal_growth", "compensation"}));
}

/// Where the growth is not in the catalogue, something else moves that way: by more than it plausibly could.
TEST(Diagnosis, KnowsNoneWhereWhatStandsInWouldHaveToBeLargerThanIsPlausible) {
  auto run = tests::measured(tests::with_table(tests::v450(), growth), tests::two_speeds());
  tests::add_noise(run, 0.02, 0.05e-6, 7);
  DiagnosisOptions options;
  options.without = {"centrifugal_growth"};
  auto const diagnosis = diagnose(tests::v450(), {bin(run, 300.0)}, options);
  EXPECT_EQ(name_of(diagnosis.verdict), "none_known");
  ASSERT_FALSE(diagnosis.effects.empty());
  EXPECT_TRUE(std::any_of(diagnosis.explanations.begin(), diagnosis.explanations.end(),
                          [](auto const& explanation) { return explanation.alternatives[0].is_at_end(); }));
}

/// The air at the machine swings by 2 K, of which its record knows nothing: all bodies take part, the bed most.
TEST(Diagnosis, KnowsNoneWhereTheRoomIsNotWhatItsRecordSays) {
  auto const experiment = tests::experiment(R"(
    duration = "24 h"
    ambient.mean = "22 degC"
    [spindle]
    blocks = [{duration = "6 h", speed = "3000 rpm"}, {duration = "18 h", speed = "0 rpm"}])");
  auto run = tests::measured(tests::with_table(tests::v450(), R"(
    [[ambient_cycle]]
    name = "hidden"
    sine = "2 K")"),
                             experiment);
  tests::add_noise(run, 0.02, 0.05e-6, 7);
  DiagnosisOptions options;
  options.without = {"ambient_cycle"};
  auto const diagnosis = diagnose(tests::v450(), {bin(run, 300.0)}, options);
  EXPECT_EQ(name_of(diagnosis.verdict), "none_known");
  ASSERT_TRUE(diagnosis.unknown_heat);
  auto const& air = *diagnosis.unknown_heat;
  EXPECT_TRUE(air.site.is_air());
  EXPECT_EQ(air.site.body, "bed");
  double const per_kelvin = air.per_kelvin.at("bed");
  auto const& knots = air.knots[0];
  double const from = experiment.start_time_of_day;
  Eigen::VectorXd const truth = (2.0 * std::numbers::pi / 86400.0 * (from + knots.array())).sin() * 2.0;
  Eigen::VectorXd const found = air.heat[0] / per_kelvin;
  double const error = std::sqrt((found - truth).squaredNorm() / double(knots.size()));
  EXPECT_LT(error, 0.4);
  Eigen::VectorXd const in_errors = ((found - truth) * per_kelvin).cwiseQuotient(air.standard_error(0));
  EXPECT_LT(in_errors.squaredNorm() / double(knots.size()), 4.0);
  auto const [mean, mean_error] = air.mean_of_all();  // of a whole day
  EXPECT_LT(std::abs(mean), 2.0 * mean_error);
  EXPECT_LT(mean_error, 0.3 * per_kelvin);
  DiagnosisReport report;
  report.diagnosis = diagnosis;
  EXPECT_THAT(report_text(report), testing::HasSubstr("the air at the machine"));
}

/// Of a machine with 120 W in its head that follow a clock of their own: all of it for 3.2 of 12 h, a share else.
Diagnosis diagnosed_by_the_clock(std::string const& else_on) {
  auto experiment = tests::experiment(R"(
    duration = "12 h"
    ambient.mean = "22 degC"
    [spindle]
    blocks = [{duration = "4 h", speed = "3000 rpm"}, {duration = "3 h", speed = "0 rpm"},
              {duration = "5 h", speed = "5000 rpm"}])");
  experiment.inputs.push_back({"hidden.on", {}});
  double const hours[] = {1.0, 1.5, 2.3, 0.7, 3.0, 1.0, 2.5};
  for (std::size_t i = 0; i < std::size(hours); ++i)
    experiment.inputs.back().blocks.push_back({3600.0 * hours[i], i % 2 == 0 ? else_on : "100 %"});
  Machine const truth = Machine::build(tests::with_table(tests::v450(), R"(
    [[heat]]
    name = "hidden"
    at = "head_front"
    power = "120 W"
    while_on = "hidden.on")"));
  auto dataset = run(truth, experiment, {}).dataset;
  std::erase_if(dataset.inputs, [](auto const& input) { return input.name == "hidden.on"; });
  auto measured = measured_run(dataset, Machine::build(tests::v450()), "own clock");
  tests::add_noise(measured, 0.02, 0.05e-6, 7);
  return diagnose(tests::v450(), {bin(measured, 300.0)}, {});
}

/// Heat that comes and goes by a clock of its own: no effect has that course, and none stands in for it.
TEST(Diagnosis, KnowsNoneWhereHeatFollowsAClockOfItsOwn) {
  auto const diagnosis = diagnosed_by_the_clock("0 %");
  EXPECT_EQ(name_of(diagnosis.verdict), "none_known");
  EXPECT_FALSE(diagnosis.heat_beside);
  ASSERT_TRUE(diagnosis.unknown_heat);
  EXPECT_EQ(diagnosis.unknown_heat->site.body, "head_front");
  EXPECT_GT(diagnosis.unknown_heat_by_speed.swing, 25.0);  // of 120 W that are on for 3.2 of 12 h: 53 W
  EXPECT_EQ(diagnosis.where[0].first, "head_front");
}

/// Heat that is there whenever the machine is on, and swings a little, is what the catalogue has, and so it is told.
TEST(Diagnosis, NamesHeatThatIsNotQuiteConstantAndTellsWhatIsLeft) {
  auto const diagnosis = diagnosed_by_the_clock("86 %");
  EXPECT_EQ(name_of(diagnosis.verdict), "effect");
  ASSERT_EQ(diagnosis.effects.size(), 1);
  EXPECT_EQ(diagnosis.effects[0].label(), "heat at head_front");
  EXPECT_TRUE(diagnosis.heat_beside);
  DiagnosisReport report;
  report.diagnosis = diagnosis;
  EXPECT_THAT(report_text(report), testing::HasSubstr("Heat of free course is left, "));
}

/// A bearing that rubs four times as much as its file says is no effect, but is told.
TEST(Diagnosis, TellsNumbersThatAreFarFromTheFile) {
  Value truth = tests::v450();
  set_parameter(truth, "bearing.front.grease_factor", "2.2");
  auto run = tests::measured(truth, tests::two_speeds());
  tests::add_noise(run, 0.02, 0.05e-6, 7);
  DiagnosisReport report;
  report.diagnosis = diagnose(tests::v450(), {bin(run, 300.0)}, {});
  EXPECT_EQ(name_of(report.diagnosis.verdict), "nothing");
  EXPECT_THAT(report_text(report), testing::HasSubstr("of their prior deviations: bearing.front.grease_factor = 2."));
  set_parameter(truth, "bearing.front.grease_factor", "0.55");
  auto same = tests::measured(truth, tests::two_speeds());
  tests::add_noise(same, 0.02, 0.05e-6, 7);
  report.diagnosis = diagnose(tests::v450(), {bin(same, 300.0)}, {});
  EXPECT_THAT(report_text(report), testing::Not(testing::HasSubstr("prior deviations")));
}

/// Without effects, what any would need; four times as much where a number of the file cannot be right.
TEST(EffectSearch, AsksMoreWhereANumberHasLeftTheFile) {
  Value const document = tests::v450();
  DiagnosisOptions const options;
  auto const asked = [&](std::string const& grease_factor) {
    Value truth = document;
    set_parameter(truth, "bearing.front.grease_factor", grease_factor);
    auto run = tests::measured(truth, tests::two_speeds());
    tests::add_noise(run, 0.02, 0.05e-6, 7);
    std::vector<BinnedRun> const runs = {bin(run, 300.0)};
    return EffectSearch(document, runs, {}, options).evident_beside();
  };
  EXPECT_EQ(asked("0.55"), options.threshold) << "as the file says";
  EXPECT_EQ(asked("2.2"), strictest * options.threshold);
}

/// Something else moves that way, and is found in its place; but not what was taken back.
TEST(EffectSearch, TriesNoMoreWhatWasTakenBack) {
  auto run = tests::measured(tests::with_table(tests::v450(), growth), tests::two_speeds());
  tests::add_noise(run, 0.02, 0.05e-6, 7);
  std::vector<BinnedRun> const runs = {bin(run, 300.0)};
  DiagnosisOptions const options;
  Value const document = tests::v450();
  EffectSearch search(document, runs, with_those_of_some_size(hypotheses(document, Machine::build(document))), options);
  double const calibrated = search.fit().evidence;
  search();
  ASSERT_EQ(search.explanations().size(), 1);
  auto const label = search.estimation().effects()[0].label();
  EXPECT_EQ(label, "centrifugal_growth at E_Z");
  search.reject(0);
  EXPECT_TRUE(search.explanations().empty());
  EXPECT_TRUE(search.estimation().effects().empty());
  EXPECT_NEAR(search.fit().evidence, calibrated, 1.0);
  search();
  EXPECT_FALSE(search.explanations().empty());
  for (auto const& effect : search.estimation().effects()) EXPECT_NE(effect.label(), label);
}

}  // namespace
}  // namespace thermotwin::twin
