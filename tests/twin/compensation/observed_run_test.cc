#include "twin/compensation/observed_run.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/course.h"
#include "tests/scenarios/refusal.h"
#include "tests/twin/compensation/closed_loop.h"
#include "twin/diagnosis/measured_run.h"
#include "twin/study/study_runs.h"

namespace thermotwin::twin {
namespace {

using testing::HasSubstr;
using thermotwin::tests::refusal;

Machine g200() { return Machine::read(machine_file("g200")); }

/// A course that begins later than another one, and may lack one of its channels.
class LaterCourse : public thermal::Course {
 public:
  LaterCourse(thermal::Course const& other, double later, std::string const& lacks = "")
      : other_(other), later_(later), channels_(other.channels()) {
    for (auto& channel : channels_)
      if (channel.name == lacks) channel.name = lacks + "_once";
  }
  [[nodiscard]] std::vector<thermal::InputChannel> const& channels() const override { return channels_; }
  void evaluate(double t, std::span<double> values) const override { other_.evaluate(t - later_, values); }
  [[nodiscard]] double next_jump(double t) const override { return other_.next_jump(t - later_) + later_; }

 private:
  thermal::Course const& other_;
  double later_;
  std::vector<thermal::InputChannel> channels_;
};

class ObservedRun : public testing::Test {
 protected:
  scenarios::Experiment const experiment_ =
      read_experiment(read_toml(experiment_file("duty_003")), experiment_file("duty_003"));
  scenarios::ExperimentCourse const course_{experiment_, g200().limits};
};

/// Rows four longest steps apart: were the inputs told at the rows only, the speed of the last would hold until the
/// next, and the error be another by half a micrometre.
TEST_F(ObservedRun, WithoutSensorsIsTheSimulation) {
  auto const shown = tests::simulated("duty_003", 240.0);
  TwinObserver const observer(g200(), "E_X", {.longest_step = 10.0}, std::vector<std::string>());
  Eigen::VectorXd const error = observed_error(observer, shown, course_, 0.0);
  auto const* truth = find_channel(shown.truth_displacements, "E_X");
  ASSERT_NE(truth, nullptr);
  EXPECT_GT(truth->values.cwiseAbs().maxCoeff(), 20.0);
  EXPECT_LT((error - truth->values).cwiseAbs().maxCoeff(), 0.1);
  EXPECT_EQ(observed_error(observer, shown, LaterCourse(course_, 512.0), 512.0), error);
}

/// What the sensors say counts at the rows, and there alone.
TEST_F(ObservedRun, TellsTheSensorsRowByRow) {
  auto const shown = tests::simulated("duty_003", 60.0, {{"bearing.front.grease_factor", "0.55"}});
  std::vector<std::string> const sensors{"T10", "T2"};
  TwinObserver observer(g200(), "E_X", {.longest_step = 60.0}, sensors);
  Eigen::VectorXd const error = observed_error(observer, shown, course_, 0.0);
  for (Eigen::Index row = 0; row < 40; ++row) {
    std::vector<double> values;
    for (auto const& input : observer.inputs())
      values.push_back(find_channel(input.sensor ? shown.readings : shown.inputs, input.name)->values[row]);
    ASSERT_NEAR(observer.error(shown.time_s[row], values), error[row], 1e-9) << row;
  }
}

/// What was recorded of the inputs before the first reading, and how warm the machine was when that began, is known.
TEST_F(ObservedRun, BeginsWhereTheTwinIsAfterARunsPast) {
  auto past = experiment_;
  past.initial_temperature = 291.15;
  past.sampling = 60.0;
  auto const shown = run(g200(), past, {}).dataset;
  auto measured = measured_run(shown, g200(), "measured");
  measured.initial_temperature = past.initial_temperature;
  Eigen::Index const first = 120;
  for (auto& channel : measured.channels) channel.values.head(first).setConstant(NAN);
  auto const truth = find_channel(shown.truth_displacements, "E_X")->values;
  Eigen::VectorXd const since = truth.tail(truth.size() - first).array() - truth[first];
  TwinObserver const observer(g200(), "E_X", {}, std::vector<std::string>{"T10", "T2"});
  auto const missed = [&](Eigen::VectorXd const& said) { return (said - since).cwiseAbs().maxCoeff(); };
  EXPECT_LT(missed(observed_error(observer, measured, std::nullopt)), 0.2);
  auto const without_past = dataset_of(measured, std::nullopt);
  EXPECT_GT(missed(observed_error(observer, without_past, *measured.course, measured.time[first])), 0.5);
}

/// The readings of its own rows are told, at their times: a mean over half an hour is of a quarter later than its own.
TEST_F(ObservedRun, OfMeansIsTheMeanOfWhatItSaysAtTheRows) {
  auto const shown = tests::simulated("duty_003", 60.0, {{"bearing.front.grease_factor", "0.55"}});
  auto const run = measured_run(shown, g200(), "measured");
  TwinObserver const observer(g200(), "E_X", {.longest_step = 60.0}, std::vector<std::string>{"T10", "T2"});
  Eigen::VectorXd const rows = observed_error(observer, run, std::nullopt),
                        means = observed_error(observer, run, 1800.0);
  EXPECT_LT((rows - observed_error(observer, shown, *run.course, 0.0)).cwiseAbs().maxCoeff(), 1e-9);
  ASSERT_EQ(means.size(), (rows.size() + 29) / 30);
  for (Eigen::Index k = 0; k < means.size(); ++k) {
    auto const stretch = rows.segment(30 * k, std::min<Eigen::Index>(30, rows.size() - 30 * k));
    EXPECT_NEAR(means[k], stretch.mean(), 1e-9) << k;
  }
}

TEST_F(ObservedRun, NamesTheInputThatARunLacks) {
  auto const shown = tests::simulated("duty_003", 600.0);
  TwinObserver const observer(g200(), "E_X");
  EXPECT_THAT(refusal([&] {
                static_cast<void>(observed_error(observer, shown, LaterCourse(course_, 0.0, "spindle.speed"), 0.0));
              }),
              HasSubstr("it needs the input 'spindle.speed', which a run does not give; did you mean "
                        "'spindle.speed_once'?"));
}

/// 0.1 K in each row, or in each step of the integration where rows are farther apart.
TEST(ObserverChoices, TakeAReadingToErrByATenthOfAKelvin) {
  for (auto const& [interval, elapsed] : {std::pair{10.0, 10.0}, {30.0, 30.0}, {180.0, 30.0}, {INFINITY, 30.0}}) {
    auto const choices = observer_choices(interval);
    ASSERT_EQ(choices.size(), 3U);
    for (auto const& choice : choices) {
      EXPECT_DOUBLE_EQ(choice.sensor_noise / std::sqrt(elapsed), 0.1);
      EXPECT_EQ(choice.longest_step, 30.0);
    }
    EXPECT_EQ(text_of(choices[1]), "extended Kalman filter, nodes err by 0.0005 K in a second");
  }
}

}  // namespace
}  // namespace thermotwin::twin
