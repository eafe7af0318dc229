// The only file that knows Cairo.
#include <algorithm>
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <memory>
#include <string_view>

#include "output/atomic_file.h"
#include "output/error.h"
#include "output/figure.h"
#include "output/picture_scale.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

constexpr double pt_per_mm = 72.0 / 25.4;
constexpr double font_size = 7.0, rule = 0.5, tick_length = 2.5, gap = 2.5, row_height = 10.0;  // pt
constexpr double row_pitch = 8.0;  // pt, of names one below the other
constexpr char const* font = "DejaVu Sans";

using CairoSurface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Pen = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

cairo_status_t append(void* text, unsigned char const* bytes, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<char const*>(bytes), length);
  return CAIRO_STATUS_SUCCESS;
}

CairoSurface surface_for(std::filesystem::path const& path, double width, double height, std::string& bytes) {
  if (path.extension() == ".svg")
    return {cairo_svg_surface_create_for_stream(append, &bytes, width, height), cairo_surface_destroy};
  if (path.extension() != ".pdf")
    throw thermal::InputError(fmt::format("{}: a figure is written as .svg or .pdf", path.string()));
  CairoSurface surface(cairo_pdf_surface_create_for_stream(append, &bytes, width, height), cairo_surface_destroy);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
  return surface;
}

/// Cairo counts the surfaces of a process in the name of the outermost group.
void forget_count(std::string& svg) {
  constexpr std::string_view mark = "id=\"surface";
  auto const at = svg.find(mark);
  if (at == std::string::npos) return;
  auto const number = at + mark.size();
  svg.erase(number, svg.find('"', number) - number);
}

double width_of(cairo_t* pen, std::string const& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(pen, text.c_str(), &extents);
  return extents.x_advance;
}

/// `across` 0: begins at x, 0.5: centred, 1: ends there; y is the middle of the letters' height.
void write_text(cairo_t* pen, std::string const& text, double x, double y, double across) {
  cairo_font_extents_t extents;
  cairo_font_extents(pen, &extents);
  cairo_move_to(pen, x - across * width_of(pen, text), y + 0.36 * font_size);
  cairo_show_text(pen, text.c_str());
}

void write_upwards(cairo_t* pen, std::string const& text, double x, double y) {
  cairo_save(pen);
  cairo_translate(pen, x, y);
  cairo_rotate(pen, -M_PI / 2);
  write_text(pen, text, 0.0, 0.0, 0.5);
  cairo_restore(pen);
}

/// A true minus, and no trailing zeros.
std::string number_text(double x) {
  std::string text = fmt::format("{:.10g}", std::abs(x) < 1e-12 ? 0.0 : x);
  return text.starts_with('-') ? "\u2212" + text.substr(1) : text;
}

std::vector<double> tick_places(double low, double high) {
  auto const ticks = round_ticks(low, high, 0.0);
  std::vector<double> places;
  for (int i = 0; i < ticks.count; ++i) places.push_back(ticks.first + i * ticks.step);
  return places;
}

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(Eigen::VectorXd const& values) {
    for (double const value : values) add(value);
  }
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

constexpr double largest = 1e300;  ///< that has round numbers around it

/// One that is a point gets room on both sides.
Extent opened(Extent const& extent) {
  if (extent.low < extent.high) return extent;
  double const room = std::max(1.0, 1e-8 * std::abs(extent.low));
  return {extent.low - room, extent.high + room};
}

void check(Figure const& figure) {
  for (auto const& line : figure.lines)
    if (line.x.size() != line.y.size())
      throw thermal::InputError(
          fmt::format("the curve '{}' has {} places and {} values", line.name, line.x.size(), line.y.size()));
}

/// What the axes show: x as far as the data go, y to the next round numbers.
FigureFrame scales_of(Figure const& figure) {
  Extent x, y;
  for (auto const& line : figure.lines) {
    x.add(line.x);
    y.add(line.y);
  }
  for (auto const& band : figure.bands) {
    y.add(band.low);
    y.add(band.high);
  }
  for (auto const& row : figure.rows)
    for (double const value : {row.value, row.low, row.high}) x.add(value);
  if (!figure.rows.empty()) {
    x.add(0.0);
    y = {0.0, double(figure.rows.size())};
  }
  if (x.low > x.high || y.low > y.high) throw thermal::InputError("a figure of no values cannot be drawn");
  if (std::max({-x.low, x.high, -y.low, y.high}) > largest)
    throw thermal::InputError(fmt::format("a figure has no scale for numbers beyond {:g}", largest));
  x = opened(x);
  y = opened(y);
  FigureFrame frame{};
  frame.x_ticks = tick_places(x.low, x.high);
  if (figure.rows.empty()) {
    if (figure.x_range) x = {figure.x_range->first, figure.x_range->second};
    std::erase_if(frame.x_ticks, [&](double t) { return t < x.low - 1e-9 || t > x.high + 1e-9; });
    frame.y_ticks = tick_places(y.low, y.high);
    y = {frame.y_ticks.front(), frame.y_ticks.back()};
  } else {
    x = {frame.x_ticks.front(), frame.x_ticks.back()};
  }
  frame.x_low = x.low;
  frame.x_high = x.high;
  frame.y_low = y.low;
  frame.y_high = y.high;
  return frame;
}

/// Names beside short pieces of their lines, as many in a row as there is room for.
struct KeyEntry {
  FigureLine const* line;
  double x, y;
};

constexpr double sample = 14.0;  // pt

std::vector<KeyEntry> key_of(cairo_t* pen, Figure const& figure, double left, double right) {
  std::vector<KeyEntry> entries;
  double x = left, y = gap + 0.5 * row_height;
  for (auto const& line : figure.lines) {
    if (line.name.empty()) continue;
    double const width = sample + 2 * gap + width_of(pen, line.name);
    if (x > left && x + width > right) {
      x = left;
      y += row_height;
    }
    entries.push_back({&line, x, y});
    x += width + 3 * gap;
  }
  return entries;
}

double y_names_width(cairo_t* pen, Figure const& figure, FigureFrame const& frame) {
  double widest = 0.0;
  for (double const tick : frame.y_ticks) widest = std::max(widest, width_of(pen, number_text(tick)));
  for (auto const& row : figure.rows) widest = std::max(widest, width_of(pen, row.name));
  return widest;
}

class Drawing {
 public:
  Drawing(cairo_t* pen, Figure const& figure, double width, double height)
      : pen_(pen), figure_(figure), frame_(scales_of(figure)) {
    double const label = figure.y_label.empty() ? 0.0 : row_height + gap;
    frame_.left = label + y_names_width(pen, figure, frame_) + tick_length + 2 * gap;
    double const overhang = 0.5 * width_of(pen, number_text(frame_.x_ticks.empty() ? 0.0 : frame_.x_ticks.back()));
    frame_.right = width - std::max(gap, overhang + 1.0);
    frame_.bottom = height - tick_length - 2 * row_height - gap;
    key_ = key_of(pen, figure, frame_.left, frame_.right);
    frame_.top = key_.empty() ? 0.7 * row_height : key_.back().y + 0.5 * row_height + gap;
    check_room();
  }

  FigureFrame draw() {
    draw_grid();
    cairo_save(pen_);
    double const edge = half_of_widest();
    cairo_rectangle(pen_, frame_.left, frame_.top - edge, frame_.right - frame_.left,
                    frame_.bottom - frame_.top + 2.0 * edge);
    cairo_clip(pen_);
    for (auto const& band : figure_.bands) draw_band(band);
    for (auto const& line : figure_.lines) draw_line(line);
    cairo_restore(pen_);
    draw_rows();
    draw_axes();
    draw_key();
    return frame_;
  }

 private:
  void check_room() const {
    double const least_width = figure_.rows.empty() ? 30.0 : 60.0;
    double const least_height = std::max(30.0, row_pitch * double(figure_.rows.size()));
    double const wider = least_width - (frame_.right - frame_.left),
                 higher = least_height - (frame_.bottom - frame_.top);
    std::string needed;
    if (wider > 0.0) needed = fmt::format("a width of {:.0f} mm", std::ceil(figure_.width + wider / pt_per_mm));
    if (higher > 0.0)
      needed += fmt::format("{}a height of {:.0f} mm", needed.empty() ? "" : " and ",
                            std::ceil(figure_.height + higher / pt_per_mm));
    if (!needed.empty())
      throw thermal::InputError(
          fmt::format("a figure of {:g} mm by {:g} mm has no room for its axes and its key: {} is due", figure_.width,
                      figure_.height, needed));
  }

  [[nodiscard]] double at_x(double x) const {
    return frame_.left + (x - frame_.x_low) / (frame_.x_high - frame_.x_low) * (frame_.right - frame_.left);
  }
  [[nodiscard]] double at_y(double y) const {
    return frame_.bottom - (y - frame_.y_low) / (frame_.y_high - frame_.y_low) * (frame_.bottom - frame_.top);
  }

  void ink(std::array<double, 3> const& colour) { cairo_set_source_rgb(pen_, colour[0], colour[1], colour[2]); }

  void stroke(double x0, double y0, double x1, double y1, double width) {
    cairo_set_line_width(pen_, width);
    cairo_move_to(pen_, x0, y0);
    cairo_line_to(pen_, x1, y1);
    cairo_stroke(pen_);
  }

  void draw_grid() {
    ink({0.88, 0.88, 0.88});
    for (double const y : frame_.y_ticks) stroke(frame_.left, at_y(y), frame_.right, at_y(y), 0.35);
    if (!figure_.rows.empty())
      for (double const x : frame_.x_ticks) stroke(at_x(x), frame_.top, at_x(x), frame_.bottom, 0.35);
  }

  void draw_band(FigureBand const& band) {
    ink(band.colour);
    for (Eigen::Index i = 0; i < band.x.size(); ++i) cairo_line_to(pen_, at_x(band.x[i]), at_y(band.high[i]));
    for (Eigen::Index i = band.x.size(); i-- > 0;) cairo_line_to(pen_, at_x(band.x[i]), at_y(band.low[i]));
    cairo_close_path(pen_);
    cairo_fill(pen_);
  }

  void style(FigureLine const& line) {
    ink(line.colour);
    cairo_set_line_width(pen_, line.width);
    cairo_set_dash(pen_, line.dashes.data(), int(line.dashes.size()), 0.0);
  }

  /// A curve along the edge of the frame is as wide as any other.
  [[nodiscard]] double half_of_widest() const {
    double widest = 0.0;
    for (auto const& line : figure_.lines) widest = std::max(widest, line.width);
    return 0.5 * widest;
  }

  void draw_line(FigureLine const& line) {
    style(line);
    cairo_set_line_join(pen_, CAIRO_LINE_JOIN_ROUND);
    bool down = false;
    for (Eigen::Index i = 0; i < line.x.size(); ++i) {
      bool const there = std::isfinite(line.x[i]) && std::isfinite(line.y[i]);
      if (there && down) cairo_line_to(pen_, at_x(line.x[i]), at_y(line.y[i]));
      if (there && !down) cairo_move_to(pen_, at_x(line.x[i]), at_y(line.y[i]));
      down = there;
    }
    cairo_stroke(pen_);
    cairo_set_dash(pen_, nullptr, 0, 0.0);
  }

  /// The first on top.
  void draw_rows() {
    for (std::size_t i = 0; i < figure_.rows.size(); ++i) {
      auto const& row = figure_.rows[i];
      double const y = at_y(double(figure_.rows.size() - i) - 0.5);
      ink({0.0, 0.0, 0.0});
      write_text(pen_, row.name, frame_.left - tick_length - gap, y, 1.0);
      ink({0.0, 0.45, 0.70});
      if (row.high > row.low) stroke(at_x(row.low), y, at_x(row.high), y, 1.0);
      cairo_arc(pen_, at_x(row.value), y, 1.8, 0.0, 2 * M_PI);
      cairo_fill(pen_);
    }
  }

  void draw_axes() {
    ink({0.0, 0.0, 0.0});
    cairo_set_line_width(pen_, rule);
    cairo_move_to(pen_, frame_.left, frame_.top);
    cairo_line_to(pen_, frame_.left, frame_.bottom);
    cairo_line_to(pen_, frame_.right, frame_.bottom);
    cairo_stroke(pen_);
    for (double const x : frame_.x_ticks) {
      stroke(at_x(x), frame_.bottom, at_x(x), frame_.bottom + tick_length, rule);
      write_text(pen_, number_text(x), at_x(x), frame_.bottom + tick_length + 0.5 * row_height, 0.5);
    }
    for (double const y : frame_.y_ticks) {
      stroke(frame_.left, at_y(y), frame_.left - tick_length, at_y(y), rule);
      write_text(pen_, number_text(y), frame_.left - tick_length - gap, at_y(y), 1.0);
    }
    double const half = 0.5 * width_of(pen_, figure_.x_label), rightmost = pt_per_mm * figure_.width - 1.0;
    write_text(pen_, figure_.x_label, std::min(0.5 * (frame_.left + frame_.right), rightmost - half),
               frame_.bottom + tick_length + 1.5 * row_height, 0.5);
    if (!figure_.y_label.empty())
      write_upwards(pen_, figure_.y_label, 0.5 * row_height + 1.0, 0.5 * (frame_.top + frame_.bottom));
  }

  void draw_key() {
    for (auto const& [line, x, y] : key_) {
      style(*line);
      stroke(x, y, x + sample, y, line->width);
      cairo_set_dash(pen_, nullptr, 0, 0.0);
      ink({0.0, 0.0, 0.0});
      write_text(pen_, line->name, x + sample + gap, y, 0.0);
    }
  }

  cairo_t* pen_;
  Figure const& figure_;
  FigureFrame frame_;
  std::vector<KeyEntry> key_;
};

}  // namespace

FigureFrame write_figure(Figure const& figure, std::filesystem::path const& path) {
  check(figure);
  double const width = pt_per_mm * figure.width, height = pt_per_mm * figure.height;
  std::string bytes;
  CairoSurface const surface = surface_for(path, width, height, bytes);
  Pen const pen(cairo_create(surface.get()), cairo_destroy);
  cairo_select_font_face(pen.get(), font, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(pen.get(), font_size);
  auto const frame = Drawing(pen.get(), figure, width, height).draw();
  cairo_show_page(pen.get());
  cairo_surface_finish(surface.get());
  for (auto const status : {cairo_status(pen.get()), cairo_surface_status(surface.get())})
    if (status != CAIRO_STATUS_SUCCESS)
      throw OutputError(fmt::format("{}: Cairo says: {}", path.string(), cairo_status_to_string(status)));
  if (path.extension() == ".svg") forget_count(bytes);
  write_atomically(path, bytes);
  return frame;
}

void set_style(FigureLine& line, std::size_t i) {
  constexpr std::array<std::array<double, 3>, 7> colours = {{{0.00, 0.00, 0.00},
                                                             {0.00, 0.45, 0.70},
                                                             {0.84, 0.37, 0.00},
                                                             {0.00, 0.62, 0.45},
                                                             {0.80, 0.47, 0.65},
                                                             {0.34, 0.71, 0.91},
                                                             {0.90, 0.62, 0.00}}};
  static std::array<std::vector<double>, 3> const dashes = {{{}, {4.0, 2.0}, {1.0, 1.5}}};
  line.colour = colours[i % colours.size()];
  line.dashes = dashes[i / colours.size() % dashes.size()];
}

}  // namespace thermotwin::output
