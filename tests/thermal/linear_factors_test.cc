#include "thermal/linear_factors.h"

#include <Eigen/SparseCore>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace thermotwin::thermal {
namespace {

/// Sparse and not symmetric. Where the diagonal is small, its rows are not the pivots'.
Eigen::SparseMatrix<double> matrix(int n, double diagonal, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> draw;
  std::uniform_int_distribution<int> place(0, n - 1);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, diagonal + draw(random));
    for (int k = 0; k < 3; ++k) entries.emplace_back(i, place(random), draw(random));
  }
  Eigen::SparseMatrix<double> result(n, n);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// Right-hand sides go through the factors sixteen at a time; the rest are fewer.
TEST(SparseFactors, SolveColumnsAsTheMatrixSaysHoweverManyThereAre) {
  for (double const diagonal : {10.0, 0.01}) {
    auto const factors = make_linear_factors(LinearSolver::sparse_direct);
    for (bool const again : {false, true}) {  // other numbers, factorised in the order of the first
      auto A = matrix(60, diagonal, 1);
      for (int k = 0; again && k < A.nonZeros(); ++k) A.valuePtr()[k] *= 1.0 + 0.1 * std::sin(double(k));
      ASSERT_TRUE(factors->factorise(A));
      for (int const columns : {0, 1, 15, 16, 17, 32, 61}) {
        NodeByParameter const b = NodeByParameter::Random(60, columns);
        NodeByParameter x = b;
        ASSERT_TRUE(factors->solve_columns(0.0, x));
        EXPECT_LE((A * x - b).norm(), 1e-11 * b.norm()) << diagonal << " " << again << " " << columns;
      }
    }
  }
}

TEST(SparseFactors, SolveAColumnToTheSameBytesWhateverStandsBesideIt) {
  auto const factors = make_linear_factors(LinearSolver::sparse_direct);
  ASSERT_TRUE(factors->factorise(matrix(60, 10.0, 3)));
  NodeByParameter all = NodeByParameter::Random(60, 21);
  NodeByParameter last = all.rightCols(1);
  ASSERT_TRUE(factors->solve_columns(0.0, all) && factors->solve_columns(0.0, last));
  EXPECT_EQ(all.rightCols(1), last);
}

TEST(SparseFactors, SolveNoColumnsOfASingularMatrix) {
  auto const factors = make_linear_factors(LinearSolver::sparse_direct);
  Eigen::SparseMatrix<double> nothing(3, 3);
  EXPECT_FALSE(factors->factorise(nothing));
  NodeByParameter x = NodeByParameter::Ones(3, 2);
  EXPECT_FALSE(factors->solve_columns(0.0, x));
}

}  // namespace
}  // namespace thermotwin::thermal
