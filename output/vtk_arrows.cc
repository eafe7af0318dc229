#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkCamera.h>
#include <vtkCubeSource.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3D.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkOutlineFilter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStructuredGrid.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkXMLStructuredGridWriter.h>

#include "output/arrow_field.h"
#include "output/atomic_file.h"
#include "output/display.h"
#include "output/error.h"
#include "output/picture_scale.h"
#include "output/vtk_view.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

using thermal::InputError;

constexpr double longest_arrow = 1.0 / 4.0;  // of the box's diagonal

void check(ArrowField const& field) {
  auto const expected = Eigen::Index(field.points[0]) * field.points[1] * field.points[2];
  if (field.positions.cols() != expected)
    throw InputError(fmt::format("an arrow field of {} × {} × {} points has {} positions", field.points[0],
                                 field.points[1], field.points[2], field.positions.cols()));
  for (auto const& [name, vectors] : field.vectors)
    if (vectors.cols() != expected)
      throw InputError(fmt::format("'{}' has {} vectors for {} points", name, vectors.cols(), expected));
}

Eigen::Matrix3Xd const& vectors_of(ArrowField const& field, std::string const& name) {
  for (auto const& [known, vectors] : field.vectors)
    if (known == name) return vectors;
  throw InputError(fmt::format("the arrow field has no '{}'", name));
}

vtkNew<vtkDoubleArray> array_of(std::string const& name, Eigen::Matrix3Xd const& vectors) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(3);
  for (Eigen::Index i = 0; i < vectors.cols(); ++i) array->InsertNextTuple(vectors.col(i).data());
  return array;
}

/// Numbers of every so many points of an axis, its ends among them.
std::vector<int> kept(int points, int most) {
  int const stride = std::max(1, int(std::ceil(double(points - 1) / std::max(1, most - 1))));
  std::vector<int> numbers;
  int const count = (points - 1) / stride + 1;
  for (int i = 0; i < count; ++i) numbers.push_back(count > 1 ? (points - 1) * i / (count - 1) : 0);
  return numbers;
}

/// The points that carry an arrow.
vtkNew<vtkPolyData> thinned(ArrowField const& field, Eigen::Matrix3Xd const& vectors, int most) {
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> arrows, lengths;
  arrows->SetName("vectors");
  arrows->SetNumberOfComponents(3);
  lengths->SetName("length");
  for (int const k : kept(field.points[2], most))
    for (int const j : kept(field.points[1], most))
      for (int const i : kept(field.points[0], most)) {
        auto const at = (Eigen::Index(k) * field.points[1] + j) * field.points[0] + i;
        places->InsertNextPoint(field.positions.col(at).data());
        arrows->InsertNextTuple(vectors.col(at).data());
        lengths->InsertNextValue(vectors.col(at).norm());
      }
  vtkNew<vtkPolyData> data;
  data->SetPoints(places);
  data->GetPointData()->SetVectors(arrows);
  data->GetPointData()->SetScalars(lengths);
  return data;
}

void add_arrows(vtkRenderer& renderer, vtkPolyData* data, double scale, vtkLookupTable* colours) {
  vtkNew<vtkArrowSource> arrow;
  arrow->SetTipResolution(16);
  arrow->SetShaftResolution(12);
  vtkNew<vtkGlyph3D> glyphs;
  glyphs->SetInputData(data);
  glyphs->SetSourceConnection(arrow->GetOutputPort());
  glyphs->SetVectorModeToUseVector();
  glyphs->SetScaleModeToScaleByVector();
  glyphs->SetColorModeToColorByScalar();
  glyphs->SetScaleFactor(scale);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(glyphs->GetOutputPort());
  mapper->SetLookupTable(colours);
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.5);
  actor->GetProperty()->SetDiffuse(0.55);
  renderer.AddActor(actor);
}

void add_box(vtkRenderer& renderer, Eigen::Matrix3Xd const& points, int width) {
  Eigen::Vector3d const low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
  vtkNew<vtkCubeSource> box;
  box->SetBounds(low[0], high[0], low[1], high[1], low[2], high[2]);
  vtkNew<vtkOutlineFilter> outline;
  outline->SetInputConnection(box->GetOutputPort());
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(outline->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(faint_ink[0], faint_ink[1], faint_ink[2]);
  actor->GetProperty()->SetLineWidth(float(width));
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
}

/// Below the panel.
void add_caption(vtkRenderer& renderer, std::string const& text, int x, int y, int size) {
  vtkNew<vtkTextActor> caption;
  caption->SetInput(text.c_str());
  set_style(*caption->GetTextProperty(), size, true);
  caption->GetTextProperty()->SetJustificationToCentered();
  caption->SetPosition(x, y);
  renderer.AddActor2D(caption);
}

/// Corners of the box with room for the arrows that leave it.
Eigen::Matrix3Xd surroundings(Eigen::Matrix3Xd const& points, double room) {
  Eigen::Matrix3Xd result(3, 2 * points.cols());
  result << points.array() - room, points.array() + room;
  return result;
}

}  // namespace

void write_arrows(ArrowField const& field, std::filesystem::path const& path) {
  check(field);
  vtkNew<vtkStructuredGrid> grid;
  grid->SetDimensions(field.points[0], field.points[1], field.points[2]);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (Eigen::Index i = 0; i < field.positions.cols(); ++i) points->InsertNextPoint(field.positions.col(i).data());
  grid->SetPoints(points);
  for (auto const& [name, vectors] : field.vectors) grid->GetPointData()->AddArray(array_of(name, vectors));
  vtkNew<vtkXMLStructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw OutputError("VTK cannot write the arrows");
  write_atomically(path, writer->GetOutputString());
}

void render_arrows(ArrowField const& field, std::filesystem::path const& path, ArrowPictureOptions const& options) {
  check(field);
  DisplayConnection const display;
  double longest = 0.0;
  for (auto const& name : options.shown)
    longest = std::max(longest, vectors_of(field, name).colwise().norm().maxCoeff());
  double const diagonal = (field.positions.rowwise().maxCoeff() - field.positions.rowwise().minCoeff()).norm();
  double const magnification = longest > 0.0 ? round_down(longest_arrow * diagonal / (1e-6 * longest)) : 1.0;
  auto const ticks = round_ticks(0.0, std::max(longest, 1e-3));
  vtkNew<vtkLookupTable> colours;
  set_viridis(*colours, ticks);

  int const width = oversampling * options.width, height = oversampling * options.height;
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(true);
  window->SetMultiSamples(0);
  window->SetSize(width, height);
  window->SetNumberOfLayers(2);
  vtkNew<vtkRenderer> paper;
  paper->SetBackground(1, 1, 1);
  window->AddRenderer(paper);
  Page page(*paper, width, height);
  if (!options.title.empty()) page.add_line(options.title, 30, true);
  page.add_line("arrows × " + magnification_text(magnification), 24, false);
  page.add_colour_bar(*colours, ticks, "error [µm]");

  constexpr double room_for_bar = 0.14;
  vtkCamera* camera = nullptr;
  for (std::size_t i = 0; i < options.shown.size(); ++i) {
    double const share = (1.0 - room_for_bar) / double(options.shown.size()), left = double(i) * share;
    vtkNew<vtkRenderer> panel;
    panel->SetLayer(1);
    panel->SetViewport(left, 0.0, left + share, 1.0);
    add_box(*panel, field.positions, page.scaled(2));
    auto const arrows = thinned(field, vectors_of(field, options.shown[i]), options.most_arrows);
    add_arrows(*panel, arrows, 1e-6 * magnification, colours);
    window->AddRenderer(panel);
    aim(*panel, surroundings(field.positions, 0.25 * 1e-6 * magnification * longest), Eigen::Vector3d::UnitZ(),
        share * options.width / options.height, {0.04, 0.96, 0.12, 0.86});
    if (i < options.captions.size())
      add_caption(*paper, options.captions[i], int((left + 0.5 * share) * width), page.scaled(70), page.scaled(26));
    camera = panel->GetActiveCamera();
  }
  if (camera) add_axes(*window, *camera, page.scaled(20));
  window->Render();
  write_atomically(path, as_png(window));
}

}  // namespace thermotwin::output
