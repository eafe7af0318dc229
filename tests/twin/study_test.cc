#include "twin/study/study.h"

#include <Eigen/QR>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "output/dataset_file.h"
#include "tests/output/temporary_directory.h"
#include "twin/experiment_file.h"
#include "twin/run.h"
#include "twin/study/choice.h"
#include "twin/study/judgement.h"
#include "twin/study/study_page.h"
#include "twin/study/study_runs.h"
#include "twin/study/verdict.h"

namespace thermotwin::twin {
namespace {

using testing::HasSubstr;
using tests::TemporaryDirectory;

std::string const experiment = R"(
machine = "v450"
duration = "{}"
sampling = "3 min"
[ambient]
mean = "20 degC"
[spindle]
blocks = [{{duration = "50 min", speed = "{}"}}]
)";

std::string const head = R"(
title = "Small"
seeds = 5
selections = ["all", "forward 2"]
models = ["linear", "ridge"]
)";

std::string const world = R"(
[[world]]
name = "v450"
machine = "v450"
error = "E_Z"
sensors = ["T1", "T8", "T9"]
train = ["fast.toml"]
test = ["slow.toml"]
)";

/// A folder with two short experiments and a study file of this text.
class SmallStudy {
 public:
  explicit SmallStudy(std::string const& text = head + world) {
    tests::put(folder_ / "fast.toml", fmt::format(fmt::runtime(experiment), "90 min", "6000 rpm"));
    tests::put(folder_ / "slow.toml", fmt::format(fmt::runtime(experiment), "120 min", "3000 rpm"));
    tests::put(file(), text);
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "small.toml"; }
  [[nodiscard]] std::filesystem::path experiment_path(std::string const& name) const { return folder_ / name; }
  [[nodiscard]] StudyReport report() const { return run_study(read_study(file())); }
  /// What reading and running it complains of.
  [[nodiscard]] std::string complaint() const {
    try {
      (void)report();
    } catch (std::exception const& error) {
      return error.what();
    }
    return "no complaint";
  }

 private:
  TemporaryDirectory folder_;
};

Combination const& row(StudyReport const& report, std::string const& name) {
  for (auto const& row : report.rows)
    if (row.name() == name) return row;
  throw std::runtime_error("no row " + name);
}

/// Rises of T1, T8, T9 with a column of ones, seen or true, and the error.
struct Regression {
  Eigen::MatrixXd inputs;
  Eigen::VectorXd seen, truth;

  Regression(std::filesystem::path const& file, int seed) {
    auto programme = read_experiment(read_toml(file), file);
    programme.seed = seed;
    auto const data = run(Machine::read(machine_file("v450")), programme, {}).dataset;
    inputs = Eigen::MatrixXd::Ones(data.time_s.size(), 4);
    int column = 1;
    for (auto const& channel : data.readings)
      if (channel.name == "T1" || channel.name == "T8" || channel.name == "T9")
        inputs.col(column++) = channel.values.array() - channel.values[0];
    for (auto const& channel : data.displacements)
      if (channel.name == "E_Z") seen = channel.values;
    for (auto const& channel : data.truth_displacements)
      if (channel.name == "E_Z") truth = channel.values;
  }
};

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

TEST(Study, FiguresAreThoseOfLeastSquaresByHand) {
  SmallStudy const study;
  auto const report = study.report();
  auto const& figures = row(report, "all + linear").figures;
  for (int r = 0; r < 5; ++r) {
    Regression const train(study.experiment_path("fast.toml"), 1 + 2 * r);
    Regression const test(study.experiment_path("slow.toml"), 2 + 2 * r);
    Eigen::VectorXd const b = train.inputs.colPivHouseholderQr().solve(train.seen);
    Eigen::VectorXd const self = train.truth - train.inputs * b, cross = test.truth - test.inputs * b;
    auto const value = [&](char const* name) { return figures.at(name)[std::size_t(r)]; };
    EXPECT_NEAR(value("self.rmse"), std::sqrt(self.squaredNorm() / double(self.size())), 1e-8);
    EXPECT_NEAR(value("cross.rmse"), std::sqrt(cross.squaredNorm() / double(cross.size())), 1e-8);
    EXPECT_NEAR(value("cross.mae"), cross.cwiseAbs().mean(), 1e-8);
    EXPECT_NEAR(value("cross.max"), cross.cwiseAbs().maxCoeff(), 1e-8);
    double const variation = (test.truth.array() - test.truth.mean()).square().sum();
    EXPECT_NEAR(value("cross.r_squared"), 1.0 - cross.squaredNorm() / variation, 1e-8);
    Eigen::VectorXd const residual = train.seen - train.inputs * b;
    EXPECT_NEAR(value("S"), std::sqrt(residual.squaredNorm() / double(residual.size() - 4)), 1e-8);
    EXPECT_NEAR(value("improvement"), 0.0, 1e-12);  // it is the reference
  }
}

TEST(Study, ImprovementIsOverTheReferenceInTheNamedMetric) {
  SmallStudy const study("metric = \"mae\"\nreference = \"forward 2 + ridge\"\n" + head + world);
  auto const report = study.report();
  auto const& figures = row(report, "all + linear").figures;
  auto const& reference = row(report, "forward 2 + ridge").figures;
  double const before = interval(reference.at("cross.mae")).mean, after = interval(figures.at("cross.mae")).mean;
  for (std::size_t r = 0; r < 5; ++r)
    EXPECT_NEAR(figures.at("improvement")[r],
                100.0 * (reference.at("cross.mae")[r] - figures.at("cross.mae")[r]) / before, 1e-9);
  EXPECT_NEAR(interval(figures.at("improvement")).mean, 100.0 * (1.0 - after / before), 1e-9);
  EXPECT_THAT(study_text(report), HasSubstr("better: mae of cross-prediction against forward 2 + ridge"));
  EXPECT_EQ(row(report, "forward 2 + ridge").sensors.size(), 2U);
}

TEST(Study, MeasuresSelectionsAgainstTheBestSet) {
  auto const report = SmallStudy("folds = 3\n" + head + world).report();
  auto const& forward = report.selections.at(1).figures;
  for (std::size_t r = 0; r < 5; ++r) {
    EXPECT_GE(forward.at("regret")[r], 0.0);
    EXPECT_EQ(forward.at("informative")[r], 2.0);
    EXPECT_EQ(forward.at("regret")[r] == 0.0, forward.at("found")[r] == 2.0);
  }
  EXPECT_FALSE(report.selections.at(0).figures.contains("regret"));  // all sensors are no choice
  EXPECT_EQ(row(report, "all + ridge").figures.at("validation.rmse").size(), 5U);
}

TEST(Study, MayCutOneRunInTwo) {
  auto text = head + world;
  text.replace(text.find("test = [\"slow.toml\"]"), 20, "split = \"60 min\"");
  auto const report = SmallStudy(text).report();
  auto const& figures = row(report, "all + linear").figures;
  EXPECT_GT(interval(figures.at("cross.rmse")).mean, interval(figures.at("self.rmse")).mean);
  text.replace(text.find("\"ridge\""), 7, "\"twin ridge\"");  // calibrated on the first hour
  auto const of_twin = row(SmallStudy(text).report(), "all + twin ridge").figures;
  EXPECT_LT(interval(of_twin.at("cross.rmse")).mean, interval(figures.at("cross.rmse")).mean);
}

/// Somebody's machine, whose bearings rub less than the file says, measured by a probe whose zero is anywhere.
TEST(Study, MeasuredRunsHaveATwinToo) {
  auto text = "folds = 2\n" + head + world;
  for (auto const* name : {"fast", "slow"})
    text.replace(text.find(std::string(name) + ".toml"), 9, std::string(name) + ".h5");
  text.replace(text.find("\"ridge\""), 7, "\"twin\"");
  SmallStudy const study(text);
  Value document = read_toml(machine_file("v450"));
  set_parameter(document, "bearing.front.grease_factor", "0.7");
  double zero = 40.0;
  for (std::string const name : {"fast", "slow"}) {
    auto const programme = study.experiment_path(name + ".toml");
    auto data = run(Machine::build(document), read_experiment(read_toml(programme), programme), {}).dataset;
    for (auto& channel : data.displacements) channel.values.array() += zero;
    zero = -70.0;
    output::write(data, study.experiment_path(name + ".h5"));
  }
  auto const report = study.report();
  auto const& twin = row(report, "all + twin").figures;
  EXPECT_LT(twin.at("self.rmse").front(), 1.0);
  EXPECT_LT(twin.at("cross.rmse").front(), 1.5);
  EXPECT_LT(twin.at("validation.rmse").front(), 2.0);
}

/// The small study's world on measured files.
std::string measured_world(std::string const& sampling) {
  auto text = head + world + "sampling = \"" + sampling + "\"\n";
  for (auto const* name : {"fast", "slow"})
    text.replace(text.find(std::string(name) + ".toml"), 9, std::string(name) + ".h5");
  return text;
}

/// Writes these, fast as `spoil` leaves it.
template <class Spoil>
void measure(SmallStudy const& study, Spoil spoil) {
  for (std::string const name : {"fast", "slow"}) {
    auto const programme = study.experiment_path(name + ".toml");
    auto data = run(Machine::read(machine_file("v450")), read_experiment(read_toml(programme), programme), {}).dataset;
    if (name == "fast") spoil(data);
    output::write(data, study.experiment_path(name + ".h5"));
  }
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

TEST(Study, TreatsEachRunAsABatchOfItsOwn) {
  std::string const batches = R"(
[[world]]
name = "batches"
machine = "v450"
error = "E_Z"
fit = "each"
train = ["batch_004_K01", "batch_004_K05", "batch_004_K09"]
test = ["batch_004_V1", "batch_004_V2"]
)";
  auto const report = SmallStudy(head + batches).report();
  auto const& figures = row(report, "forward 2 + linear").figures;
  for (char const* name : {"S", "Mn", "Sd", "verification.Mn", "verification.Sd"})
    EXPECT_EQ(figures.at(name).size(), 5U) << name;
  EXPECT_LT(figures.at("S")[0], figures.at("Mn")[0]);
  EXPECT_LE(figures.at("Mn.least")[0], figures.at("Mn.most")[0]);
  EXPECT_EQ(report.selections.at(0).figures.at("switches")[0], 0.0);  // all sensors, always
}

TEST(Study, JudgesAFeedAxisByTheSlopeOfItsError) {
  std::string const axis = R"(
[[world]]
name = "axis"
machine = "vmc850"
error = "slope z"
sensors = ["S5", "S6", "S7", "S9"]
train = ["feed_8000", "feed_16000"]
test = ["feed_12000"]
to = "550 mm"
instant = [{ experiment = "feed_12000", time = "150 min" }]
)";
  auto const report = SmallStudy(head + axis).report();
  EXPECT_EQ(report.units.at(0), "um/m");
  EXPECT_THAT(study_text(report), HasSubstr("feed_12000 at 150 min"));
  auto late = axis;
  late.replace(late.find("150 min"), 7, "900 min");
  EXPECT_THAT(SmallStudy(head + late).complaint(),
              HasSubstr("world 'axis': no pass of the laser in feed_12000 at 900 min; they are from 0 min to "));
  auto const& figures = row(report, "all + linear").figures;
  for (double const rmse : figures.at("feed_12000 at 150 min.rmse")) EXPECT_LT(rmse, 5.0);
  EXPECT_LE(figures.at("feed_12000 at 150 min.mae")[0], figures.at("feed_12000 at 150 min.max")[0]);
}

TEST(Study, JudgesInstantsByOneModelOfAllRuns) {
  std::string const each = R"(
[[world]]
name = "axis"
machine = "vmc850"
error = "slope z"
fit = "each"
train = ["feed_8000", "feed_12000", "feed_16000"]
instant = [{ experiment = "feed_12000", time = "150 min" }]
)";
  EXPECT_THAT(SmallStudy(head + each).complaint(),
              HasSubstr("small.toml:13:12: an 'instant' is judged by the one model of all of 'train', but 'fit' is "
                        "each; give fit = \"together\", or no 'instant'"));
}

/// What the laser showed pivots at 0.2 m, the true error at 0.3 m: the fit knows the first, the judgement the second.
TEST(StudyJudgement, FitsTheZeroPositionToWhatTheLaserShowed) {
  double const slope = 10.0;  // µm/m
  auto const record = [&](double zero) {
    models::AxisRecord axis{"run", Eigen::Vector2d(0, 900), {"T1"}, {"nut"}, Eigen::MatrixXd::Zero(2, 1), {}, {}};
    axis.position = Eigen::Vector3d(0.0, 0.25, 0.5);
    axis.error = slope * Eigen::Vector2d::Ones() * (axis.position.array() - zero).matrix().transpose();
    return axis;
  };
  WorldData data;
  data.train = {{{models::slope_batch(record(0.2)), models::slope_batch(record(0.3)), record(0.2), record(0.3)}}};
  data.test.resize(1);
  StudyWorld axis;
  axis.instants = {{"run", 900.0}};
  models::ErrorModel model;
  model.inputs = {"T1"};
  model.form = models::LinearForm{slope, {0}, Eigen::MatrixXd::Zero(1, 1), 0};
  auto const figures = judged_instants(axis, data, 0, model);
  for (auto const* name : {"rmse", "mae", "max"})
    EXPECT_NEAR(figures.at(std::string("run at 15 min.") + name), 0.1 * slope, 1e-9) << name;
}

/// A model of the last three readings, asked row by row: all rows but the first two, as of the whole run.
TEST(StudyJudgement, LeavesOutStretchesOfWhichAModelClaimsNothing) {
  models::Batch const run{"run",
                          Eigen::VectorXd::LinSpaced(10, 0.0, 540.0),
                          {"T1"},
                          {"head"},
                          Eigen::MatrixXd::Zero(10, 1),
                          Eigen::VectorXd::LinSpaced(10, 0.0, 9.0)};
  auto const start = rows_of(run, 0, 2);
  models::ErrorModel model;
  model.inputs = {"T1"};
  model.sample_period = 60.0;
  model.form = models::LinearForm{0.0, {0, 1, 2}, Eigen::MatrixXd::Zero(1, 3), 2};
  Question whole;
  whole.asked.push_back({Role::self, run, run.error, 0, 10});
  whole.asked.push_back({Role::cross, start, start.error, 0, 2});
  std::vector<Question> folds(10);
  std::vector<Answer> validations;
  for (std::size_t k = 0; k < folds.size(); ++k) {
    folds[k].asked.push_back({Role::validation, run, run.error, Eigen::Index(k), 1});
    validations.push_back({{{&folds[k], &model}}});
  }
  auto const figures = judged({Answer{{{&whole, &model}}}}, validations, 1);
  EXPECT_NEAR(figures.at("self.mae"), 5.5, 1e-12);
  EXPECT_NEAR(figures.at("validation.mae"), 5.5, 1e-12);
  EXPECT_EQ(figures.at("validation.max"), 9.0);
  EXPECT_FALSE(figures.contains("cross.mae"));
  EXPECT_TRUE(figures.contains("S"));
  EXPECT_FALSE(figures.contains("Mn"));
}

/// One says 2 um and claims all, the other what a twin says and 6 um more, and claims all but two instants.
TEST(Study, AnswersAreTheMeanOfTheirModels) {
  models::Batch const run{"warm-up",
                          Eigen::VectorXd::LinSpaced(4, 0.0, 180.0),
                          {"T1"},
                          {"head"},
                          Eigen::MatrixXd::Zero(4, 1),
                          Eigen::VectorXd::LinSpaced(4, 0.0, 3.0)};
  auto const constant = [](double value, std::vector<int> lags, double parameters) {
    models::ErrorModel model;
    model.inputs = {"T1"};
    model.sample_period = 60.0;
    model.parameters = parameters;
    auto const columns = Eigen::Index(lags.size());
    model.form = models::LinearForm{value, std::move(lags), Eigen::MatrixXd::Zero(1, columns), int(columns) - 1};
    return model;
  };
  auto const now = constant(2.0, {0}, 1.0), past = constant(6.0, {0, 1, 2}, 4.0);
  Question whole, beside_twin;
  whole.asked.push_back({Role::self, run, run.error, 0, 4});
  beside_twin.asked.push_back({Role::self, run, run.error, 0, 4, 0, Eigen::Vector4d(0.0, 2.0, 4.0, 6.0)});
  Answer const answer{{{&whole, &now}, {&beside_twin, &past}}};
  EXPECT_TRUE(answer.predict(0).isApprox(Eigen::Vector4d(4.0, 5.0, 6.0, 7.0), 1e-15));
  EXPECT_EQ(answer.unclaimed_instants(), 2);
  EXPECT_EQ(answer.parameters(), 2.5);
  EXPECT_NEAR(judged({answer}, {}, 1).at("self.rmse"), 4.0, 1e-12);
}

TEST(Study, ClaimsAreDecidedByIntervals) {
  std::string const claims = R"(
[[claim]]
says = "two sensors fit no better than three"
combination = "all + linear"
than = "forward 2 + linear"
figure = "S"
[[claim]]
says = "nobody errs by more than a metre"
combination = "all + linear"
at_most = 1e6
[[claim]]
says = "nobody errs"
combination = "all + linear"
at_most = 0
[[claim]]
says = "there is such a figure"
combination = "all + linear"
figure = "verification.Mn"
at_most = 1
[[claim]]
says = "it is better than itself"
combination = "all + linear"
than = "all + linear"
[[claim]]
says = "it is no worse than itself"
combination = "all + linear"
than = "all + linear"
tolerance = 0
[[claim]]
says = "it is better than itself by three quarters"
combination = "all + linear"
than = "all + linear"
improvement = 75
)";
  auto const report = SmallStudy(head + world + claims).report();
  EXPECT_EQ(report.claims.at(1).answer, ClaimVerdict::Answer::holds);
  EXPECT_EQ(report.claims.at(2).answer, ClaimVerdict::Answer::fails);
  EXPECT_EQ(report.claims.at(3).answer, ClaimVerdict::Answer::refused);
  EXPECT_EQ(report.claims.at(4).answer, ClaimVerdict::Answer::fails);
  EXPECT_EQ(report.claims.at(5).answer, ClaimVerdict::Answer::holds);
  EXPECT_EQ(report.claims.at(6).answer, ClaimVerdict::Answer::fails);
  EXPECT_THAT(study_text(report), HasSubstr("\"nobody errs\" does not hold: cross.rmse of all + linear: "));
}

/// Half a micrometre less in each repetition, though repetitions differ by eight.
TEST(StudyVerdict, ComparesCombinationsInTheSameRepetition) {
  StudyReport report;
  report.description.worlds.resize(1);
  report.units = {"um"};
  report.rows = {{"", "all", "linear", {{"cross.rmse", {1.0, 5.0, 9.0}}}, {}, {}, {}},
                 {"", "all", "ridge", {{"cross.rmse", {1.5, 5.5, 9.5}}}, {}, {}, {}}};
  StudyClaim claim;
  claim.combination = "all + linear";
  claim.than = "all + ridge";
  report.description.claims.push_back(claim);
  claim.improvement = 20.0;
  report.description.claims.push_back(claim);
  claim.improvement = {};
  std::swap(claim.combination, claim.than);
  claim.tolerance = 60.0;
  report.description.claims.push_back(claim);
  put_verdict(report);
  EXPECT_EQ(report.claims.at(0).answer, ClaimVerdict::Answer::holds);
  EXPECT_THAT(report.claims.at(0).words, HasSubstr("; 9.1 ± 0.0 % less"));
  EXPECT_EQ(report.claims.at(1).answer, ClaimVerdict::Answer::undecided);
  EXPECT_EQ(report.claims.at(2).answer, ClaimVerdict::Answer::undecided);
  EXPECT_THAT(report.claims.at(2).words, HasSubstr("-10.0 ± 0.0 % less, against 60 % more at most"));
}

TEST(Study, RefusedCombinationsStandInTheTable) {
  auto text = head + world;
  text.replace(text.find("\"linear\", \"ridge\""), 17, "\"linear\", \"distributed_lag\"");
  text.replace(text.find("sensors = [\"T1\", \"T8\", \"T9\"]\n"), 29, "");
  auto const report = SmallStudy(text).report();  // 31 readings, 29 of them after the lags
  auto const& refused = row(report, "all + distributed_lag");
  EXPECT_EQ(refused.refused, "29 samples are too few for 30 regressors: at least 32");
  EXPECT_TRUE(refused.figures.empty());
  EXPECT_FALSE(row(report, "forward 2 + distributed_lag").figures.empty());
  EXPECT_THAT(study_text(report), HasSubstr("refused: "));
  EXPECT_THAT(study_csv(report), HasSubstr(",distributed_lag,"));
}

TEST(Study, RemarksOfFitsStandInTheTable) {
  auto text = head + world;
  text.replace(text.find("\"ridge\""), 7, "\"back_propagation\"");
  auto const report = SmallStudy(text).report();  // 3 + 7 + 1 nodes
  auto const remark = row(report, "all + back_propagation").remark;
  EXPECT_THAT(remark, HasSubstr("36 parameters for 31 samples"));
  EXPECT_THAT(study_text(report), HasSubstr("  " + remark + "\n"));
  EXPECT_THAT(study_csv(report), HasSubstr(",T1 T8 T9,\"" + remark + "\","));
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

TEST(Study, MistakesAreNamedWhereTheyStand) {
  auto const with = [](std::string text, std::string const& what, std::string const& instead) {
    text.replace(text.find(what), what.size(), instead);
    return SmallStudy(text).complaint();
  };
  std::string const all = head + world;
  EXPECT_THAT(with(all, "forward 2", "foward 2"), HasSubstr("small.toml:4:22: no selection method 'foward'; did you"));
  EXPECT_THAT(with(all, "forward 2", "forward two"), HasSubstr("a number of sensors from 1 on is due"));
  EXPECT_THAT(with(all, "forward 2", "all 2"), HasSubstr("all sensors have no number"));
  EXPECT_THAT(with(all, "\"ridge\"", "\"rigde\""), HasSubstr("small.toml:5:21: no model 'rigde'; known: linear, "));
  EXPECT_THAT(with(all, "\"ridge\"", "\"twin rigde\""),
              HasSubstr("small.toml:5:21: no model 'rigde'; known: linear, "));
  EXPECT_THAT(with(all, "\"ridge\"", "\"twins\""), HasSubstr("small.toml:5:21: no model 'twins'; known: "));
  EXPECT_THAT(with(all, "\"ridge\"", "\"linear\""), HasSubstr("small.toml:5:21: 'linear' is given twice"));
  EXPECT_THAT(with(all, "\"ridge\"", "\"linear & rigde\""), HasSubstr("small.toml:5:21: no model 'rigde'; known: "));
  EXPECT_THAT(with(all, "\"ridge\"", "\"linear & \""), HasSubstr("small.toml:5:21: no model ''; known: "));
  EXPECT_THAT(with(all, "\"ridge\"", "\"ridge & ridge\""),
              HasSubstr("small.toml:5:21: 'ridge & ridge' has a model twice"));
  EXPECT_THAT(with(all, "seeds = 5", "seeds = 3"), HasSubstr("'seeds' is 3; allowed is 5 to 1000"));
  EXPECT_THAT(with(all, "E_Z", "E_W"),
              HasSubstr("small.toml:10:9: world 'v450': the machine has no displacement 'E_W'; did you mean"));
  EXPECT_THAT(with(all, "\"T9\"", "\"T19\""),
              HasSubstr("small.toml:11:24: world 'v450': the machine has no sensor 'T19'; did you mean"));
  EXPECT_THAT(with(all, "error =", "eror ="), HasSubstr("small.toml:10:1: unknown key 'eror'; did you mean 'error'"));
  EXPECT_THAT(SmallStudy(all + "[[claim]]\nsays = \"x\"\ncombination = \"all + linear\"\nat_most = 1\ntolerance = 5\n")
                  .complaint(),
              HasSubstr("small.toml:18:13: a 'tolerance' says no worse than another combination; give 'than'"));
  EXPECT_THAT(with(all, "error =", "sampling = \"0 s\"\nerror ="),
              HasSubstr("small.toml:10:12: 'sampling' is 0 s; an interval of more than 0 is due"));
  EXPECT_THAT(with(all, "test =", "instant = [{ experiment = \"slow.toml\", time = \"60 min\" }]\ntest ="),
              HasSubstr("small.toml:13:12: an 'instant' judges the error over an axis, but 'error' is 'E_Z'; give a "
                        "slope, for example \"slope z\""));
  EXPECT_THAT(with(all, "slow.toml", "missing.toml"),
              HasSubstr("small.toml:13:9: world 'v450': 'missing.toml' is not there: "));
  EXPECT_THAT(with(all, "slow.toml", "fast.toml"), HasSubstr("'fast.toml' is in 'train', too"));
  EXPECT_THAT(with(all, "test = [\"slow.toml\"]", ""), HasSubstr("has nothing to test on; give 'test' or 'split'"));
  EXPECT_THAT(with("reference = \"all + liner\"\n" + all, "Small", "Small"),
              HasSubstr("small.toml:1:13: the study has no combination 'all + liner'; did you mean 'all + linear'?"));
  EXPECT_THAT(with(all, "error = \"E_Z\"", "error = \"slope z\""), HasSubstr("no laser measurement of axis 'z'"));
}

TEST(StudyAverages, AreOverStretchesAndSkipWhatIsMissing) {
  output::Dataset data;
  data.time_s = Eigen::VectorXd::LinSpaced(7, 0.0, 90.0);  // every 15 s
  data.readings.push_back({"T", "degC", "", (Eigen::VectorXd(7) << 1, 2, 3, 4, 5, NAN, 7).finished()});
  auto const mean = averaged(data, 30.0);
  EXPECT_EQ(mean.time_s, (Eigen::VectorXd(4) << 0, 30, 60, 90).finished());
  EXPECT_EQ(mean.readings[0].values, (Eigen::VectorXd(4) << 1.5, 3.5, 5, 7).finished());
}

TEST(StudyIntervals, AreStudentsOnes) {
  auto const of = interval({1, 2, 3, 4, 5});
  EXPECT_EQ(of.mean, 3.0);
  EXPECT_NEAR(of.half, 2.7764451 * std::sqrt(2.5 / 5.0), 1e-6);
  EXPECT_EQ(interval({2, NAN}).mean, 2.0);
  EXPECT_EQ(text_of(interval({2})), "2.00");
  EXPECT_EQ(text_of(interval({})), "-");
}

TEST(StudySwitches, CountChangesFromOneSetToTheNext) {
  std::vector<Choice> choices(4);
  choices[0].columns = choices[1].columns = {0, 2};
  choices[2].columns = {1, 2};
  choices[3].columns = {0, 2};
  EXPECT_NEAR(*switch_share({&choices[0], &choices[1], &choices[2], &choices[3]}), 2.0 / 3.0, 1e-12);
  EXPECT_FALSE(switch_share({&choices[0]}));
}

}  // namespace
}  // namespace thermotwin::twin
