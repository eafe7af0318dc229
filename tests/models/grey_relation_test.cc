#include "models/grey_relation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

MatrixXd golden_columns() { return (MatrixXd(5, 3) << 0, 0, 4, 1, 2, 3, 2, 3, 2, 3, 3.5, 1, 4, 4, 0).finished(); }

VectorXd golden_reference() { return VectorXd::LinSpaced(5, 0, 4); }

TEST(GreyRelation, GoldenGrades) {
  VectorXd const grades = grey_relational_grades(golden_columns(), golden_reference());
  EXPECT_NEAR(grades(0), 1.000, 1e-12);
  EXPECT_NEAR(grades(1), (1 + 2.0 / 3 + 2.0 / 3 + 0.8 + 1) / 5, 1e-12);
  EXPECT_NEAR(grades(1), 0.827, 0.0005);
  EXPECT_NEAR(grades(2), 0.533, 0.0005);
}

TEST(GreyRelation, AlignedSignsTurnTheFallingSeriesRound) {
  VectorXd const grades = grey_relational_grades(golden_columns(), golden_reference(), {.align_signs = true});
  EXPECT_NEAR(grades(2), 1.0, 1e-12);
  EXPECT_NEAR(grades(1), grey_relational_grades(golden_columns(), -golden_reference(), {.align_signs = true})(1),
              1e-12);
}

TEST(GreyRelation, ScaledByTheMean) {
  MatrixXd const x = (MatrixXd(3, 2) << 2, 1, 2, 2, 2, 3).finished();
  VectorXd const grades = grey_relational_grades(x, Eigen::Vector3d(1, 2, 3), {.scaling = GreyScaling::mean});
  EXPECT_NEAR(grades(0), 5.0 / 9, 1e-12);
  EXPECT_NEAR(grades(1), 1.0, 1e-12);
}

/// What falls as the reference rises about the same mean is its mirror image, and its equal when turned round.
TEST(GreyRelation, AlignedSignsTurnASeriesScaledByItsMeanRound) {
  MatrixXd const x = (MatrixXd(3, 2) << 3, 1, 2, 2, 1, 3).finished();
  Eigen::Vector3d const y(1, 2, 3);
  auto const grades = [&](VectorXd const& reference, bool align) {
    return grey_relational_grades(x, reference, {.scaling = GreyScaling::mean, .align_signs = align});
  };
  EXPECT_LT(grades(y, false)(0), 0.9);
  EXPECT_NEAR(grades(y, true)(0), 1.0, 1e-12);
  EXPECT_NEAR(grades(y, true)(1), 1.0, 1e-12);
  EXPECT_NEAR(grades(-y, true)(0), 1.0, 1e-12);  // of mean −2: the scaled reference rises as y does
}

TEST(GreyRelation, GradesDependOnTheSetAndOnTheResolution) {
  VectorXd const y = golden_reference();
  MatrixXd const all = golden_columns();
  EXPECT_GT(grey_relational_grades(all, y)(1), grey_relational_grades(all.leftCols(2), y)(1) + 0.05);
  EXPECT_GT(grey_relational_grades(all, y, {.resolution = 1})(1), grey_relational_grades(all, y)(1));
  EXPECT_EQ(grey_relational_grades(all.leftCols(1), y)(0), 1.0);
}

TEST(GreyRelation, ChoosesTheTwoOfHighestGradeUnlessACountIsGiven) {
  MatrixXd rise(5, 4);
  rise << golden_columns(), (VectorXd(5) << 0, 3, 1, 4, 2).finished();
  Batch const batch = batch_of(rise, golden_reference());
  EXPECT_THAT(select_by_grey_relation({&batch, 1}, {}).sensors, ElementsAre(0, 2));
  EXPECT_THAT(select_by_grey_relation({&batch, 1}, {.count = 3}).sensors, ElementsAre(0, 2, 1));
  auto const one = select_by_grey_relation({&batch, 1}, {.count = 1});
  EXPECT_THAT(one.sensors, ElementsAre(0));
  EXPECT_LT(one.score(3), one.score(1));
}

TEST(GreyRelation, RefusesWhatItCannotCompare) {
  auto const says = [](char const* text) { return ThrowsMessage<std::invalid_argument>(HasSubstr(text)); };
  VectorXd const y = golden_reference();
  EXPECT_THAT([&] { grey_relational_grades(golden_columns(), y.head(4)); }, says("5 rows with 4"));
  EXPECT_THAT([&] { grey_relational_grades(MatrixXd::Ones(5, 1), y); }, says("never moves"));
  EXPECT_THAT([&] { grey_relational_grades(golden_columns(), y.array() - 2, {.scaling = GreyScaling::mean}); },
              says("mean 0"));
  EXPECT_THAT([&] { grey_relational_grades(golden_columns(), y, {.resolution = 0}); }, says("resolution 0"));
}

}  // namespace
}  // namespace thermotwin::models
