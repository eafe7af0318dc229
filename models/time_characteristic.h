#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/selection.h"

namespace thermotwin::models {

/// How early a sensor reaches its maximum, in two readings of the patent's lost equation (methods.md §4.2). With x the
/// readings of one sensor at m instants:
///
///   at_maximum:     r = Σ_j Int(x_j / max x)           instants spent at the maximum
///   first_maximum:  r = m − j* + 1,  j* = first j with x_j ≥ max x
///
/// Both are equal for readings that rise to their maximum and stay; only the first falls when they leave it again.
enum class TimeRank { at_maximum, first_maximum };

/// r of every sensor (columns), and what breaks ties: the range of its readings.
struct TimeCharacteristic {
  Eigen::VectorXd rank;   ///< p: instants, 0 for a sensor that stands still
  Eigen::VectorXd range;  ///< p: max x − min x [K]
};

/// Readings are rounded to whole multiples of `resolution` first, without which noise makes every maximum a single
/// instant; 0 leaves them as they are (std::invalid_argument below). A sensor that changes most downwards (cooling,
/// maximum ≤ 0) is turned round: x = −ΔT.
TimeCharacteristic time_characteristic(Eigen::MatrixXd const& temperature_rise, double resolution, TimeRank form);

/// Of several runs: ranks and ranges add up.
TimeCharacteristic time_characteristic(std::span<Batch const> batches, double resolution, TimeRank form);

/// Sensors by falling rank, ties by falling range, then in the given order.
std::vector<Eigen::Index> order_of(TimeCharacteristic const& characteristic);

/// rank + range/(1 + largest range): one number that sorts as `order_of` does.
Eigen::VectorXd score_of(TimeCharacteristic const& characteristic);

/// The sensors of best rank (Yin, Liao & Wang, CN 2019106849236). The error is never looked at. Without a count: as
/// many as there are fuzzy clusters by Xie and Beni's index. The remark says when rank separates nothing, as under a
/// drift of the room that moves every maximum to the last instant.
Selection select_by_time_at_maximum(std::span<Batch const> batches, SelectionOptions const& options);
Selection select_by_first_maximum(std::span<Batch const> batches, SelectionOptions const& options);

}  // namespace thermotwin::models
