#include "twin/study/study.h"

#include <Eigen/QR>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/twin/study/small_study.h"
#include "twin/experiment_file.h"
#include "twin/run.h"
#include "twin/study/study_data.h"
#include "twin/study/study_page.h"

namespace thermotwin::twin {
namespace {

using testing::HasSubstr;

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

/// A set of the user's own is judged as a method's choice is; a sensor that models of the world do not see is refused
/// by name, and one that no machine has is a mistake in the file.
TEST(Study, JudgesTheSensorsThatItIsGiven) {
  auto text = head + world;
  text.replace(text.find("\"forward 2\""), 11, "\"sensors T9, T1\", \"sensors T1, T4\"");
  auto const report = SmallStudy(text).report();
  auto const& given = row(report, "sensors T9, T1 + linear");
  EXPECT_EQ(given.sensors, (std::vector<std::string>{"T1", "T9"}));
  EXPECT_EQ(given.figures.at("cross.rmse").size(), 5U);
  auto const& quality = report.selections.at(1).figures;
  EXPECT_GE(quality.at("regret")[0], 0.0);
  EXPECT_FALSE(quality.contains("rank_correlation"));  // it has no score
  EXPECT_EQ(row(report, "sensors T1, T4 + linear").refused,
            "there is no sensor 'T4' here, or it is left out; known: T1, T8, T9");
  text.replace(text.find("T1, T4\""), 6, "T1, T18");
  EXPECT_THAT(SmallStudy(text).complaint(), HasSubstr("small.toml:4:40: 'sensors T1, T18': no world of the study has a "
                                                      "sensor 'T18'; did you mean 'T10'?"));
  text.replace(text.find("sensors T1, T18"), 15, "forward 11");
  EXPECT_THAT(SmallStudy(text).complaint(), HasSubstr("'forward 11': the worlds of the study have 10 sensors at most"));
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
  auto const& deviations = row(report, "forward 2 + linear").deviations;
  ASSERT_EQ(deviations.rows(), 3);
  ASSERT_EQ(deviations.cols(), 5);
  EXPECT_NEAR((deviations.leftCols(3).sum() - deviations.diagonal().sum()) / 6.0, figures.at("Mn")[0], 1e-12);
  EXPECT_NEAR(deviations.rightCols(2).mean(), figures.at("verification.Mn")[0], 1e-12);
}

/// What the information screen and the numbers of classes were judged by stands in the report, and the study says how
/// it is counted.
TEST(Study, ReportsWhatSelectionsWentBy) {
  auto const evidence = [&](std::string const& screening) {
    auto text = head + screening + world;
    text.replace(text.find("\"forward 2\""), 11, "\"mutual_information\", \"ordered_improved\"");
    text.replace(text.find("sensors = "), 29, "");  // all ten
    auto const report = SmallStudy(text).report();
    return std::vector{nlohmann::json::parse(study_json(report))["selections"][1]["evidence"],
                       nlohmann::json::parse(study_json(report))["selections"][2]["evidence"]};
  };
  auto const usual = evidence(""), other = evidence("[screening]\nbins = \"sturges\"\npermutations = 49\n");
  ASSERT_EQ(usual[0].size(), 10U);
  EXPECT_EQ(usual[0][0]["of"], "T1");
  EXPECT_EQ(usual[0][0]["samples"], 31);
  EXPECT_EQ(usual[0][0]["bins"], 2);  // ⌊√(31/5)⌋
  EXPECT_EQ(other[0][0]["bins"], 6);  // ⌈log2 31⌉ + 1
  EXPECT_GE(double(other[0][0]["p"]), 1.0 / 50.0);
  auto const& classes = usual[1].back();
  EXPECT_THAT(std::string(classes["of"]), testing::StartsWith("k = "));
  EXPECT_GE(double(classes["r_squared"]), 0.0);
  for (auto const* p : {"p_F", "p_t", "p_t_autocorrelated"}) EXPECT_LE(double(classes[p]), 1.0) << p;
}

/// The study says how ordered clustering makes readings comparable.
TEST(Study, NormalisesTheReadingsThatItClustersAsItsFileSays) {
  auto const chosen = [&](std::string const& screening) {
    auto text = head + screening + world;
    text.replace(text.find("\"forward 2\""), 11, "\"ordered_improved 3\", \"ordered_ratio 3\", \"ordered_slope 3\"");
    text.replace(text.find("sensors = "), 29, "");  // all ten
    auto const report = SmallStudy(text).report();
    for (auto const* rule : {"ordered_ratio 3", "ordered_slope 3"})
      EXPECT_EQ(row(report, std::string(rule) + " + linear").sensors,
                row(report, "ordered_improved 3 + linear").sensors);
    return row(report, "ordered_improved 3 + linear").sensors;
  };
  auto const usual = chosen("");
  EXPECT_EQ(chosen("[screening]\nnormalisation = \"across_sensors\"\n"), usual);
  EXPECT_NE(chosen("[screening]\nnormalisation = \"over_time\"\n"), usual);
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

/// Two worlds that train on the same: each data set is simulated once, each selection made once for a training set,
/// each screen and clustering once for all selections, each model fitted once to a set of sensors, whoever chose it.
/// Worlds of other errors share what does not look at them: five of eight selections, and the fuzzy clusters. And the
/// second world's figures are the same, whichever error the first asks for.
TEST(Study, MakesOnceWhatIsShared) {
  std::string const shared = R"(
title = "Shared"
seeds = 5
folds = 3
selections = ["all", "sensors T1, T8, T9", "sensors T1, T8", "mutual_information 2", "ordered_slope 2", "ordered_ratio 2",
              "fuzzy_c_means 2", "fuzzy_c_means_shape 2"]
models = ["linear", "ridge", "linear & ridge"]
)";
  auto other = world;
  other.replace(other.find("name = \"v450\""), 13, "name = \"other\"");
  other.replace(other.find("slow.toml"), 9, "slower.toml");
  auto const report_of = [](std::string const& text) {
    SmallStudy const study(text);
    tests::put(study.experiment_path("slower.toml"), fmt::format(fmt::runtime(experiment), "120 min", "2000 rpm"));
    return study.report();
  };
  auto const report = report_of(shared + world + other);
  std::size_t const questions = 5 * (1 + 3);  // seeds, the fit and its folds
  EXPECT_EQ(report.work.runs, 5U * 3);
  EXPECT_EQ(report.work.selections, questions * 8);
  EXPECT_EQ(report.work.clusterings, questions * 4);  // a screen, an ordered clustering, fuzzy ones by height and shape
  EXPECT_EQ(report.work.twins, 0U);
  std::set<std::vector<std::string>> sets;
  for (auto const& one : report.rows) sets.insert(one.sensors);
  EXPECT_LT(sets.size(), 8U);
  EXPECT_GE(report.work.fits, questions * 2 * 2);        // two models on two sets of sensors at least
  EXPECT_LE(report.work.fits, questions * (3 + 1) * 2);  // three pairs of three sensors and all
  EXPECT_EQ(nlohmann::json::parse(study_json(report))["work"]["selections"], questions * 8);
  EXPECT_THAT(study_text(report), HasSubstr("\n15 runs, 160 selections with 80 screens and clusterings, "));
  auto another = world;  // of the same runs
  another.replace(another.find("E_Z"), 3, "E_Y");
  auto const of_two_errors = report_of(shared + another + other);
  EXPECT_EQ(of_two_errors.work.runs, report.work.runs);
  EXPECT_EQ(of_two_errors.work.selections, questions * (8 + 3));
  EXPECT_EQ(of_two_errors.work.clusterings, questions * (4 + 2));
  for (std::size_t i = report.rows.size() / 2; i < report.rows.size(); ++i) {
    EXPECT_EQ(report.rows[i].sensors, of_two_errors.rows[i].sensors);
    EXPECT_EQ(report.rows[i].figures, of_two_errors.rows[i].figures) << report.rows[i].name();
  }
}

/// Beside every selection with every model stand those that are named alone, and no more: what they name first is
/// combined with nothing else. They have the figures that they have in a study that crosses all.
TEST(Study, AddsSingleCombinations) {
  auto const report =
      SmallStudy("also = [\"all + linear & distributed_lag\", \"sensors T1, T9 + distributed_lag\"]\n" + head + world)
          .report();
  std::vector<std::string> names, selections;
  for (auto const& one : report.rows) names.push_back(one.name());
  for (auto const& one : report.selections) selections.push_back(one.selection);
  EXPECT_THAT(names, testing::ElementsAre("all + linear", "all + ridge", "forward 2 + linear", "forward 2 + ridge",
                                          "all + linear & distributed_lag", "sensors T1, T9 + distributed_lag"));
  EXPECT_THAT(selections, testing::ElementsAre("all", "forward 2", "sensors T1, T9"));
  EXPECT_EQ(report.work.fits, 5U * (2 * 2 + 2));  // the mean has one of its halves from the product
  auto crossed = head + world;
  crossed.replace(crossed.find("\"forward 2\""), 11, "\"forward 2\", \"sensors T1, T9\"");
  crossed.replace(crossed.find("\"ridge\""), 7, "\"ridge\", \"distributed_lag\", \"linear & distributed_lag\"");
  auto const all = SmallStudy(crossed).report();
  EXPECT_EQ(all.rows.size(), 3U * 4);
  for (auto const& one : report.rows) {
    EXPECT_EQ(one.sensors, row(all, one.name()).sensors) << one.name();
    EXPECT_EQ(one.figures, row(all, one.name()).figures) << one.name();
  }
}

TEST(Study, RefusedCombinationsStandInTheTable) {
  auto text = head + world;
  text.replace(text.find("\"linear\", \"ridge\""), 17, "\"linear\", \"distributed_lag\"");
  text.replace(text.find("sensors = [\"T1\", \"T8\", \"T9\"]\n"), 29, "");
  auto const report = SmallStudy(text).report();  // 31 readings, 29 of them after the lags
  auto const& refused = row(report, "all + distributed_lag");
  EXPECT_EQ(refused.refused, "in 4 of 5 repetitions, 29 samples are too few for 30 regressors: at least 32");
  EXPECT_THAT(report.remarks,  // there nine sensors are left, and 27 regressors
              testing::Contains("v450: in 1 of 5 repetitions, T10 stands still in fast.toml, and is left out there"));
  EXPECT_TRUE(refused.figures.empty());
  EXPECT_FALSE(row(report, "forward 2 + distributed_lag").figures.empty());
  EXPECT_THAT(study_text(report), HasSubstr("refused: "));
  EXPECT_THAT(study_csv(report), HasSubstr(",distributed_lag,"));
}

/// T10 of v450 shows a room at rest by its last digit: in some draws of golden_b_4000 it never moves. What is refused
/// for it says in how many, and has no figures of the others.
TEST(Study, SaysInHowManyRepetitionsSomethingIsRefused) {
  SmallStudy const small(R"(
title = "T10"
seeds = 5
folds = 0
selections = ["sensors T1, T10", "all"]
models = ["linear"]
[[world]]
name = "v450"
machine = "v450"
error = "E_Z"
train = ["golden_b_4000"]
test = ["golden_b_6000"]
)");
  auto const study = read_study(small.file());
  auto const data = study_data(study, {}, nullptr).front();
  auto const place = std::find(data.sensors.begin(), data.sensors.end(), "T10") - data.sensors.begin();
  auto const still = std::count_if(data.train.begin(), data.train.end(), [&](auto const& runs) {
    auto const rise = runs.front().seen.temperature_rise.col(place);
    return rise.maxCoeff() == rise.minCoeff();
  });
  ASSERT_GT(still, 0);
  ASSERT_LT(still, 5);
  auto const report = run_study(study);
  auto const draws = fmt::format("in {} of 5 repetitions, ", still);
  EXPECT_THAT(report.remarks,
              testing::Contains("v450: " + draws + "T10 stands still in golden_b_4000, and is left out there"));
  auto const& refused = row(report, "sensors T1, T10 + linear");
  EXPECT_THAT(refused.refused, testing::StartsWith(draws + "there is no sensor 'T10' here"));
  EXPECT_TRUE(refused.figures.empty());
  EXPECT_EQ(report.selections.front().remark, "refused: " + refused.refused);
  EXPECT_TRUE(report.selections.front().figures.empty());
  EXPECT_FALSE(report.selections.back().figures.empty());
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

}  // namespace
}  // namespace thermotwin::twin
