#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/remaining_variance.h"

namespace thermotwin::models {

/// A set of sensors.
struct Placement {
  std::vector<Eigen::Index> sensors;  ///< sites, that which tells most first, then that which adds most, …
  double variance = 0.0;              ///< V of the whole set
};

/// At most `count` sensors within the budget, of small V, or, with `dead` > 0, of small V at worst when any `dead` of
/// them are out of work and the estimate knows it.
///
/// Greedy from every site, and from pairs, up to 200 starts (40 in many worlds), those that tell most; then exchanges:
/// each sensor in turn gives way to the best other site, until none does better; the best sets, 24 in one world and 2
/// in many, exchange pairs as well, where there are at most 300 sites (Fedorov 1972; Miller, Subset Selection in
/// Regression, 2002, ch. 3). With dead sensors these sets, and as many that greedy grew whose worst loss is least,
/// exchange once more for that loss. The set does not depend on the number of threads. std::invalid_argument when there
/// are fewer sites than sensors, or no more sensors than dead ones.
[[nodiscard]] Placement place(PlacementProblem const& problem, Eigen::Index count, Eigen::Index dead = 0);

/// The set of smallest V, by looking at all sets: the truth where there are few.
[[nodiscard]] Placement exhaustive_placement(PlacementProblem const& problem, Eigen::Index count);

/// Number of sets that exhaustive_placement looks at: sites over count.
[[nodiscard]] double number_of_sets(Eigen::Index sites, Eigen::Index count);

/// Largest V when any `dead` of the sensors are out of work.
[[nodiscard]] double worst_variance(PlacementProblem const& problem, std::span<Eigen::Index const> sensors,
                                    Eigen::Index dead);

/// The sensors in the order in which they tell most: first alone, then beside those before.
[[nodiscard]] std::vector<Eigen::Index> by_information(PlacementProblem const& problem,
                                                       std::span<Eigen::Index const> sensors);

}  // namespace thermotwin::models
