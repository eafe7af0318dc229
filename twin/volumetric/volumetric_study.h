#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "output/dataset.h"
#include "twin/volumetric/compensation_table.h"
#include "twin/volumetric/field_prediction.h"
#include "twin/volumetric/identification.h"
#include "twin/volumetric/verification.h"
#include "twin/volumetric/volumetric_machine.h"

namespace thermotwin::twin {

struct VolumetricOptions {
  std::uint64_t seed = 1;  ///< of the measurement
  bool plain = false;      ///< compensate by the plain identification: to see what that does
  std::string method = "ls_svm_chosen";
  double resolution = 0.1e-6;            ///< of the controller [m]
  output::Dataset const* run = nullptr;  ///< a run of the same machine, for its drift
  double measured_at = 0.0;              ///< instant of the run at which the machine is measured [s]
};

/// The machine at an instant of a run, with the table that was made when it was measured.
struct Drift {
  double time = 0.0;              ///< [s]
  double moved = 0.0;             ///< largest change of the error field since it was measured [m]
  double uncompensated = 0.0;     ///< largest error of the grid without rigid motion [m]
  double compensated = 0.0;       ///< likewise [m]
  Eigen::Vector3d squareness;     ///< S_xy, S_xz, S_yz of the nine functions [rad]
  Eigen::Vector3d linear_totals;  ///< error of the whole travel of X, Y, Z [m]
};

struct ScoredPrediction {
  FieldPrediction prediction;
  PredictionScore score;
};

/// A machine measured, identified, predicted, compensated and verified.
struct VolumetricStudy {
  VolumetricMachine machine;
  StepDiagonals measured;
  Eigen::Vector3d linear_totals;
  PlainIdentification plain;
  JointIdentification joint;
  NineFunctions truth;  ///< along the edges at `from`
  std::vector<std::string> remarks;
  std::vector<ScoredPrediction> predictions;  ///< every method
  FieldPrediction chosen;
  CompensationTable table;
  Verification verification;
  ErrorField before, after;  ///< true, on the grid, without rigid motion
  std::vector<Drift> drift;
};

[[nodiscard]] VolumetricStudy study_volume(VolumetricMachine const& machine, VolumetricOptions const& options);

}  // namespace thermotwin::twin
