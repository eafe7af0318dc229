#include "twin/diagnosis/elimination.h"

#include <Eigen/QR>
#include <gtest/gtest.h>
#include <random>

namespace thermotwin::twin {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd drawn(Eigen::Index rows, Eigen::Index columns, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  MatrixXd result(rows, columns);
  for (auto& entry : result.reshaped()) entry = normal(random);
  return result;
}

/// r − J x for x that is searched, S b for b that is eliminated, against one regression for both.
struct EliminationOfSome : testing::Test {
  std::mt19937_64 random{3};
  MatrixXd J = drawn(60, 4, random), S = drawn(60, 7, random);
  VectorXd r = drawn(60, 1, random), mean = drawn(7, 1, random), deviation = drawn(7, 1, random).cwiseAbs() * 0.2;
  Elimination elimination{S, mean, deviation, {0}};
  MatrixXd whole = MatrixXd::Zero(67, 11);  ///< of residuals and priors, of x and b
  VectorXd wanted = VectorXd::Zero(67);

  EliminationOfSome() {
    whole.topLeftCorner(60, 4) = J;
    whole.topRightCorner(60, 7) = S;
    whole.bottomRightCorner(7, 7) = deviation.cwiseInverse().asDiagonal();
    wanted << r, mean.cwiseQuotient(deviation);
  }
};

TEST_F(EliminationOfSome, EliminatedAreAtTheirBestForTheOthers) {
  VectorXd const b = elimination.best(r);
  VectorXd const expected = whole.rightCols(7).colPivHouseholderQr().solve(wanted);
  EXPECT_LT((b - expected).norm(), 1e-10 * expected.norm());
  EXPECT_NEAR((r - S * b).squaredNorm() + elimination.prior_cost(b),
              (wanted - whole.rightCols(7) * expected).squaredNorm(), 1e-9);
}

/// Blocks of rows are the same question: of the seven, three act in the first twenty rows only, two in the last,
/// and none in ten.
TEST_F(EliminationOfSome, BlocksOfRowsChangeNothing) {
  S.bottomLeftCorner(40, 3).setZero();
  S.topRightCorner(55, 2).setZero();
  S.middleRows(30, 10).setZero();
  Elimination const one(S, mean, deviation, {0}), blocks(S, mean, deviation, {0, 20, 30, 40, 55});
  EXPECT_LT((blocks.information() - one.information()).norm(), 1e-13 * one.information().norm());
  EXPECT_LT((blocks.best(r) - one.best(r)).norm(), 1e-12 * one.best(r).norm());
  EXPECT_LT((blocks.shared(J) - S.transpose() * J).norm(), 1e-13 * J.norm() * S.norm());
  EXPECT_LT((blocks.effect_of(mean) - S * mean).norm(), 1e-13 * S.norm() * mean.norm());
}

/// One step with what the elimination leaves of the normal equations ends where the regression for both does.
TEST_F(EliminationOfSome, WhatIsLeftOfTheNormalEquationsFindsTheOthers) {
  VectorXd const left = r - S * elimination.best(r);
  VectorXd const x = elimination.curvature(J.transpose() * J, elimination.shared(J)).llt().solve(J.transpose() * left);
  VectorXd const expected = whole.colPivHouseholderQr().solve(wanted);
  EXPECT_LT((x - expected.head(4)).norm(), 1e-10 * expected.norm());
  EXPECT_LT((elimination.best(r - J * x) - expected.tail(7)).norm(), 1e-10 * expected.norm());
}

}  // namespace
}  // namespace thermotwin::twin
