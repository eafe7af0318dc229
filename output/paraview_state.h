#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "output/fields.h"

namespace thermotwin::output {

/// How ParaView shows a series when it opens the state file (File, Load State).
struct ParaviewView {
  FieldMeaning meaning = FieldMeaning::state;
  double first_s = 0.0, last_s = 0.0;              ///< of the series
  double lowest_degC = 20.0, highest_degC = 40.0;  ///< ends of the colours; of a difference: K
  double magnification = 1000.0;                   ///< of the displacement
  Eigen::Vector3d centre{0.0, 0.0, 0.0};           ///< of the machine [m]
  double size = 1.0;                               ///< its diagonal [m]
  Eigen::Vector3d up{0.0, 0.0, 1.0};
  bool with_sensors = true;  ///< there is a sensors.pvd
};

/// Writes `<directory>/arranged.pvsm`: the fields of FieldSeries deformed and coloured by temperature (viridis), the
/// sensors as red balls in them; of a difference or residual from blue over white to red, the sensors, too; a bar of
/// the colours, and the times of the series to play. The state names its data by absolute paths; where they were moved,
/// ParaView asks. Written for ParaView 5.11. Replaced atomically.
void write_paraview_state(std::filesystem::path const& directory, ParaviewView const& view);

}  // namespace thermotwin::output
