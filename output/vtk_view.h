#pragma once

#include <Eigen/Core>
#include <string>

#include "output/vtk_page.h"

class vtkCamera;
class vtkRenderWindow;
class vtkRenderer;

/// How pictures look at things and become files; for output/vtk_*.cc only.
namespace thermotwin::output {

inline constexpr Colour faint_ink = {0.52, 0.55, 0.60};
inline constexpr int oversampling = 2;  ///< drawn so many times larger and averaged: smooth edges in software too

/// The part of a renderer that texts leave free, as shares of its width and height.
struct ViewFrame {
  double left = 0.03, right = 0.84, bottom = 0.05, top = 0.86;
};

/// Columns: to the right, away from the viewer, up.
[[nodiscard]] Eigen::Matrix3d axes_of_view(Eigen::Vector3d const& up);

/// Parallel, from the front, right and above; the points fill the frame. Aspect: width over height of the renderer.
void aim(vtkRenderer& renderer, Eigen::Matrix3Xd const& points, Eigen::Vector3d const& up, double aspect,
         ViewFrame const& frame);

/// X, Y and Z in the lower left corner.
void add_axes(vtkRenderWindow& window, vtkCamera& camera, int font_size);

/// What the window shows, `oversampling` times smaller.
[[nodiscard]] std::string as_png(vtkRenderWindow* window);

}  // namespace thermotwin::output
