#pragma once

#include "twin/instruments/laser_interferometer.h"
#include "twin/volumetric/geometric_errors.h"
#include "twin/volumetric/volumetric_description.h"
#include "twin/volumetric/volumetric_model.h"

namespace thermotwin::twin::tests {

/// The volume of the paper's mill.
inline Workspace mill() { return {Eigen::Vector3d::Zero(), Eigen::Vector3d(0.2, 0.2, 0.12)}; }

inline PoseFunction pose_of(GeometricErrors const& errors, KinematicChain chain = KinematicChain::XYFZ,
                            ErrorConvention convention = ErrorConvention::tool_relative,
                            Eigen::Vector3d const& tool = Eigen::Vector3d::Zero()) {
  return [model = VolumetricModel(chain, convention, tool, errors)](Eigen::Vector3d const& q) { return model.pose(q); };
}

/// A laser that shows what is.
inline LaserInterferometer perfect_laser() {
  LaserInterferometer laser;
  laser.air_temperature_error = laser.pressure_error = laser.humidity_error = 0.0;
  laser.noise = laser.resolution = 0.0;
  return laser;
}

inline StepDiagonalDescription perfect_setup() {
  StepDiagonalDescription how;
  how.mirror_misalignment = how.beam_misalignment = how.linear_noise = 0.0;
  return how;
}

}  // namespace thermotwin::twin::tests
