#include "twin/study/study_twin.h"

#include <cmath>
#include <cstddef>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "output/dataset_file.h"
#include "scenarios/course.h"
#include "tests/twin/late_record.h"
#include "tests/twin/study/small_study.h"
#include "twin/compensation/observed_run.h"
#include "twin/experiment_file.h"
#include "twin/run.h"
#include "twin/setting.h"

namespace thermotwin::twin {
namespace {

/// The twin starts from a file whose numbers are wrong, is calibrated on the training run, and then beats what
/// regressions learn from that run; what its readings err by tells more.
TEST(Study, TwinIsCalibratedOnTheTrainingRuns) {
  SmallStudy const study(
      "title = \"x\"\nseeds = 5\nselections = [\"all\"]\n"
      "models = [\"linear\", \"twin\", \"twin ridge\", \"twin & linear\"]\n" +
      world);
  auto const report = study.report();
  auto const mean = [&](std::string const& name) { return interval(row(report, name).figures.at("cross.rmse")).mean; };
  EXPECT_LT(mean("all + twin"), 1.0);
  EXPECT_LT(mean("all + twin"), mean("all + linear"));
  EXPECT_LT(mean("all + twin ridge"), mean("all + linear"));
  EXPECT_GT(mean("all + twin"), 0.0);  // it does not know the truth
  auto const figure = [&](std::string const& name, std::size_t seed) {
    return row(report, name).figures.at("cross.rmse").at(seed);
  };
  for (std::size_t seed = 0; seed < 5; ++seed) {  // norm of a mean: between half the norms' difference and their mean
    double const twin = figure("all + twin", seed), line = figure("all + linear", seed);
    EXPECT_LE(figure("all + twin & linear", seed), 0.5 * (twin + line) * (1.0 + 1e-12));
    EXPECT_GE(figure("all + twin & linear", seed), 0.5 * std::abs(twin - line) * (1.0 - 1e-12));
  }
  EXPECT_EQ(row(report, "all + twin").sensors.size(), 3U);
}

/// What the study adds to the machine, the twin lacks: no number of its file stands for a heater on the head.
TEST(Study, TwinLacksWhatTheStudyAdds) {
  std::string const twin_only = "title = \"x\"\nseeds = 5\nselections = [\"all\"]\nmodels = [\"twin\"]\n" + world;
  SmallStudy const heated(twin_only +
                          "add = '''\n[[heat]]\nname = \"heater\"\nat = \"head_front\"\npower = \"150 W\"\n'''\n");
  auto const error = [](SmallStudy const& study) {
    return interval(row(study.report(), "all + twin").figures.at("cross.rmse")).mean;
  };
  EXPECT_GT(error(heated), 3.0 * error(SmallStudy(twin_only)));
}

/// An observer sees in the sensors what the file lacks.
TEST(Study, ObserverSeesInTheSensorsWhatTheTwinLacks) {
  auto text = "title = \"x\"\nseeds = 5\nselections = [\"all\"]\nmodels = [\"twin\", \"twin observer\"]\n" + world +
              "add = '''\n[[heat]]\nname = \"heater\"\nat = \"head_front\"\npower = \"150 W\"\n'''\n";
  text.replace(text.find("\"T9\""), 4, "\"T9\", \"T6\"");
  auto const report = SmallStudy(text).report();
  auto const mean = [&](std::string const& name) { return interval(row(report, name).figures.at("cross.rmse")).mean; };
  EXPECT_LT(mean("all + twin observer"), 0.7 * mean("all + twin"));
  EXPECT_THAT(row(report, "all + twin observer").remark, testing::HasSubstr("extended Kalman filter"));
}

/// Of a machine that an observer cannot tell of, the combination stands in the table with the reason, and so it does in
/// the mean of the worlds; cross-validation does not choose it there, and what is claimed of it there is not judged.
/// On the other machine it is as good as any.
TEST(Study, ObserverIsRefusedWhereItCannotTellTheError) {
  std::string const screw = R"(
[[world]]
name = "screw"
machine = "loose.toml"
error = "E_P_fixed_720mm"
sampling = "3 min"
train = ["feed_8000"]
test = ["feed_12000"]
)";
  std::string const claims = R"(
[[claim]]
says = "in the mean"
world = "mean of worlds"
combination = "all + twin observer"
at_most = 1e6
[[claim]]
says = "chosen in the mean"
world = "mean of worlds"
combination = "chosen by cross-validation"
at_most = 1e6
[[claim]]
says = "where it can"
world = "v450"
combination = "all + twin observer"
at_most = 1e6
)";
  SmallStudy const small("folds = 2\nalso = [\"all + twin observer\"]\n" + head + world + screw + claims);
  std::string loose = tests::contents(machine_file("vmc850"));
  constexpr std::string_view holds = "unilateral = false";
  loose.replace(loose.find(holds), holds.size(), "unilateral = true");
  tests::put(small.file().parent_path() / "loose.toml", loose);
  auto study = read_study(small.file());
  study.description.seeds = 1;
  auto const report = run_study(study);
  auto const& on_screw = report.rows.back();
  EXPECT_EQ(on_screw.world + ": " + on_screw.name(), "screw: all + twin observer");
  EXPECT_THAT(on_screw.refused, testing::HasSubstr("the observer: 'E_P_fixed_720mm' is the error along a screw that "
                                                   "loses its pretension"));
  EXPECT_TRUE(on_screw.figures.empty());
  EXPECT_EQ(report.means.back().refused, "screw: " + on_screw.refused);
  EXPECT_TRUE(report.means.back().figures.empty());
  EXPECT_FALSE(row(report, "all + twin observer").figures.empty());
  EXPECT_EQ(report.claims.at(0).answer, ClaimVerdict::Answer::refused);
  EXPECT_EQ(report.claims.at(1).answer, ClaimVerdict::Answer::holds);
  EXPECT_THAT(report.claims.at(1).words, testing::Not(testing::HasSubstr("observer")));
  EXPECT_EQ(report.claims.at(2).answer, ClaimVerdict::Answer::holds);
}

/// What nodes err by is chosen by what is trained on: by the errors of that fold's training run, which an observer of
/// one of the choices has told, and not by those of the run left out, which another one has.
TEST(Study, ObserverIsChosenWithoutWhatCrossValidationLeavesOut) {
  SmallStudy small(head + world);
  auto study = read_study(small.file());
  study.description.seeds = 1;
  auto& only = study.description.worlds.front();
  only.sensors = {"T1", "T6", "T8", "T9"};
  only.train = {"fast.toml", "slow.toml"};
  only.test = {"spindle_constant_50"};
  auto data = study_data(study, {}, nullptr).front();
  auto const& machine = *data.runs->machine;
  auto const choices = observer_choices(180.0);
  auto const told = [&](std::size_t run, ObserverOptions const& options) {
    scenarios::ExperimentCourse const course(*data.runs->experiments[run], machine.limits);
    Eigen::VectorXd const all =
        observed_error(TwinObserver(machine, "E_Z", options, only.sensors), data.runs->runs.front()[run], course, 0.0);
    return Eigen::VectorXd(all(data.train.front()[run].kept));
  };
  for (std::size_t k = 0; k < choices.size(); ++k) {
    data.train.front()[0].seen.error = told(0, choices[k]);
    data.train.front()[1].seen.error = told(1, choices[(k + 1) % choices.size()]);
    auto const folds = questions(only, data, 0, 2).validations;
    ASSERT_EQ(folds.size(), 2U);
    for (auto const& fold : folds) {
      auto const own = (k + fold.parts.front().run) % choices.size();
      EXPECT_EQ(observed(only, data, 0, fold, machine, {0, 1, 2, 3}).model.remark, text_of(choices[own])) << fold.name;
    }
  }
}

/// The small study's world on measured files, with this model beside the linear one.
std::string measured_world(std::string const& model) {
  auto text = "folds = 2\n" + head + world;
  for (auto const* name : {"fast", "slow"})
    text.replace(text.find(std::string(name) + ".toml"), 9, std::string(name) + ".h5");
  return text.replace(text.find("ridge"), 5, model);
}

/// Somebody's machine, whose bearings rub less than the file says, measured by a probe whose zero is anywhere.
void measure_poorly_greased(SmallStudy const& study, double sampling, Eigen::Index before_logger = 0) {
  Value document = read_toml(machine_file("v450"));
  set_parameter(document, "bearing.front.grease_factor", "0.7");
  double zero = 40.0;
  for (std::string const name : {"fast", "slow"}) {
    auto const programme = study.experiment_path(name + ".toml");
    auto experiment = read_experiment(read_toml(programme), programme);
    experiment.sampling = sampling;
    auto data = run(Machine::build(document), experiment, {}).dataset;
    for (auto& channel : data.displacements) channel.values.array() += zero;
    zero = -70.0;
    if (name == "slow") data = tests::without_first(before_logger, data);
    output::write(data, study.experiment_path(name + ".h5"));
  }
}

TEST(Study, MeasuredRunsHaveATwinToo) {
  SmallStudy const study(measured_world("twin"));
  measure_poorly_greased(study, 180.0);
  auto const report = study.report();
  auto const& twin = row(report, "all + twin").figures;
  EXPECT_LT(twin.at("self.rmse").front(), 1.0);
  EXPECT_LT(twin.at("cross.rmse").front(), 1.5);
  EXPECT_LT(twin.at("validation.rmse").front(), 2.0);
}

/// An observer follows the rows of a record, of whatever means its error is asked. Told the means at the
/// times of their stretches' starts, and asked there, it is off by micrometres.
TEST(Study, ObserverFollowsTheRowsOfMeasuredMeans) {
  auto const figure = [](std::string const& sampling) {
    SmallStudy const study(measured_world("twin observer") + sampling);
    measure_poorly_greased(study, 30.0);
    return row(study.report(), "all + twin observer").figures.at("cross.rmse").front();
  };
  double const rows = figure(""), means = figure("sampling = \"10 min\"\n");
  EXPECT_LT(rows, 1.0);
  EXPECT_NEAR(means, rows, 0.1);
}

/// Of a run whose machine was warm when the logger was switched on, a twin alone is told how warm; an observer is not.
TEST(Study, SaysThatAnObserverBeginsWithTheRoom) {
  auto const remarks = [](std::string const& model, Eigen::Index before_logger) {
    SmallStudy const study(measured_world(model));
    measure_poorly_greased(study, 180.0, before_logger);
    return study.report().remarks;
  };
  auto const remark = testing::Contains(
      testing::HasSubstr("v450: slow.h5: it begins warm: an observer of fewer than four sensors is not told how warm"));
  EXPECT_THAT(remarks("twin observer", 12), remark);
  EXPECT_THAT(remarks("twin", 12), testing::Not(remark));
  EXPECT_THAT(remarks("twin observer", 0), testing::Not(remark));
}

}  // namespace
}  // namespace thermotwin::twin
