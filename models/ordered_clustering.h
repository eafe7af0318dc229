#pragma once

#include <Eigen/Core>
#include <vector>

namespace thermotwin::models {

/// How readings are made comparable before they are clustered (methods.md §3.3). Objects are sensors, variables
/// instants.
enum class Normalisation {
  across_sensors,  ///< z_ab = (x_ab − min_a x_ab) / (max_a x_ab − min_a x_ab): at each instant, between the sensors
  over_time,       ///< between each sensor's own least and largest reading: keeps the shape, not the amplitude
  z_score,         ///< at each instant, less the sensors' mean, over their deviation
};

/// One row per sensor, one column per instant, from readings of one column per sensor. Instants at which all sensors
/// agree (ΔT = 0 at the start) have no range and are dropped, for any of the three.
Eigen::MatrixXd normalised(Eigen::MatrixXd const& temperature_rise, Normalisation how = Normalisation::across_sensors);

/// Columns by rising mean reading: the order in which classes must be contiguous. Of equal ones the first goes first.
std::vector<Eigen::Index> ascending(Eigen::MatrixXd const& temperature_rise);

/// D(a, c) = Σ_{i=a..c} ‖z_i − z̄(a, c)‖² of the objects (rows) a to c; upper triangle of l × l.
Eigen::MatrixXd class_diameters(Eigen::MatrixXd const& objects);

/// The partitions of l ordered objects into k contiguous classes whose diameters have the least sum (W. D. Fisher,
/// JASA 53 (1958) 789; methods.md §3.4), for every k from 1 to l:
///
///     ψ*(1, m) = D(1, m),   ψ*(k, m) = min_{k ≤ j ≤ m} ψ*(k−1, j−1) + D(j, m)
///
/// Of equal sums the smallest j counts. O(l³).
class OrderedPartitions {
 public:
  explicit OrderedPartitions(Eigen::MatrixXd const& diameters);

  /// ψ*(k, l) at index k − 1.
  [[nodiscard]] Eigen::VectorXd const& loss() const { return loss_; }
  /// The objects of each of the k classes, in order.
  [[nodiscard]] std::vector<std::vector<Eigen::Index>> classes(int k) const;

 private:
  Eigen::VectorXd loss_;
  Eigen::MatrixXi last_begin_;  ///< J(k, m): where the last of k classes of the first m + 1 objects begins
};

}  // namespace thermotwin::models
