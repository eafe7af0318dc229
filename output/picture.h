#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/fields.h"
#include "thermal/geometry.h"

namespace thermotwin::output {

/// A sensor as the picture shows it: a dot and its name, in front of everything.
struct SensorMark {
  std::string name;
  Eigen::Vector3d position_m;  ///< on the machine at rest; drawn on the deformed shape
};

struct PictureOptions {
  int width = 1600;   ///< pixels
  int height = 1000;  ///< pixels
  std::string title;
  double time_s = 0.0;
  std::string remark;                         ///< stands in place of the time
  std::string quantity = "temperature [°C]";  ///< what Frame::temperature_degC holds
  /// By which displacements are shown larger; none: so that the largest is about 5 % of the machine, rounded to
  /// 1, 2 or 5 times a power of ten.
  std::optional<double> magnification;
  std::vector<SensorMark> sensors;
  Eigen::Vector3d up{0.0, 0.0, 1.0};  ///< along an axis; with x up, z points right, else x
};

/// Draws the temperature field on the deformed shape, seen from the front, right and above, and the edges of the shape
/// at rest; with colour bar, time, magnification and axes. PNG, replaced atomically.
///
/// Draws off screen but through the X server that DISPLAY names. Throws OutputError when there is none ("run under
/// xvfb-run") or the file cannot be written, thermal::InputError when the frame does not fit the geometry.
void render_picture(thermal::Geometry const& geometry, Frame const& frame, std::filesystem::path const& path,
                    PictureOptions const& options = {});

}  // namespace thermotwin::output
