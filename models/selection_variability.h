#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace thermotwin::models {

/// How much the chosen points depend on the batch they were chosen from, the "variability of temperature-sensitive
/// points" of paper 004 (methods.md §7.4): the share of the sets, from the second on, that are not the one before.
/// Order within a set does not count. None for fewer than two.
[[nodiscard]] std::optional<double> switch_share(std::span<std::vector<Eigen::Index> const> sets);

}  // namespace thermotwin::models
