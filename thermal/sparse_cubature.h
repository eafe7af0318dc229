#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace thermotwin::thermal {

/// Few columns of A, with weights w > 0, whose weighted sum is the sum of all: ‖A w − A 1‖ ≤ tolerance · ‖A 1‖, or as
/// near as weights ≥ 0 come, or as `most` columns come. Least squares with w ≥ 0, begun with no column and ended as
/// soon as the sum is good: Lawson & Hanson 1974, ch. 23; early end: Farhat, Chapman & Avery, Int. J. Numer. Meth. Eng.
/// 102 (2015) 1077. Ordered by column.
[[nodiscard]] std::vector<std::pair<int, double>> sparse_cubature(Eigen::MatrixXd const& columns, double tolerance,
                                                                  int most);

}  // namespace thermotwin::thermal
