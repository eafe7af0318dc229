#pragma once

#include <array>
#include <string>

#include "output/picture_scale.h"

class vtkLookupTable;
class vtkPolyData;
class vtkRenderer;
class vtkTextProperty;

/// What stands around the machine on a picture: words and the colour bar; for output/vtk_*.cc only.
namespace thermotwin::output {

using Colour = std::array<double, 3>;

inline constexpr Colour ink = {0.13, 0.15, 0.18};

/// 256 colours from dark violet to yellow over the ticks' range: viridis (van der Walt and Smith 2015).
void set_viridis(vtkLookupTable& table, Ticks const& ticks);

void set_style(vtkTextProperty& text, int size, bool bold = false);

/// Sizes follow the page's height: they were chosen at 1000 pixels.
class Page {
 public:
  Page(vtkRenderer& renderer, int width, int height) : renderer_(renderer), width_(width), height_(height) {}

  [[nodiscard]] int scaled(double pixels) const;

  /// Below the last, from the top left.
  void add_line(std::string const& text, int size, bool bold);

  /// At the right, with its ticks and its title.
  void add_colour_bar(vtkLookupTable& colours, Ticks const& ticks, std::string const& title);

 private:
  vtkTextProperty& add_label(std::string const& text, int x, int y, int size, bool bold = false);
  void add_strip(vtkLookupTable& colours, int left, int width, int bottom, int top);
  void add_tick(int x, int y);
  void add_flat(vtkPolyData& shape, vtkLookupTable* colours);

  vtkRenderer& renderer_;
  int width_;
  int height_;
  double top_ = 20.0;
};

}  // namespace thermotwin::output
