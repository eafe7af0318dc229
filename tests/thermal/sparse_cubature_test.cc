#include "thermal/sparse_cubature.h"

#include <gtest/gtest.h>
#include <random>

namespace thermotwin::thermal {
namespace {

Eigen::MatrixXd random_columns(int rows, int columns, unsigned seed) {
  std::mt19937 draw(seed);
  Eigen::MatrixXd result(rows, columns);
  for (int c = 0; c < columns; ++c)
    for (int r = 0; r < rows; ++r) result(r, c) = draw() / 4294967296.0 - (r % 3 == 0 ? 0.5 : 0.2);
  return result;
}

TEST(SparseCubature, FewColumnsWithPositiveWeightsGiveTheSumOfAll) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    auto const columns = random_columns(15, 400, seed);
    auto const chosen = sparse_cubature(columns, 1e-10, 400);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(15);
    for (auto const& [column, weight] : chosen) {
      EXPECT_GT(weight, 0.0);
      sum += weight * columns.col(column);
    }
    Eigen::VectorXd const target = columns.rowwise().sum();
    EXPECT_LT((sum - target).norm(), 1e-9 * target.norm()) << "seed " << seed;
    EXPECT_LE(chosen.size(), 16U) << "seed " << seed;  // no more than there are rows (Carathéodory)
  }
}

TEST(SparseCubature, LooserToleranceTakesFewer) {
  auto const columns = random_columns(60, 300, 7);
  auto const loose = sparse_cubature(columns, 0.1, 300), tight = sparse_cubature(columns, 1e-3, 300);
  EXPECT_LT(loose.size(), tight.size());
  EXPECT_EQ(sparse_cubature(columns, 1e-12, 5).size(), 5U);
}

TEST(SparseCubature, EqualColumnsAreOneWithTheirNumber) {
  Eigen::MatrixXd columns(2, 6);
  columns << 1, 1, 1, 0, 0, 0, 0, 0, 0, 1, 1, 1;
  auto const chosen = sparse_cubature(columns, 1e-9, 6);
  ASSERT_EQ(chosen.size(), 2U);
  EXPECT_NEAR(chosen[0].second, 3.0, 1e-9);
  EXPECT_NEAR(chosen[1].second, 3.0, 1e-9);
}

}  // namespace
}  // namespace thermotwin::thermal
