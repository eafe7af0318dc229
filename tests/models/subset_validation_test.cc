#include "models/subset_validation.h"

#include <Eigen/QR>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

/// Fold by fold, on the rows themselves; folds end before these rows.
double by_hand(Batch const& data, std::vector<Eigen::Index> const& set, std::vector<Eigen::Index> const& ends) {
  auto const n = data.time.size();
  auto const size = Eigen::Index(set.size());
  Eigen::MatrixXd A(n, size + 1);
  A << Eigen::VectorXd::Ones(n), data.temperature_rise(Eigen::all, set);
  double sum = 0;
  Eigen::Index begin = 0;
  for (auto const end : ends) {
    Eigen::MatrixXd train(n - (end - begin), size + 1);
    train << A.topRows(begin), A.bottomRows(n - end);
    Eigen::VectorXd target(n - (end - begin));
    target << data.error.head(begin), data.error.tail(n - end);
    Eigen::VectorXd const b = train.colPivHouseholderQr().solve(target);
    sum += (A.middleRows(begin, end - begin) * b - data.error.segment(begin, end - begin)).squaredNorm();
    begin = end;
  }
  return std::sqrt(sum / double(n));
}

TEST(SubsetValidation, EqualsTheRegressionsItStandsFor) {
  for (Eigen::Index instants : {23, 40, 301})
    for (int folds : {2, 5, 7}) {
      auto const data = random_walks(std::uint64_t(instants), instants, 6);
      SubsetValidation const validation({&data, 1}, folds);
      for (auto const& set : std::vector<std::vector<Eigen::Index>>{{}, {0}, {1, 5}, {4, 0, 2}, {0, 1, 2, 3, 4, 5}}) {
        std::vector<Eigen::Index> ends;
        for (int f = 1; f <= folds; ++f) ends.push_back(f * instants / folds);
        double const expected = by_hand(data, set, ends);
        EXPECT_NEAR(validation.rmse(set), expected, 1e-9 * expected);
      }
    }
}

/// A run is predicted from other runs, not from the rest of itself.
TEST(SubsetValidation, LeavesOutWholeRuns) {
  std::vector const runs{random_walks(1, 30, 4), random_walks(2, 50, 4), random_walks(3, 21, 4)};
  std::vector<Eigen::Index> const set{0, 1, 3};
  double const expected = by_hand(stacked(runs), set, {30, 80, 101});
  EXPECT_NEAR(SubsetValidation(runs).rmse(set), expected, 1e-9 * expected);
}

TEST(SubsetValidation, DoesNotMindUnitsAndOffsets) {
  auto data = random_walks(3, 60, 4);
  std::vector<Eigen::Index> const set{0, 2, 3};
  double const before = SubsetValidation({&data, 1}).rmse(set);
  data.temperature_rise.col(2) = 1e6 * data.temperature_rise.col(2).array() + 1e7;
  data.error.array() += 1e4;
  EXPECT_NEAR(SubsetValidation({&data, 1}).rmse(set), before, 1e-6 * before);
}

TEST(SubsetValidation, GivesASensorThatRepeatsOthersNoCoefficient) {
  auto data = random_walks(3, 60, 4);
  data.temperature_rise.col(3) = 2 * data.temperature_rise.col(0) - data.temperature_rise.col(1);
  SubsetValidation const validation({&data, 1});
  std::vector<Eigen::Index> const without{0, 1}, with{0, 1, 3};
  EXPECT_NEAR(validation.rmse(with), validation.rmse(without), 1e-9);
}

TEST(SubsetValidation, RefusesTooFewInstants) {
  auto const data = random_walks(3, 10, 8);
  SubsetValidation const validation({&data, 1});  // 8 instants remain for training
  EXPECT_EQ(validation.largest_set(), 6);
  std::vector<Eigen::Index> const six{0, 1, 2, 3, 4, 5}, seven{0, 1, 2, 3, 4, 5, 6};
  EXPECT_NO_THROW((void)validation.rmse(six));
  try {
    (void)validation.rmse(seven);
    FAIL();
  } catch (std::invalid_argument const& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("10 instants are too few to validate 7 sensors"));
  }
  EXPECT_THROW((void)SubsetValidation({&data, 1}, 1), std::invalid_argument);
  EXPECT_THROW((void)SubsetValidation({&data, 1}, 11), std::invalid_argument);
}

}  // namespace
}  // namespace thermotwin::models
