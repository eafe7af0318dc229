#include "models/qr_pivot.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "models/candidates.h"

namespace thermotwin::models {

namespace {

constexpr double unexplained_share = 0.01;

/// ‖R₂₂‖² / ‖R‖² after each number of pivots: row i of R is what pivot i explains in all columns.
int pivots_needed(Eigen::MatrixXd const& R) {
  double const total = R.squaredNorm();
  double left = total;
  int count = 0;
  while (left > unexplained_share * total) left -= R.row(count++).squaredNorm();
  return count;
}

}  // namespace

Selection select_by_qr_pivot(std::span<Batch const> batches, SelectionOptions const& options) {
  auto const from = candidates(batches, options);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> const factors(centred(from.all.temperature_rise));
  auto const rows = std::min(from.all.time.size(), from.count());
  Eigen::MatrixXd const R = factors.matrixQR().topRows(rows).triangularView<Eigen::Upper>();
  int const count = options.count.value_or(pivots_needed(R));
  auto const& order = factors.colsPermutation().indices();
  Eigen::VectorXd score = Eigen::VectorXd::Zero(from.count());
  for (Eigen::Index i = 0; i < rows; ++i)
    score(order(i)) = std::abs(R(i, i)) / std::sqrt(static_cast<double>(from.all.time.size() - 1));
  return selection(from, {order.begin(), order.begin() + count}, score,
                   options.count ? "" : fmt::format("{} sensors leave less than 1 % of the readings' variance", count));
}

}  // namespace thermotwin::models
