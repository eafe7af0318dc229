#pragma once

#include <string>

#include "twin/volumetric/error_field.h"
#include "twin/volumetric/nine_functions.h"

namespace thermotwin::twin {

/// What a controller adds to the command, at the points of a grid: c = −E predicted, rounded to its resolution;
/// trilinear between the points, held beyond the ends.
struct CompensationTable {
  VolumeGrid grid;
  Eigen::Matrix3Xd corrections;  ///< in the order of grid.positions() [m]

  [[nodiscard]] Eigen::Vector3d at(Eigen::Vector3d const& q) const;
};

/// `resolution` [m]; 0: none.
[[nodiscard]] CompensationTable compensation_table(NineFunctions const& predicted, VolumeGrid const& grid,
                                                   double resolution);

/// The machine with that table in its controller: pose(q + c(q)).
[[nodiscard]] PoseFunction compensated(PoseFunction pose, CompensationTable table);

/// "x_mm,y_mm,z_mm,dx_um,dy_um,dz_um", a line per point.
[[nodiscard]] std::string grid_csv(CompensationTable const& table);

/// Nine cross-error tables, one per pair of input and output axis, in the layout that SINUMERIK controllers read for
/// interpolatory compensation ($AN_CEC…; Siemens, Extended Functions, K3). Values in mm; the grid's points along each
/// axis. Their sum is the whole correction since it is a sum of functions of one coordinate; the zero of each is the
/// axis' start.
[[nodiscard]] std::string cross_error_tables(NineFunctions const& predicted, VolumeGrid const& grid, double resolution);

}  // namespace thermotwin::twin
