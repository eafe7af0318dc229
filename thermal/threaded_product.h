#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace thermotwin::thermal {

/// A B of tall dense matrices, on all threads: in fixed blocks of columns, so that the bytes do not depend on how many
/// threads there are.
template <class Left, class Right>
[[nodiscard]] Eigen::MatrixXd threaded_product(Left const& a, Right const& b) {
  constexpr Eigen::Index block = 32, worth_threads = 1 << 20;  // products of two numbers: a fifth of a millisecond
  Eigen::MatrixXd result(a.rows(), b.cols());
  Eigen::Index const blocks = (b.cols() + block - 1) / block;
#pragma omp parallel for schedule(dynamic) if (a.rows() * a.cols() * b.cols() > worth_threads)
  for (Eigen::Index k = 0; k < blocks; ++k) {
    Eigen::Index const first = k * block, count = std::min(block, b.cols() - first);
    result.middleCols(first, count).noalias() = a * b.middleCols(first, count);
  }
  return result;
}

/// AᵀA of a tall dense matrix, by one triangle, likewise.
template <class Matrix>
[[nodiscard]] Eigen::MatrixXd threaded_square(Matrix const& a) {
  constexpr Eigen::Index block = 32, worth_threads = 1 << 21;
  Eigen::Index const columns = a.cols(), blocks = (columns + block - 1) / block;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(columns, columns);
#pragma omp parallel for schedule(dynamic) if (a.rows() * columns * columns > worth_threads)
  for (Eigen::Index k = 0; k < blocks; ++k) {
    Eigen::Index const first = k * block, count = std::min(block, columns - first);
    result.block(first, first, columns - first, count).noalias() =
        a.rightCols(columns - first).transpose() * a.middleCols(first, count);
  }
  return result.template selfadjointView<Eigen::Lower>();
}

}  // namespace thermotwin::thermal
