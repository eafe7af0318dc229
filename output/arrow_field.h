#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace thermotwin::output {

/// Vectors on a regular grid of points, x fastest.
struct ArrowField {
  std::array<int, 3> points{};                                    ///< along x, y, z
  Eigen::Matrix3Xd positions;                                     ///< [m]
  std::vector<std::pair<std::string, Eigen::Matrix3Xd>> vectors;  ///< name with unit, one column per point [µm]
};

/// Writes a VTK structured grid (.vts), which ParaView shows as arrows by its filter Glyph; coordinates in metre, the
/// vectors as point data. Replaced atomically. thermal::InputError when a length does not fit.
void write_arrows(ArrowField const& field, std::filesystem::path const& path);

struct ArrowPictureOptions {
  std::string title = {};
  std::vector<std::string> shown = {};     ///< names of vectors: one panel each, side by side, same scale
  std::vector<std::string> captions = {};  ///< of the panels
  int width = 1800;                        ///< pixels
  int height = 1000;                       ///< pixels
  int most_arrows = 6;                     ///< along an axis; of more points some are left out, evenly
};

/// Draws arrows in the box of the grid, all panels with one magnification and one colour scale: 1, 2 or 5 times a power
/// of ten, so that the largest vector is at most a quarter of the box's diagonal. PNG, replaced atomically; like
/// render_picture it needs a display.
void render_arrows(ArrowField const& field, std::filesystem::path const& path, ArrowPictureOptions const& options);

}  // namespace thermotwin::output
