#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "models/batch.h"
#include "models/error_model.h"
#include "models/metrics.h"

namespace thermotwin::models {

/// A run of a feed axis: N instants, p sensors, Q positions at which a laser measured the error.
struct AxisRecord {
  std::string name;
  Eigen::VectorXd time;                 ///< N [s]
  std::vector<std::string> sensors;     ///< p
  std::vector<std::string> components;  ///< p
  Eigen::MatrixXd temperature_rise;     ///< N × p [K]
  Eigen::VectorXd position;             ///< Q, P [m]
  Eigen::MatrixXd error;                ///< N × Q [µm]
};

/// E(P) = K P + C at each instant, by least squares over the positions.
struct AxisLines {
  Eigen::VectorXd slope;      ///< N, K [µm/m]
  Eigen::VectorXd intercept;  ///< N, C [µm]
};

/// Refuses records whose sizes disagree, with fewer than two positions, or with a value that is no number
/// (std::invalid_argument).
AxisLines axis_lines(AxisRecord const& record);

/// The record as a batch whose "error" is the slope K(t) [µm/m]: what selections and methods of regression take.
Batch slope_batch(AxisRecord const& record);

/// P₀, the position that does not move, by the mean method: the mean of −C/K over all instants of all records with
/// |K| > `share` of the largest |K| (methods.md §3.7) [m].
double zero_position(std::span<AxisRecord const> records, double share = 0.2);

/// E(P,t) = K(ΔT(t)) (P − P₀) (paper 000, Eq. 7; methods.md §3.7).
struct FeedAxisModel {
  ErrorModel slope;          ///< K [µm/m]
  double zero_position = 0;  ///< P₀ [m]

  /// N × Q errors [µm] at the record's instants and positions.
  [[nodiscard]] Eigen::MatrixXd predict(AxisRecord const& record) const;

  /// Over the positions from `from` to `to` [m] at one instant, as the paper's tables give them.
  [[nodiscard]] Metrics at_instant(AxisRecord const& record, Eigen::Index instant, double from, double to) const;
};

}  // namespace thermotwin::models
