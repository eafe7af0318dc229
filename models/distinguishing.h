#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace thermotwin::models {

/// What m effects do to the readings of n sites, over all instants of some runs: per site the m × m matrix of the inner
/// products of their courses there. A set of sensors A sees signatures of the Gram matrix G_A = Σ G_i, between which
/// the angle is
///
///   cos φ_ab = |G_A,ab| / √(G_A,aa G_A,bb),
///
/// 0 where no amplitude of the one could be told from some amplitude of the other.
struct Signatures {
  std::vector<Eigen::MatrixXd> gram;                         ///< per site
  std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs;  ///< of effects that are to be told apart
};

/// The pair of effects that a set of sensors tells apart worst.
struct Closest {
  double angle = 0.0;    ///< [rad]
  std::size_t pair = 0;  ///< in Signatures::pairs
};
/// std::invalid_argument where there is no pair.
[[nodiscard]] Closest closest_pair(Signatures const& signatures, std::span<Eigen::Index const> sensors);

/// The angle [rad] of every pair.
[[nodiscard]] Eigen::VectorXd angles(Signatures const& signatures, std::span<Eigen::Index const> sensors);

/// What a sensor costs at each site, and all together at most.
struct Prices {
  Eigen::VectorXd cost;  ///< per site, > 0; empty: all 1
  double budget = std::numeric_limits<double>::infinity();

  [[nodiscard]] double cost_of(Eigen::Index site) const { return cost.size() == 0 ? 1.0 : cost[site]; }
};

/// `count` sites, at most so many within a budget, with a large smallest angle: greedy in Σ 1/sin² φ, then exchanges
/// that widen the smallest angle, from each of several first sites. std::invalid_argument for fewer sites than sensors,
/// and for a budget that buys none.
[[nodiscard]] std::vector<Eigen::Index> place_to_distinguish(Signatures const& signatures, Eigen::Index count,
                                                             Prices const& prices = {});

/// The set of the widest smallest angle, by looking at all sets of `count` sites, within a budget of up to `count`: the
/// truth where there are few. std::invalid_argument as above.
[[nodiscard]] std::vector<Eigen::Index> widest_of_all_sets(Signatures const& signatures, Eigen::Index count,
                                                           Prices const& prices = {});

/// How many sets widest_of_all_sets() looks at, or more where a budget forbids some.
[[nodiscard]] double number_of_sets(Eigen::Index sites, Eigen::Index count, Prices const& prices);

}  // namespace thermotwin::models
