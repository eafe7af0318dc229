#include "twin/study/judgement.h"

#include <gtest/gtest.h>

namespace thermotwin::twin {
namespace {

using Eigen::Index;

/// A reading a minute of a sensor that stands still, and an error that grows by 1 um from each to the next.
models::Batch growing(Index readings) {
  return {"run",
          Eigen::VectorXd::LinSpaced(readings, 0.0, 60.0 * double(readings - 1)),
          {"T1"},
          {"head"},
          Eigen::MatrixXd::Zero(readings, 1),
          Eigen::VectorXd::LinSpaced(readings, 0.0, double(readings - 1))};
}

/// The same answer always, from the last `readings` of T1: it does not claim the instants that have fewer before them.
models::ErrorModel constant(double value, int readings, double parameters = 1.0) {
  std::vector<int> lags;
  for (int lag = 0; lag < readings; ++lag) lags.push_back(lag);
  models::LinearForm const form{value, lags, Eigen::MatrixXd::Zero(1, readings), readings - 1};
  return {"linear", {"T1"}, 60.0, parameters, form, ""};
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
  auto const figures = judged_instants(axis, data, 0, constant(slope, 1));
  for (auto const* name : {"rmse", "mae", "max"})
    EXPECT_NEAR(figures.at(std::string("run at 15 min.") + name), 0.1 * slope, 1e-9) << name;
}

/// A model of the last three readings, asked row by row: all rows but the first two, as of the whole run.
TEST(StudyJudgement, LeavesOutStretchesOfWhichAModelClaimsNothing) {
  auto const run = growing(10), start = rows_of(run, 0, 2);
  auto const model = constant(0.0, 3);
  Question whole;
  whole.asked.push_back({Role::self, run, run.error, 0, 10});
  whole.asked.push_back({Role::cross, start, start.error, 0, 2});
  std::vector<Question> folds(10);
  std::vector<Answer> validations;
  for (std::size_t k = 0; k < folds.size(); ++k) {
    folds[k].asked.push_back({Role::validation, run, run.error, Index(k), 1});
    validations.push_back({{{&folds[k], &model}}});
  }
  auto const figures = judged({Answer{{{&whole, &model}}}}, validations, 1, 2).figures;
  EXPECT_NEAR(figures.at("self.mae"), 5.5, 1e-12);
  EXPECT_NEAR(figures.at("validation.mae"), 5.5, 1e-12);
  EXPECT_EQ(figures.at("validation.max"), 9.0);
  EXPECT_FALSE(figures.contains("cross.mae"));
  EXPECT_TRUE(figures.contains("S"));
  EXPECT_FALSE(figures.contains("Mn"));
}

/// The probe shows 3 um more than there is. Who chooses by cross-validation does not know; the judgement does.
TEST(StudyJudgement, ValidatesAgainstWhatWasMeasured) {
  auto run = growing(4);
  Eigen::VectorXd const truth = run.error;
  run.error.array() += 3.0;
  auto const model = constant(0.0, 1);
  Question whole, fold;
  whole.asked.push_back({Role::self, run, truth, 0, 4});
  whole.asked.push_back({Role::cross, run, truth, 0, 4});
  fold.asked.push_back({Role::validation, run, truth, 0, 4});
  auto const figures = judged({Answer{{{&whole, &model}}}}, {Answer{{{&fold, &model}}}}, 1, 0).figures;
  EXPECT_NEAR(figures.at("self.mae"), 1.5, 1e-12);
  EXPECT_NEAR(figures.at("cross.mae"), 1.5, 1e-12);
  EXPECT_NEAR(figures.at("validation.mae"), 4.5, 1e-12);
}

/// One says 2 um and claims all, the other what a twin says and 6 um more, and claims all but two instants.
TEST(StudyJudgement, AnswersAreTheMeanOfTheirModels) {
  auto const run = growing(4);
  auto const now = constant(2.0, 1, 1.0), past = constant(6.0, 3, 4.0);
  Question whole, beside_twin;
  whole.asked.push_back({Role::self, run, run.error, 0, 4});
  beside_twin.asked.push_back({Role::self, run, run.error, 0, 4, 0, Eigen::Vector4d(0.0, 2.0, 4.0, 6.0)});
  Answer const answer{{{&whole, &now}, {&beside_twin, &past}}};
  EXPECT_TRUE(answer.predict(0).isApprox(Eigen::Vector4d(4.0, 5.0, 6.0, 7.0), 1e-15));
  EXPECT_EQ(answer.unclaimed_instants(), 2);
  EXPECT_EQ(answer.parameters(), 2.5);
  auto const figures = judged({answer}, {}, 1, 2).figures;
  EXPECT_NEAR(figures.at("self.rmse"), 4.0, 1e-12);
  EXPECT_FALSE(figures.contains("S"));  // nobody has counted the twin's numbers
}

/// Beside a model that claims all but two instants, one that claims all is judged without them, too.
TEST(StudyJudgement, OfAllModelsIsOverTheSameInstants) {
  auto const run = growing(6);
  auto const model = constant(0.0, 1);
  Question whole;
  whole.asked.push_back({Role::self, run, run.error, 0, 6});
  EXPECT_NEAR(judged({Answer{{{&whole, &model}}}}, {}, 1, 0).figures.at("self.mae"), 2.5, 1e-12);
  EXPECT_NEAR(judged({Answer{{{&whole, &model}}}}, {}, 1, 2).figures.at("self.mae"), 3.5, 1e-12);
}

}  // namespace
}  // namespace thermotwin::twin
