#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/selection.h"

namespace thermotwin::models {

/// One joining of a hierarchical clustering: group `second` goes into group `first`, both named by their first member.
struct Merge {
  Eigen::Index first, second;  ///< first < second
  double distance;
};

/// Average linkage (UPGMA, Sokal & Michener 1958): the two groups whose members are nearest on average are joined,
/// until one is left; n − 1 merges by rising distance. Of equal distances the first pair counts.
std::vector<Merge> average_linkage(Eigen::MatrixXd const& distance);

/// Group number, 0 … count − 1 in the order of first members, of each point after all but the last count − 1 merges.
std::vector<Eigen::Index> groups_of(std::vector<Merge> const& merges, Eigen::Index count);

/// The classical grouping: average linkage of the sensors on 1 − |r|, r their correlation; in each group the sensor
/// whose |r| with the error is largest, which is its score. Without a count: as many groups as stay when groups of mean
/// |r| ≥ 0.9 are joined.
Selection select_by_correlation(std::span<Batch const> batches, SelectionOptions const& options);

}  // namespace thermotwin::models
