#include "twin/diagnosis/fit.h"

#include <gtest/gtest.h>
#include <vector>

#include "tests/twin/diagnosis/normal_matrix.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using tests::normal;

/// Seven unknowns, of which the third to the fifth are linear: one acts in the first 20 rows alone, one in the last 30.
struct Mixed {
  static constexpr Index rows = 50, first_linear = 2;

  Mixed() {
    linear.col(0).tail(30).setZero();
    linear.col(2).head(20).setZero();
    auto const elimination =
        std::make_shared<Elimination const>(linear, VectorXd::Zero(3), VectorXd::Ones(3), std::vector<Index>{0, 20});
    jacobian = Jacobian(own, priors, elimination, first_linear);
    dense << own.leftCols(2), -linear, own.rightCols(2);
  }

  MatrixXd own = normal(rows, 4, 1), linear = normal(rows, 3, 2), dense{rows, 7};
  VectorXd priors = VectorXd::LinSpaced(7, 1.0, 4.0);
  Jacobian jacobian;
};

TEST(Jacobian, IsTheDenseOneWhereverItsColumnsAreKept) {
  Mixed const mixed;
  EXPECT_EQ(mixed.jacobian.of_data(), mixed.dense);
  for (Index u = 0; u < 7; ++u) EXPECT_EQ(mixed.jacobian.column(u), mixed.dense.col(u)) << u;
}

TEST(Jacobian, MeetsSignalsAsTheDenseOneDoes) {
  Mixed const mixed;
  MatrixXd const signals = normal(Mixed::rows, 5, 3);
  EXPECT_TRUE(mixed.jacobian.transposed_times(signals).isApprox(mixed.dense.transpose() * signals, 1e-12));
  MatrixXd const last = signals.bottomRows(30);
  EXPECT_TRUE(mixed.jacobian.transposed_times(last, 20).isApprox(mixed.dense.bottomRows(30).transpose() * last, 1e-12));
  VectorXd const residual = normal(Mixed::rows + 7, 1, 4);
  VectorXd const expected =
      mixed.dense.transpose() * residual.head(Mixed::rows) + mixed.priors.cwiseProduct(residual.tail(7));
  EXPECT_TRUE(mixed.jacobian.gradient(residual).isApprox(expected, 1e-12));
}

TEST(Jacobian, ForgetsOneUnknownAndNoOther) {
  Mixed mixed;
  mixed.jacobian.forget(5);
  mixed.dense.col(5).setZero();
  EXPECT_EQ(mixed.jacobian.of_data(), mixed.dense);
  EXPECT_EQ(mixed.jacobian.priors()[5], 1.0);
}

}  // namespace
}  // namespace thermotwin::twin
