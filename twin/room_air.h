#pragma once

#include <Eigen/Core>
#include <span>

#include "thermal/operating_point.h"
#include "thermal/physical_constant.h"

namespace thermotwin::twin {

class Machine;

/// Of every node over the machine's zero [m]; 0 of what has no place.
[[nodiscard]] Eigen::VectorXd heights_of_nodes(Machine const& machine);

/// Where displacements meet the air: near the tool, over the machine's zero [m].
inline constexpr double height_near_tool = 1.0;

/// The room's air as a course has it, T(h) = T_floor + γ h over the machine's zero. A course that does not say is at
/// 20 °C, without a gradient.
class RoomAir {
 public:
  RoomAir() = default;
  explicit RoomAir(thermal::Course const& course)
      : floor_(course.index_of("ambient.floor_temperature")), gradient_(course.index_of("ambient.gradient")) {}

  /// From the values of the course's channels [K].
  [[nodiscard]] double at(double height, std::span<double const> inputs) const {
    double const floor = floor_ < 0 ? thermal::reference_temperature : inputs[std::size_t(floor_)];
    return floor + (gradient_ < 0 ? 0.0 : inputs[std::size_t(gradient_)]) * height;
  }

 private:
  int floor_ = -1, gradient_ = -1;
};

}  // namespace thermotwin::twin
