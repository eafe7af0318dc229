#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <vtkAbstractArray.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTetra.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "output/atomic_file.h"
#include "output/error.h"
#include "output/node_fields.h"
#include "output/paraview_state.h"
#include "output/picture_scale.h"
#include "output/vtk_grid.h"
#include "thermal/error.h"
#include "thermal/units.h"

namespace thermotwin::output {

struct FieldSeries::Grid {
  explicit Grid(thermal::Geometry const& geometry) : mesh(geometry) {}

  FieldMesh mesh;
  vtkNew<vtkUnstructuredGrid> cells;
};

namespace {

using thermal::InputError;

constexpr double least_difference = 1e-3;  // K, of the colours' ends

void add_texts(vtkFieldData& data, std::string const& name, std::vector<std::string> const& texts) {
  vtkNew<vtkStringArray> array;
  array->SetName(name.c_str());
  for (auto const& text : texts) array->InsertNextValue(text);
  data.AddArray(array);
}

void set_time(vtkFieldData& data, double time_s) {
  vtkNew<vtkDoubleArray> array;
  array->SetName("TimeValue");
  array->InsertNextValue(time_s);
  data.AddArray(array);
}

std::string as_vtu(vtkUnstructuredGrid* cells) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(cells);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw OutputError("VTK cannot write the field");
  return writer->GetOutputString();
}

std::vector<std::string> body_names_of_cells(FieldMesh const& mesh) {
  std::vector<std::string> names;
  for (auto const& element : mesh.elements())
    names.push_back(mesh.body_names()[static_cast<std::size_t>(element.body)]);
  return names;
}

std::string field_file(std::size_t number) { return fmt::format("field_{:04}.vtu", number); }
std::string sensor_file(std::size_t number) { return fmt::format("sensors_{:04}.vtp", number); }

std::string as_vtp(std::vector<SensorPlace> const& sensors, Eigen::VectorXd const& temperatures,
                   std::string const& name, double time_s) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  vtkNew<vtkCellArray> dots;
  vtkNew<vtkDoubleArray> values;
  values->SetName(name.c_str());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (!std::isfinite(temperatures[Eigen::Index(i)])) continue;
    vtkIdType const point = places->InsertNextPoint(sensors[i].position_m.data());
    dots->InsertNextCell(1, &point);
    values->InsertNextValue(temperatures[Eigen::Index(i)]);
    names.push_back(sensors[i].name);
  }
  data->SetPoints(places);
  data->SetVerts(dots);
  data->GetPointData()->SetScalars(values);
  add_texts(*data->GetPointData(), "name", names);
  set_time(*data->GetFieldData(), time_s);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAscii();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw OutputError("VTK cannot write the sensors");
  return writer->GetOutputString();
}

std::string as_pvd(std::vector<double> const& times_s, std::string (*file_name)(std::size_t)) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (std::size_t i = 0; i < times_s.size(); ++i)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", thermal::format_number(times_s[i]),
                        file_name(i));
  return text + "  </Collection>\n</VTKFile>\n";
}

template <class Array>
Array& array_of(vtkFieldData& data, char const* name) {
  auto* const array = Array::SafeDownCast(data.GetAbstractArray(name));
  if (!array) throw InputError(fmt::format("it has no '{}'", name));
  return *array;
}

Eigen::VectorXd numbers(vtkFieldData& data, char const* name) {
  auto& array = array_of<vtkDataArray>(data, name);
  Eigen::VectorXd values(array.GetNumberOfTuples());
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = array.GetTuple1(i);
  return values;
}

Eigen::Matrix3Xd vectors(vtkFieldData& data, char const* name) {
  auto& array = array_of<vtkDataArray>(data, name);
  Eigen::Matrix3Xd values(3, array.GetNumberOfTuples());
  for (Eigen::Index i = 0; i < values.cols(); ++i) array.GetTuple(i, values.col(i).data());
  return values;
}

std::vector<std::string> texts(vtkFieldData& data, char const* name) {
  auto& array = array_of<vtkStringArray>(data, name);
  std::vector<std::string> values;
  for (vtkIdType i = 0; i < array.GetNumberOfValues(); ++i) values.push_back(array.GetValue(i));
  return values;
}

/// Sum of the signed volumes of the tetrahedra that VTK cuts the cell into.
double volume(vtkCell& cell) {
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  cell.Triangulate(0, ids, points);
  double sum = 0.0;
  for (vtkIdType i = 0; i + 3 < points->GetNumberOfPoints(); i += 4) {
    std::array<std::array<double, 3>, 4> corner{};
    for (vtkIdType k = 0; k < 4; ++k) points->GetPoint(i + k, corner[static_cast<std::size_t>(k)].data());
    sum += vtkTetra::ComputeVolume(corner[0].data(), corner[1].data(), corner[2].data(), corner[3].data());
  }
  return sum;
}

std::map<std::string, std::string> read_metadata(vtkFieldData& data) {
  std::map<std::string, std::string> metadata;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    auto* const array = vtkStringArray::SafeDownCast(data.GetAbstractArray(i));
    if (array && std::string(array->GetName()) != "body_names") metadata[array->GetName()] = array->GetValue(0);
  }
  return metadata;
}

FieldSummary summarise(vtkUnstructuredGrid& grid) {
  FieldSummary summary;
  summary.time_s = numbers(*grid.GetFieldData(), "TimeValue")[0];
  summary.metadata = read_metadata(*grid.GetFieldData());
  summary.body_names = texts(*grid.GetFieldData(), "body_names");
  auto& cells = *grid.GetCellData();
  summary.volume_m3.resize(grid.GetNumberOfCells());
  for (vtkIdType i = 0; i < grid.GetNumberOfCells(); ++i) summary.volume_m3[i] = volume(*grid.GetCell(i));
  summary.temperature_degC = numbers(cells, "temperature_degC");
  summary.temperature_rise_K = numbers(cells, "temperature_rise_K");
  summary.heat_source_W_per_m3 = numbers(cells, "heat_source_W_per_m3");
  summary.displacement_um = vectors(cells, "displacement_um");
  summary.node = numbers(cells, "node").cast<int>();
  summary.body = numbers(cells, "body").cast<int>();
  summary.body_name = texts(cells, "body_name");
  summary.points_m.resize(3, grid.GetNumberOfPoints());
  for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i) grid.GetPoint(i, summary.points_m.col(i).data());
  summary.point_displacement_um = vectors(*grid.GetPointData(), "displacement_um");
  return summary;
}

}  // namespace

FieldSeries::FieldSeries(std::filesystem::path directory, thermal::Geometry const& geometry, FieldOptions options)
    : directory_(std::move(directory)), options_(std::move(options)), grid_(std::make_unique<Grid>(geometry)) {
  auto const& mesh = grid_->mesh;
  if (mesh.elements().empty()) throw InputError("fields need bodies with a place in space; the machine has none");
  make_directory(directory_);
  set_mesh(*grid_->cells, mesh);
  add_texts(*grid_->cells->GetCellData(), "body_name", body_names_of_cells(mesh));
  add_texts(*grid_->cells->GetFieldData(), "body_names", mesh.body_names());
  for (auto const& [key, text] : options_.metadata) add_texts(*grid_->cells->GetFieldData(), key, {text});
}

FieldSeries::~FieldSeries() = default;

void FieldSeries::add(double time_s, Frame const& frame) {
  if (options_.meaning == FieldMeaning::state)
    set_frame(*grid_->cells, grid_->mesh, frame, options_.reference_degC);
  else
    set_difference(*grid_->cells, grid_->mesh, frame, options_.meaning);
  set_time(*grid_->cells->GetFieldData(), time_s);
  write_atomically(directory_ / field_file(times_s_.size()), as_vtu(grid_->cells));
  add_sensors(time_s, frame);
  times_s_.push_back(time_s);
  write_atomically(index_path(), as_pvd(times_s_, field_file));
  if (!options_.sensors.empty()) write_atomically(directory_ / "sensors.pvd", as_pvd(times_s_, sensor_file));
  arrange(frame);
}

void FieldSeries::add_sensors(double time_s, Frame const& frame) {
  if (options_.sensors.empty()) return;
  if (frame.sensor_degC.size() != Eigen::Index(options_.sensors.size()))
    throw InputError(
        fmt::format("a frame has {} temperatures for {} sensors", frame.sensor_degC.size(), options_.sensors.size()));
  write_atomically(directory_ / sensor_file(times_s_.size()),
                   as_vtp(options_.sensors, frame.sensor_degC, field_names(options_.meaning).temperature, time_s));
}

void FieldSeries::widen(Frame const& frame) {
  for (double const value : frame.temperature_degC.head(grid_->mesh.n_nodes())) {
    if (!std::isfinite(value)) continue;
    lowest_degC_ = std::min(lowest_degC_, value);
    highest_degC_ = std::max(highest_degC_, value);
  }
  if (options_.meaning == FieldMeaning::state) return;
  highest_degC_ = std::max({highest_degC_, -lowest_degC_, least_difference});
  lowest_degC_ = -highest_degC_;
}

void FieldSeries::arrange(Frame const& frame) {
  widen(frame);
  if (frame.displacement_m.cols() > 0)
    largest_m_ = std::max(largest_m_, frame.displacement_m.colwise().norm().maxCoeff());
  auto const ticks = round_ticks(lowest_degC_, highest_degC_);
  Eigen::Matrix3Xd const& points = grid_->mesh.points();
  Eigen::Vector3d const low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
  ParaviewView view;
  view.meaning = options_.meaning;
  view.first_s = times_s_.front();
  view.last_s = times_s_.back();
  view.lowest_degC = ticks.first;
  view.highest_degC = ticks.first + (ticks.count - 1) * ticks.step;
  view.centre = 0.5 * (low + high);
  view.size = (high - low).norm();
  view.magnification = largest_m_ > 0.0 ? round_down(largest_shown * view.size / largest_m_) : 1.0;
  view.up = options_.up;
  view.with_sensors = !options_.sensors.empty();
  write_paraview_state(directory_, view);
}

std::filesystem::path FieldSeries::index_path() const { return directory_ / "fields.pvd"; }

void write_node_fields(std::filesystem::path const& path, thermal::Geometry const& geometry,
                       std::vector<NodeField> const& fields, std::map<std::string, std::string> const& metadata) {
  FieldMesh const mesh(geometry);
  if (mesh.elements().empty()) throw InputError("fields need bodies with a place in space; the machine has none");
  vtkNew<vtkUnstructuredGrid> cells;
  set_mesh(*cells, mesh);
  add_texts(*cells->GetCellData(), "body_name", body_names_of_cells(mesh));
  for (auto const& [key, text] : metadata) add_texts(*cells->GetFieldData(), key, {text});
  for (auto const& field : fields) {
    if (field.values.size() < mesh.n_nodes())
      throw InputError(fmt::format("the field '{}' has {} values; the geometry has {} nodes", field.name,
                                   field.values.size(), mesh.n_nodes()));
    add_node_numbers(*cells, mesh, field.name, field.values);
  }
  write_atomically(path, as_vtu(cells));
}

FieldSummary read_field(std::filesystem::path const& path) try {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (!std::filesystem::is_regular_file(path) || reader->CanReadFile(path.c_str()) == 0)
    throw InputError("it is no VTK unstructured grid");
  reader->SetFileName(path.c_str());
  reader->Update();
  if (reader->GetErrorCode() != 0) throw InputError("VTK cannot read it");
  return summarise(*reader->GetOutput());
} catch (InputError const& error) {
  throw InputError(fmt::format("'{}' cannot be read as a field: {}", path.string(), error.what()));
}

}  // namespace thermotwin::output
