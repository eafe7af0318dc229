#include "twin/study/study_data.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <string>

#include "output/dataset_file.h"
#include "tests/twin/study/small_study.h"
#include "twin/experiment_file.h"
#include "twin/run.h"
#include "twin/study/question.h"
#include "twin/study/study_modes.h"
#include "twin/study/study_page.h"
#include "twin/study/study_runs.h"

namespace thermotwin::twin {
namespace {

using testing::HasSubstr;

/// The small study's world on measured files.
std::string measured_world(std::string const& sampling) {
  auto text = head + world + "sampling = \"" + sampling + "\"\n";
  for (auto const* name : {"fast", "slow"})
    text.replace(text.find(std::string(name) + ".toml"), 9, std::string(name) + ".h5");
  return text;
}

/// A run of the experiment NAME.toml, as `spoil` leaves it, in NAME.h5.
template <class Spoil>
void record(SmallStudy const& study, std::string const& name, Spoil spoil) {
  auto const programme = study.experiment_path(name + ".toml");
  auto data = run(Machine::read(machine_file("v450")), read_experiment(read_toml(programme), programme), {}).dataset;
  spoil(data);
  output::write(data, study.experiment_path(name + ".h5"));
}

/// Both, fast as `spoil` leaves it.
template <class Spoil>
void measure(SmallStudy const& study, Spoil spoil) {
  record(study, "fast", spoil);
  record(study, "slow", [](output::Dataset&) {});
}

output::Channel& channel(std::vector<output::Channel>& group, std::string const& name) {
  return *std::find_if(group.begin(), group.end(), [&](auto const& one) { return one.name == name; });
}

/// Two of T1's readings are missing, and one of E_Z's.
void lose_some(output::Dataset& data) {
  channel(data.readings, "T1").values.segment(4, 2).setConstant(NAN);
  channel(data.displacements, "E_Z").values[10] = NAN;
}

/// A sensor stands still, the machine lacks one, and readings are missing.
void measure_with_faults(SmallStudy const& study) {
  measure(study, [](output::Dataset& data) {
    lose_some(data);
    channel(data.readings, "T9").values.setConstant(20.0);
    data.readings.push_back(data.readings.front());
    data.readings.back().name = "T99";
  });
}

/// Without a machine and without what drove it, models on readings are the same, bit for bit.
TEST(StudyRuns, MayBeOfNoMachine) {
  auto const with = [](std::string const& machine, auto spoil) {
    auto text = measured_world("3 min");
    text.replace(text.find("machine = \"v450\"\n"), 17, machine);
    SmallStudy const study(text);
    record(study, "fast", spoil);
    record(study, "slow", spoil);
    return study.report();
  };
  auto const whole = with("machine = \"v450\"\n", [](output::Dataset&) {});
  auto const bare = with("", [](output::Dataset& data) { data.inputs.clear(); });
  for (std::string const name : {"all + linear", "all + ridge", "forward 2 + linear", "forward 2 + ridge"}) {
    auto const figures = row(bare, name).figures;
    EXPECT_EQ(row(bare, name).refused, "") << name;
    EXPECT_GT(figures.at("cross.rmse").front(), 0.0) << name;
    EXPECT_EQ(figures.at("cross.rmse"), row(whole, name).figures.at("cross.rmse")) << name;
  }
  EXPECT_EQ(bare.units.front(), "um");
}

/// What needs physics has it in the world of a machine, and is refused in the one without.
TEST(StudyRuns, OfNoMachineHaveNoPhysics) {
  auto text = measured_world("3 min");
  text.replace(text.find("machine = \"v450\"\n"), 17, "");
  text.replace(text.find("name = \"v450\""), 13, "name = \"bare\"");
  text.replace(text.find("\"forward 2\""), 11, "\"forward 2\", \"thermal_modes 2\"");
  text.replace(text.find("\"ridge\""), 7, "\"ridge\", \"twin\"");
  auto whole = measured_world("3 min");
  SmallStudy const study(text + whole.substr(head.size()));
  measure(study, [](output::Dataset&) {});
  auto const report = study.report();
  EXPECT_EQ(report.work.twins, 1U);
  for (auto const& row : report.rows)
    if (row.name() == "all + twin" || row.name() == "thermal_modes 2 + linear") {
      EXPECT_EQ(row.refused, row.world == "bare" ? "the world names no machine" : "")
          << row.world << ": " << row.name();
    }
}

/// A measured run's inputs give the state at which the machine is linearised: the modes of a run are those of the
/// experiment that made it.
TEST(StudyModes, OfAMeasuredRunAreThoseOfItsExperiment) {
  SmallStudy const simulated(head + world + "sampling = \"3 min\"\n"), recorded(measured_world("3 min"));
  measure(recorded, [](output::Dataset&) {});
  auto const modes = [](SmallStudy const& study) {
    auto const description = read_study(study.file());
    auto const data = study_data(description, {}, nullptr).front();
    return mode_shapes(description.description.worlds.front(), data,
                       {{0, 0, data.train.front().front().seen.time.size()}})
        .sensors;
  };
  auto const known = modes(simulated), found = modes(recorded);
  ASSERT_EQ(found.rows(), 3);
  EXPECT_LT((found - known).cwiseAbs().maxCoeff(), 1e-3 * known.cwiseAbs().maxCoeff());
}

/// A fold that leaves out the first run is linearised where its own first run is, and a stretch where the machine was
/// in it: what is predicted takes no part in the choice.
TEST(StudyModes, OfAFoldAreThoseOfWhatItIsTrainedOn) {
  auto both = head + world;
  both.replace(both.find("[\"fast.toml\"]"), 13, "[\"fast.toml\", \"slow.toml\"]");
  both.replace(both.find("test = [\"slow.toml\"]"), 20, "test = [\"spindle_standard\"]");
  auto slow = head + world;
  slow.replace(slow.find("[\"fast.toml\"]"), 13, "[\"slow.toml\"]");
  slow.replace(slow.find("test = [\"slow.toml\"]"), 20, "test = [\"spindle_standard\"]");
  auto const asked = [](std::string const& text, auto question) {
    SmallStudy const study(text);
    auto const description = read_study(study.file());
    auto const& own = description.description.worlds.front();
    auto const data = study_data(description, {}, nullptr).front();
    return mode_shapes(own, data, of_first_run(question(questions(own, data, 0, 2)).parts)).sensors;
  };
  auto const fit = [](Questions const& all) { return all.fits.front(); };
  auto const first_fold = [](Questions const& all) { return all.validations.front(); };
  auto const second_fold = [](Questions const& all) { return all.validations.back(); };
  auto const of_fast = asked(both, fit), of_slow = asked(slow, fit);
  EXPECT_GT((of_fast - of_slow).norm(), 1e-3 * of_fast.norm());
  EXPECT_EQ(asked(both, first_fold), of_slow);
  EXPECT_EQ(asked(both, second_fold), of_fast);
  EXPECT_GT((asked(slow, first_fold) - of_slow).norm(), 1e-3 * of_slow.norm());  // most of it at rest
}

/// methods.md §11, B6: the methods that do not look at the error choose the same when it is replaced by noise; those
/// that do look at it do not.
TEST(StudySelections, WithoutTheErrorAreTheSameWhenItIsNoise) {
  std::vector<std::string> const blind{"time_characteristic 2",
                                       "time_of_first_maximum 2",
                                       "fuzzy_c_means 2",
                                       "fuzzy_c_means_shape 2",
                                       "qr_pivot 2",
                                       "d_optimal 2"};
  std::vector<std::string> const seeing{"grey_relational 2", "forward 2"};
  auto text = measured_world("3 min");
  text.replace(text.find("\"all\", \"forward 2\""), 18,
               fmt::format("\"{}\", \"{}\"", fmt::join(blind, "\", \""), fmt::join(seeing, "\", \"")));
  text.replace(text.find("sensors = [\"T1\", \"T8\", \"T9\"]\n"), 29, "");  // all ten
  auto const chosen = [&](auto spoil) {
    SmallStudy const study(text);
    measure(study, spoil);
    std::map<std::string, std::vector<std::string>> sensors;
    for (auto const& row : study.report().rows) sensors[row.selection] = row.sensors;
    return sensors;
  };
  auto const measured = chosen([](output::Dataset&) {}), noise = chosen([](output::Dataset&data) {
                                                           std::mt19937_64 generator(4);
                                                           for (auto& error : channel(data.displacements, "E_Z").values)
                                                             error = double(generator() % 20'000) / 1000.0;
                                                         });
  for (auto const& selection : blind) {
    EXPECT_EQ(noise.at(selection).size(), 2U) << selection;
    EXPECT_EQ(noise.at(selection), measured.at(selection)) << selection;
  }
  for (auto const& selection : seeing) EXPECT_NE(noise.at(selection), measured.at(selection)) << selection;
}

TEST(Study, SaysWhatMeasuredRunsLack) {
  SmallStudy const study(measured_world("9 min"));
  measure_with_faults(study);
  auto const remarks = study.report().remarks;
  for (auto const* remark :
       {"v450: fast.h5: 'T9' is dead: it never moves", "v450: T9 is left out: it is dead in fast.h5",
        "v450: fast.h5: in the data, but not used: T99",
        "v450: fast.h5: of 31 rows, readings are missing, and the means are over the others: "
        "T1 2, E_Z 1"})
    EXPECT_THAT(remarks, testing::Contains(remark));
  SmallStudy const finer(measured_world("1 min"));
  measure_with_faults(finer);
  EXPECT_THAT(finer.complaint(),
              HasSubstr("world 'v450': 'sampling' is 60 s, finer than the 180 s between the rows of "));
}

/// A cell that one sensor lacks at first must not give it another start than the others have: what all of them say of
/// the later rows is the same as if the run had begun there. The twin counts from the same row.
TEST(Study, CountsFromTheFirstRowThatHasAll) {
  SmallStudy const study(measured_world("3 min"));
  output::Dataset shown;
  measure(study, [&](output::Dataset& data) {
    channel(data.readings, "T8").values[0] = NAN;
    shown = data;
  });
  auto const &first = channel(shown.readings, "T1").values, &second = channel(shown.readings, "T8").values,
             &probe = channel(shown.displacements, "E_Z").values;
  auto const read = read_study(study.file());
  auto const worlds = study_data(read, {}, nullptr);
  auto const& run = worlds.front().train.front().front();
  ASSERT_EQ(run.seen.time.size(), first.size() - 1);
  EXPECT_EQ(run.kept.front(), 1);
  EXPECT_NEAR(run.seen.temperature_rise(5, 0), first[6] - first[1], 1e-9);
  EXPECT_NEAR(run.seen.temperature_rise(5, 1), second[6] - second[1], 1e-9);
  EXPECT_NEAR(run.seen.error[5], probe[6] - probe[1], 1e-9);
  auto const said = true_batch(read.description.worlds[0], worlds.front(), shown, run.kept);  // as of a twin
  auto const& truth = channel(shown.truth_readings, "T8").values;
  EXPECT_NEAR(said.temperature_rise(5, 1), truth[6] - truth[1], 1e-9);
  EXPECT_THAT(worlds.front().remarks,
              testing::Contains("fast.h5: changes count from row 2, the first in which all have a value"));
}

/// A probe's zero is another one in each run, and nobody's business: not of a regression, not of a twin, not of a model
/// beside it, in runs trained on, left out, or tested on.
TEST(Study, DoesNotSeeWhereAProbeHasItsZero) {
  auto text = "folds = 2\n" + measured_world("3 min");
  text.replace(text.find("train = [\"fast.h5\"]"), 19, "train = [\"fast.h5\", \"slow.h5\"]");
  text.replace(text.find("test = [\"slow.h5\"]"), 18, "test = [\"third.h5\"]");
  text.replace(text.find("\"ridge\""), 7, "\"twin\", \"twin linear\", \"twin observer\"");
  auto const report = [&](std::vector<double> const& zeros) {
    SmallStudy const study(text);
    tests::put(study.experiment_path("third.toml"), fmt::format(fmt::runtime(experiment), "100 min", "4500 rpm"));
    for (std::size_t i = 0; i < 3; ++i)
      record(study, std::vector<std::string>{"fast", "slow", "third"}[i],
             [&](output::Dataset& data) { channel(data.displacements, "E_Z").values.array() += zeros[i]; });
    return study.report();
  };
  auto const one = report({0.0, 0.0, 0.0}), other = report({40.0, -70.0, 25.0});
  for (auto const* model : {"linear", "twin", "twin linear", "twin observer"})
    for (auto const* figure : {"self.rmse", "cross.rmse", "validation.rmse"}) {
      double const known = row(one, std::string("all + ") + model).figures.at(figure).front();
      EXPECT_NEAR(row(other, std::string("all + ") + model).figures.at(figure).front(), known, 1e-3 * known)
          << model << " " << figure;
      EXPECT_LT(known, 10.0) << model << " " << figure;
    }
}

/// What is left out of several runs is predicted as if it had been a test: by a model beside a twin, whose probe has
/// another zero in each run, and by an observer, which chooses its noise by the runs that are left.
TEST(Study, LeavesOutRunsAsIfTheyHadBeenTests) {
  auto const figures = [](std::string const& folds, std::string const& train, std::string const& test) {
    auto text = folds + measured_world("3 min");
    text.replace(text.find("train = [\"fast.h5\"]"), 19, "train = [" + train + "]");
    text.replace(text.find("test = [\"slow.h5\"]"), 18, "test = [\"" + test + ".h5\"]");
    text.replace(text.find("\"ridge\""), 7, "\"twin\", \"twin linear\", \"twin observer\"");
    SmallStudy const study(text);
    tests::put(study.experiment_path("third.toml"), fmt::format(fmt::runtime(experiment), "100 min", "4500 rpm"));
    for (std::string const name : {"fast", "slow", "third"})
      record(study, name, [&](output::Dataset& data) {
        for (auto& one :
             data.readings)  // a head that the twin does not know of, so that an observer has much to correct
          if (one.name == "T1") one.values.array() += 0.01 * data.time_s.array() / 60.0;
      });
    return study.report();
  };
  auto const both = figures("folds = 2\n", "\"fast.h5\", \"slow.h5\"", "third");
  auto const slow = figures("", "\"fast.h5\"", "slow"), fast = figures("", "\"slow.h5\"", "fast");
  constexpr double rows_slow = 41.0, rows_fast = 31.0;
  for (std::string const model : {"linear", "twin", "twin linear", "twin observer"}) {
    auto const square = [&](StudyReport const& report, std::string const& figure) {
      return std::pow(row(report, "all + " + model).figures.at(figure).front(), 2);
    };
    double const pooled =
        (rows_slow * square(slow, "cross.rmse") + rows_fast * square(fast, "cross.rmse")) / (rows_slow + rows_fast);
    EXPECT_NEAR(square(both, "validation.rmse"), pooled, 1e-6 * pooled) << model;
  }
}

/// A row that is a mean reaches into what follows it: what happens behind the split is not learnt from.
TEST(Study, LearnsNothingFromBehindTheSplit) {
  auto text = measured_world("6 min");
  text.replace(text.find("train = [\"fast.h5\"]"), 19, "train = [\"long.h5\"]");
  text.replace(text.find("test = [\"slow.h5\"]"), 18, "split = \"93 min\"");
  auto const figures = [&](double behind) {
    SmallStudy const study(text);
    tests::put(study.experiment_path("long.toml"), fmt::format(fmt::runtime(experiment), "210 min", "6000 rpm"));
    record(study, "long", [&](output::Dataset& data) {
      auto& probe = channel(data.displacements, "E_Z").values;
      for (Eigen::Index i = 0; i < probe.size(); ++i)
        if (data.time_s[i] >= 93.0 * 60.0) probe[i] += behind;
    });
    return row(study.report(), "all + linear").figures;
  };
  auto const known = figures(0.0), spoilt = figures(300.0);
  EXPECT_EQ(spoilt.at("self.rmse").front(), known.at("self.rmse").front());
  EXPECT_GT(spoilt.at("cross.rmse").front(), 100.0);
}

/// Angles are no lengths: their figures have another unit, and no mean with those of displacements.
TEST(Study, AnglesHaveAUnitOfTheirOwn) {
  auto second = world;
  second.replace(second.find("name = \"v450\""), 13, "name = \"angle\"");
  second.replace(second.find("\"E_Z\""), 5, "\"A\"");
  auto const report = SmallStudy(head + world + second).report();
  EXPECT_THAT(report.units, testing::ElementsAre("um", "urad"));
  EXPECT_TRUE(report.means.empty());
}

TEST(Study, SaysThatATestWasTrainedOn) {
  auto text = measured_world("3 min");
  text.replace(text.find("slow.h5"), 7, "copy.h5");
  SmallStudy const study(text);
  measure(study, [](output::Dataset&) {});
  std::filesystem::copy_file(study.experiment_path("fast.h5"), study.experiment_path("copy.h5"));
  EXPECT_THAT(study.report().remarks,
              testing::Contains("v450: copy.h5 has the same data as fast.h5, which is trained on: it tests nothing"));
}

TEST(Study, SaysThatATrainingRunIsGivenTwice) {
  auto text = measured_world("3 min");
  text.replace(text.find("[\"fast.h5\"]"), 11, "[\"fast.h5\", \"copy.h5\"]");
  SmallStudy const study(text);
  measure(study, [](output::Dataset&) {});
  std::filesystem::copy_file(study.experiment_path("fast.h5"), study.experiment_path("copy.h5"));
  EXPECT_THAT(study.report().remarks,
              testing::Contains("v450: copy.h5 has the same data as fast.h5; they count once more"));
}

/// Rows are left out as `fit` leaves them out, and not the sensor, for three empty cells; lags do not reach across
/// them.
TEST(Study, LeavesOutRowsWhereFewReadingsAreMissing) {
  auto text = measured_world("3 min");
  text.replace(text.find("\"ridge\""), 7, "\"distributed_lag\", \"twin\"");
  SmallStudy const study(text);
  std::vector<Eigen::Index> kept;
  Eigen::MatrixXd inputs = Eigen::MatrixXd::Ones(28, 4);
  Eigen::VectorXd error;
  measure(study, [&](output::Dataset& data) {
    lose_some(data);
    for (Eigen::Index i = 0; i < data.time_s.size(); ++i)
      if (i != 4 && i != 5 && i != 10) kept.push_back(i);
    int column = 1;
    for (auto const* sensor : {"T1", "T8", "T9"}) inputs.col(column++) = channel(data.readings, sensor).values(kept);
    error = channel(data.displacements, "E_Z").values(kept);
  });
  auto const report = study.report();
  EXPECT_THAT(report.remarks, testing::Contains("v450: fast.h5: 3 of 31 rows are left out: no value of T1 in 2, of "
                                                "E_Z in 1"));
  auto const& linear = row(report, "all + linear");
  EXPECT_EQ(linear.sensors, (std::vector<std::string>{"T1", "T8", "T9"}));
  Eigen::VectorXd const residual = error - inputs * inputs.colPivHouseholderQr().solve(error);
  EXPECT_NEAR(linear.figures.at("self.rmse").front(), std::sqrt(residual.squaredNorm() / 28.0), 1e-6);
  EXPECT_THAT(row(report, "all + distributed_lag").refused, HasSubstr("lags need even steps"));
  EXPECT_LT(row(report, "all + twin").figures.at("self.rmse").front(), 1.0);
}

/// An error that stands still is no error to learn: the refusal says that it is dead, not only that it is missing.
TEST(Study, RefusesAnErrorThatNeverMoves) {
  SmallStudy const study(measured_world("3 min"));
  measure(study, [](output::Dataset& data) { channel(data.displacements, "E_Z").values.setConstant(1.0); });
  EXPECT_THAT(study.complaint(),
              HasSubstr("world 'v450': fast.h5: none of its 31 rows is complete: no value of E_Z in 31; "
                        "'E_Z' is dead: it never moves"));
}

/// In a gap of the record every channel lacks what the others lack: no sensor is the worse for it.
TEST(Study, LeavesOutTheRowsOfAGap) {
  SmallStudy const study(measured_world("6 min"));
  measure(study, [](output::Dataset& data) {
    for (auto* group : {&data.readings, &data.displacements})
      for (auto& one : *group) one.values.segment(10, 8).setConstant(NAN);
  });
  auto const report = study.report();
  EXPECT_THAT(
      report.remarks,
      testing::Contains(HasSubstr("v450: fast.h5: 4 of 16 rows are left out: no value of T1 in 4, of T8 in 4")));
  EXPECT_EQ(row(report, "all + linear").sensors.size(), 3U);
}

/// Before the verdict, which rests on the others.
TEST(Study, LeavesOutASensorThatLacksMuch) {
  SmallStudy const study(measured_world("3 min"));
  measure(study, [](output::Dataset& data) { channel(data.readings, "T8").values.segment(4, 4).setConstant(NAN); });
  auto const report = study.report();
  std::string const remark = "v450: T8 is left out: 4 of 31 readings are missing in fast.h5, more than 10 %";
  EXPECT_THAT(report.remarks, testing::Contains(remark));
  EXPECT_EQ(row(report, "all + linear").sensors, (std::vector<std::string>{"T1", "T9"}));
  auto const text = study_text(report);
  EXPECT_LT(text.find(remark), text.find("\nverdict\n"));
}

TEST(Study, SaysWhichSensorsItLeavesOut) {
  auto text = head + world;
  text += R"(add = '''
[[temperature_sensor]]
name = "still"
at = "ambient"
kind = "ideal"
[[temperature_sensor]]
name = "broken"
at = "motor"
dead_from = "30 min"
'''
)";
  text.replace(text.find("\"T9\""), 4, "\"T9\", \"still\", \"broken\"");
  auto const report = SmallStudy(text).report();
  EXPECT_THAT(report.remarks, testing::Contains("v450: still stands still in fast.toml, and is left out there"));
  EXPECT_THAT(report.remarks,
              testing::Contains(HasSubstr("v450: broken is left out: 21 of 31 readings are missing in fast.toml")));
  EXPECT_EQ(row(report, "all + linear").sensors, (std::vector<std::string>{"T1", "T8", "T9"}));
}

TEST(StudyAverages, AreOverStretchesAndSkipWhatIsMissing) {
  output::Dataset data;
  data.time_s = Eigen::VectorXd::LinSpaced(7, 0.0, 90.0);  // every 15 s
  data.readings.push_back({"T", "degC", "", (Eigen::VectorXd(7) << 1, 2, 3, 4, 5, NAN, 7).finished()});
  auto const mean = averaged(data, 30.0);
  EXPECT_EQ(mean.time_s, (Eigen::VectorXd(4) << 0, 30, 60, 90).finished());
  EXPECT_EQ(mean.readings[0].values, (Eigen::VectorXd(4) << 1.5, 3.5, 5, 7).finished());
}

}  // namespace
}  // namespace thermotwin::twin
