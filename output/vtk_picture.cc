#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkDoubleArray.h>
#include <vtkFeatureEdges.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>
#include <vtkUnstructuredGrid.h>

#include "output/atomic_file.h"
#include "output/display.h"
#include "output/label_places.h"
#include "output/picture.h"
#include "output/picture_scale.h"
#include "output/vtk_grid.h"
#include "output/vtk_page.h"
#include "output/vtk_view.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

constexpr Colour edge_ink = {0.86, 0.88, 0.91};
constexpr Colour sensor_red = {0.86, 0.15, 0.15};

/// The machine's skin at rest or deformed, coloured by temperature.
class Skin {
 public:
  Skin(FieldMesh const& mesh, Frame const& frame)
      : points_(mesh.points()),
        displacements_(frame.displacement_m.cols() > 0 ? mesh.continued_to_points(frame.displacement_m)
                                                       : Eigen::Matrix3Xd::Zero(3, mesh.points().cols())) {
    set_mesh(*grid_, mesh);
    vtkNew<vtkDoubleArray> temperature;
    temperature->SetName("temperature");
    for (double const value : mesh.mean_at_points(frame.temperature_degC)) temperature->InsertNextValue(value);
    grid_->GetPointData()->SetScalars(temperature);
  }

  [[nodiscard]] double size() const { return (points_.rowwise().maxCoeff() - points_.rowwise().minCoeff()).norm(); }
  [[nodiscard]] double largest_displacement() const { return displacements_.colwise().norm().maxCoeff(); }

  [[nodiscard]] Eigen::Matrix3Xd points(double magnification) const { return points_ + magnification * displacements_; }

  /// Of the point of the machine that is nearest.
  [[nodiscard]] Eigen::Vector3d displacement_near(Eigen::Vector3d const& place) const {
    Eigen::Index nearest = 0;
    (points_.colwise() - place).colwise().squaredNorm().minCoeff(&nearest);
    return displacements_.col(nearest);
  }

  [[nodiscard]] vtkNew<vtkPolyData> surface(double magnification) const {
    Eigen::Matrix3Xd const moved = points(magnification);
    vtkNew<vtkPoints> places;
    places->SetDataTypeToDouble();
    for (Eigen::Index i = 0; i < moved.cols(); ++i) places->InsertNextPoint(moved.col(i).data());
    vtkNew<vtkUnstructuredGrid> shape;
    shape->ShallowCopy(grid_);
    shape->SetPoints(places);
    vtkNew<vtkDataSetSurfaceFilter> skin;
    skin->SetInputData(shape);
    skin->Update();
    vtkNew<vtkPolyData> surface;
    surface->ShallowCopy(skin->GetOutput());
    return surface;
  }

 private:
  Eigen::Matrix3Xd points_;
  Eigen::Matrix3Xd displacements_;
  vtkNew<vtkUnstructuredGrid> grid_;
};

constexpr double edge_angle = 40;  // degrees; the sides of a ring's polygon meet at 15

void add_faces(vtkRenderer& renderer, vtkPolyData* surface, vtkLookupTable* colours) {
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SetFeatureAngle(edge_angle);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->SetLookupTable(colours);
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOn();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();  // edges stand before faces
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(2, 4);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.62);
  actor->GetProperty()->SetDiffuse(0.45);
  actor->GetProperty()->SetSpecular(0.0);
  renderer.AddActor(actor);
}

void add_edges(vtkRenderer& renderer, vtkPolyData* surface, Colour const& colour, int width) {
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(surface);
  edges->SetFeatureAngle(edge_angle);
  edges->ColoringOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(edges->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
}

/// Where the window shows a point, in pixels from its lower left.
class PixelView {
 public:
  PixelView(vtkCamera& camera, Eigen::Vector2d const& size)
      : focus_(camera.GetFocalPoint()), size_(size), pixel_(2 * camera.GetParallelScale() / size.y()) {
    Eigen::Vector3d const along(camera.GetDirectionOfProjection());
    across_ = along.cross(Eigen::Vector3d(camera.GetViewUp())).normalized();
    up_ = across_.cross(along);
  }
  [[nodiscard]] Eigen::Vector2d of(Eigen::Vector3d const& point) const {
    Eigen::Vector3d const from_focus = point - focus_;
    return 0.5 * size_ + Eigen::Vector2d(across_.dot(from_focus), up_.dot(from_focus)) / pixel_;
  }

 private:
  Eigen::Vector3d focus_, across_, up_;
  Eigen::Vector2d size_;
  double pixel_;
};

/// From each dot to its name.
void add_leaders(vtkRenderer& renderer, std::vector<std::array<Eigen::Vector2d, 2>> const& leaders, int width) {
  vtkNew<vtkPoints> ends;
  vtkNew<vtkCellArray> lines;
  for (auto const& leader : leaders) {
    lines->InsertNextCell(2);
    for (auto const& end : leader) lines->InsertCellPoint(ends->InsertNextPoint(end.x(), end.y(), 0.0));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(ends);
  data->SetLines(lines);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(ink[0], ink[1], ink[2]);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  renderer.AddActor2D(actor);
}

/// On a layer of their own, so that no wall hides them; names that would cover one another stand apart.
void add_sensors(vtkRenderWindow& window, vtkCamera* camera, Skin const& skin, double magnification,
                 PictureOptions const& options, Page const& page) {
  vtkNew<vtkRenderer> front;
  front->SetLayer(1);
  front->SetActiveCamera(camera);
  vtkNew<vtkPoints> places;
  vtkNew<vtkCellArray> dots;
  Eigen::Vector2d const size(window.GetSize()[0], window.GetSize()[1]);
  PixelView const view(*camera, size);
  std::vector<Label> labels;
  for (auto const& [name, position] : options.sensors) {
    Eigen::Vector3d const place = position + magnification * skin.displacement_near(position);
    vtkIdType const point = places->InsertNextPoint(place.data());
    dots->InsertNextCell(1, &point);
    labels.push_back({view.of(place), {page.scaled(11.0 * double(name.size())), page.scaled(20)}});
  }
  auto const corners = label_places(labels, page.scaled(9), size);
  std::vector<std::array<Eigen::Vector2d, 2>> leaders;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    Eigen::Vector2d const offset = corners[i] - labels[i].dot;
    leaders.push_back({labels[i].dot, labels[i].dot.cwiseMax(corners[i]).cwiseMin(corners[i] + labels[i].size)});
    vtkNew<vtkBillboardTextActor3D> label;
    label->SetInput(options.sensors[i].name.c_str());
    label->SetPosition(places->GetPoint(vtkIdType(i)));
    label->SetDisplayOffset(int(offset.x()), int(offset.y()));
    set_style(*label->GetTextProperty(), page.scaled(20), true);
    label->GetTextProperty()->SetBackgroundColor(1, 1, 1);
    label->GetTextProperty()->SetBackgroundOpacity(0.7);
    front->AddActor(label);
  }
  add_leaders(*front, leaders, page.scaled(1.5));
  vtkNew<vtkPolyData> data;
  data->SetPoints(places);
  data->SetVerts(dots);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(sensor_red[0], sensor_red[1], sensor_red[2]);
  actor->GetProperty()->SetPointSize(static_cast<float>(page.scaled(16)));
  actor->GetProperty()->RenderPointsAsSpheresOn();
  actor->GetProperty()->SetAmbient(0.5);
  front->AddActor(actor);
  window.AddRenderer(front);
}

/// From the upper left in front: the top is brightest, then the front, then the right side.
void add_light(vtkRenderer& renderer, PictureOptions const& options) {
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->PositionalOff();
  light->SetPosition(Eigen::Vector3d(axes_of_view(options.up) * Eigen::Vector3d(0.3, -0.55, 0.78)).data());
  light->SetFocalPoint(0, 0, 0);
  renderer.AddLight(light);
}

double magnification_for(Skin const& skin, PictureOptions const& options) {
  if (options.magnification) return *options.magnification;
  double const largest = skin.largest_displacement();
  return largest > 0 ? round_down(largest_shown * skin.size() / largest) : 1.0;
}

Ticks ticks_for(FieldMesh const& mesh, Frame const& frame) {
  auto const shown = mesh.mean_at_points(frame.temperature_degC);
  return round_ticks(shown.minCoeff(), shown.maxCoeff());
}

}  // namespace

void render_picture(thermal::Geometry const& geometry, Frame const& frame, std::filesystem::path const& path,
                    PictureOptions const& options) {
  FieldMesh const mesh(geometry);
  if (mesh.elements().empty())
    throw thermal::InputError("a picture needs bodies with a place in space; the machine has none");
  check(frame, mesh.n_nodes());
  DisplayConnection const display;
  Skin const skin(mesh, frame);
  double const magnification = magnification_for(skin, options);
  auto const ticks = ticks_for(mesh, frame);
  vtkNew<vtkLookupTable> colours;
  set_viridis(*colours, ticks);

  int const width = oversampling * options.width, height = oversampling * options.height;
  vtkNew<vtkRenderer> scene;
  scene->SetBackground(1, 1, 1);
  auto const deformed = skin.surface(magnification);
  add_faces(*scene, deformed, colours);
  Page page(*scene, width, height);
  add_edges(*scene, deformed, edge_ink, page.scaled(1.5));
  add_light(*scene, options);
  if (!options.title.empty()) page.add_line(options.title, 30, true);
  page.add_line(options.remark.empty() ? "t = " + time_text(options.time_s) : options.remark, 28, false);
  if (skin.largest_displacement() > 0) {
    add_edges(*scene, skin.surface(0.0), faint_ink, page.scaled(1.0));
    page.add_line("deformation × " + magnification_text(magnification) + ", grey: at rest", 24, false);
  }
  page.add_colour_bar(*colours, ticks, options.quantity);

  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(true);
  window->SetMultiSamples(0);
  window->SetSize(width, height);
  window->SetNumberOfLayers(2);
  window->AddRenderer(scene);
  aim(*scene, skin.points(magnification), options.up, double(options.width) / options.height, {});
  if (!options.sensors.empty()) add_sensors(*window, scene->GetActiveCamera(), skin, magnification, options, page);
  add_axes(*window, *scene->GetActiveCamera(), page.scaled(20));
  window->Render();
  write_atomically(path, as_png(window));
}

}  // namespace thermotwin::output
