#pragma once

#include <limits>
#include <string>
#include <vector>

namespace thermotwin::scenarios {

/// What a feed programme must know of an axis.
struct AxisLimits {
  std::string name = "z";
  double rapid_feed = 0.0;   ///< fastest feed [m/s]
  double lead = 0.01;        ///< of the screw: travel per revolution [m]
  double stroke_from = 0.0;  ///< ends of the nut's stroke, where a programme names none [m]
  double stroke_to = 0.0;
  /// Beyond which no stroke goes; infinite: the machine has no screw on it [m]
  double screw_length = std::numeric_limits<double>::infinity();
};

/// What an experiment must know of the machine.
struct MachineLimits {
  double max_spindle_speed = 0.0;  ///< [rad/s]; 0: the machine has no spindle
  std::vector<AxisLimits> axes;
  std::vector<std::string> shares{};  ///< channels that parts take as a share, from 0 (off) to 1 (on)
};

}  // namespace thermotwin::scenarios
