#include "twin/study/question.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "models/training_set.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;

/// A run whose errors say which row of which run they are of: 1000 × run + row. Its two sensors warm up from rest.
StudyRun run_of(int number, Index rows) {
  models::Batch batch{"run",
                      Eigen::VectorXd::LinSpaced(rows, 0.0, 60.0 * double(rows - 1)),
                      {"T1", "T2"},
                      {"head", "bed"},
                      Eigen::MatrixXd(rows, 2),
                      {}};
  auto const row = Eigen::ArrayXd::LinSpaced(rows, 0.0, double(rows - 1));
  batch.temperature_rise << 9.0 * (1.0 - (-row / 10.0).exp()), 5.0 * (1.0 - (-row / 30.0).exp());
  batch.error = 1000.0 * number + row;
  return {batch, {}, {}, {}, {}};
}

WorldData runs_of(std::vector<Index> const& rows) {
  WorldData data;
  data.train.resize(1);
  data.test.resize(1);
  for (std::size_t k = 0; k < rows.size(); ++k) data.train[0].push_back(run_of(int(k), rows[k]));
  return data;
}

std::multiset<double> trained_on(Question const& question) {
  std::multiset<double> errors;
  for (auto const& batch : question.training) errors.insert(batch.error.begin(), batch.error.end());
  return errors;
}

std::multiset<double> asked_for(Question const& question) {
  std::multiset<double> errors;
  for (auto const& asked : question.asked) {
    auto const stretch = asked.batch.error.segment(asked.first, asked.count);
    errors.insert(stretch.begin(), stretch.end());
  }
  return errors;
}

/// No fold is learnt from, and all else is; together the folds are all rows, each once.
void expect_folds_of(std::vector<Question> const& validations, std::multiset<double> const& all) {
  std::multiset<double> asked;
  for (auto const& question : validations) {
    auto both = trained_on(question);
    asked.merge(asked_for(question));
    both.merge(asked_for(question));
    EXPECT_EQ(both, all) << question.name;
    for (auto const& one : question.asked) EXPECT_EQ(one.role, Role::validation);
  }
  EXPECT_EQ(asked, all);
}

TEST(StudyQuestions, FoldsOfOneRunTrainOnWhatTheyDoNotAsk) {
  auto const asked = questions({}, runs_of({90}), 0, 4);
  ASSERT_EQ(asked.validations.size(), 4U);
  expect_folds_of(asked.validations, trained_on(asked.fits.front()));
}

TEST(StudyQuestions, FoldsOfSeveralRunsTrainOnOtherRuns) {
  auto const asked = questions({}, runs_of({30, 50, 20, 40, 30}), 0, 3);
  ASSERT_EQ(asked.validations.size(), 3U);
  expect_folds_of(asked.validations, trained_on(asked.fits.front()));
  for (auto const& question : asked.validations)
    for (auto const& one : question.asked) EXPECT_EQ(one.count, one.batch.time.size());
}

/// The last of four runs is the second: alone, by folds that part the two, and by models of each.
TEST(StudyQuestions, SayWhichTrainingRunsHoldTheSameData) {
  auto data = runs_of({30, 50, 20, 40});
  for (std::size_t k = 0; k < 4; ++k) data.train[0][k].seen.name = "run " + std::to_string(k);
  EXPECT_THAT(questions({}, data, 0, 4).remarks, testing::IsEmpty());
  data.train[0][3].seen.time = data.train[0][1].seen.time;
  data.train[0][3].seen.temperature_rise = data.train[0][1].seen.temperature_rise;
  data.train[0][3].seen.error = 1.001 * data.train[0][1].seen.error;
  EXPECT_THAT(questions({}, data, 0, 4).remarks, testing::IsEmpty());
  data.train[0][3].seen.error = data.train[0][1].seen.error;
  std::string const said = "run 3 has the same data as run 1; they count once more";
  EXPECT_THAT(questions({}, data, 0, 0).remarks, testing::ElementsAre(said));
  EXPECT_THAT(questions({}, data, 0, 4).remarks,
              testing::ElementsAre(said + ", and where cross-validation leaves out one, it learns from the other"));
  StudyWorld each;
  each.fit = "each";
  EXPECT_THAT(questions(each, data, 0, 4).remarks,
              testing::ElementsAre("run 3 has the same data as run 1; neither tests the other's models"));
}

/// What lies behind the cut is asked by no fold, and learnt from by none.
TEST(StudyQuestions, FoldsOfARunThatIsCutStayBeforeTheCut) {
  StudyWorld world;
  world.split = 60.0 * 60.0;
  auto const asked = questions(world, runs_of({90}), 0, 3);
  ASSERT_EQ(asked.validations.size(), 3U);
  auto const before = trained_on(asked.fits.front());
  EXPECT_EQ(before.size(), 60U);
  expect_folds_of(asked.validations, before);
}

/// Nor does the machine rest behind a fold: what a model with lags learns from there are rows of the run.
TEST(StudyQuestions, RowsBehindAFoldHaveTheLagsOfTheRun) {
  auto const data = runs_of({90});
  std::vector<int> const lags{0, 5, 40};
  auto const whole = models::training_set(std::vector{data.train[0][0].seen}, lags, models::History::rest);
  for (auto const& question : questions({}, data, 0, 4).validations) {
    auto const set = models::training_set(question.training, lags, models::History::rest);
    EXPECT_EQ(set.run_lengths.size(), 1U);
    for (Index i = 0; i < set.error.size(); ++i)  // the error is the row's number
      EXPECT_EQ(set.regressors.row(i), whole.regressors.row(Index(set.error(i)))) << question.name << " row " << i;
  }
}

}  // namespace
}  // namespace thermotwin::twin
