#include "output/vtk_grid.h"

#include <algorithm>
#include <fmt/core.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include "thermal/error.h"

namespace thermotwin::output {
namespace {

constexpr double um_per_m = 1e6;

template <class Function>
void add_cell_numbers(vtkUnstructuredGrid& grid, FieldMesh const& mesh, char const* name, Function const& value) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(mesh.elements().size()));
  vtkIdType at = 0;
  for (auto const& element : mesh.elements()) array->SetValue(at++, value(element.node));
  grid.GetCellData()->AddArray(array);
}

template <class Member>
void add_cell_labels(vtkUnstructuredGrid& grid, FieldMesh const& mesh, char const* name, Member member) {
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  for (auto const& element : mesh.elements()) array->InsertNextValue(element.*member);
  grid.GetCellData()->AddArray(array);
}

vtkNew<vtkDoubleArray> displacements(std::string const& name, Eigen::Index count) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(count);
  return array;
}

void add_displacements(vtkUnstructuredGrid& grid, FieldMesh const& mesh, std::string const& name,
                       Eigen::Matrix3Xd const& of_nodes) {
  auto const of_cells = displacements(name, static_cast<Eigen::Index>(mesh.elements().size()));
  vtkIdType at = 0;
  for (auto const& element : mesh.elements())
    of_cells->SetTuple(at++, Eigen::Vector3d(um_per_m * of_nodes.col(element.node)).data());
  grid.GetCellData()->AddArray(of_cells);

  Eigen::Matrix3Xd const continued = um_per_m * mesh.continued_to_points(of_nodes);
  auto const of_points = displacements(name, continued.cols());
  std::copy(continued.data(), continued.data() + continued.size(), of_points->GetPointer(0));
  grid.GetPointData()->AddArray(of_points);
}

void check_count(char const* what, Eigen::Index found, Eigen::Index needed, bool may_be_empty) {
  if (found < needed && !(may_be_empty && found == 0))
    throw thermal::InputError(
        fmt::format("a frame has {} {} for nodes, but the geometry shows {}", found, what, needed));
}

}  // namespace

void check(Frame const& frame, Eigen::Index n_nodes) {
  check_count("temperatures", frame.temperature_degC.size(), n_nodes, false);
  check_count("heat sources", frame.heat_source_W.size(), n_nodes, true);
  check_count("displacements", frame.displacement_m.cols(), n_nodes, true);
}

void set_mesh(vtkUnstructuredGrid& grid, FieldMesh const& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(mesh.points().cols());
  for (Eigen::Index i = 0; i < mesh.points().cols(); ++i) points->SetPoint(i, mesh.points().col(i).data());
  grid.SetPoints(points);
  grid.AllocateExact(static_cast<vtkIdType>(mesh.elements().size()), 8);
  for (auto const& element : mesh.elements()) {
    std::array<vtkIdType, 8> corners{};
    std::copy(element.corners.begin(), element.corners.end(), corners.begin());
    grid.InsertNextCell(element.n_corners == 6 ? VTK_WEDGE : VTK_HEXAHEDRON, element.n_corners, corners.data());
  }
  add_cell_labels(grid, mesh, "node", &Element::node);
  add_cell_labels(grid, mesh, "body", &Element::body);
}

void set_frame(vtkUnstructuredGrid& grid, FieldMesh const& mesh, Frame const& frame, double reference_degC) {
  check(frame, mesh.n_nodes());
  auto const& temperature = frame.temperature_degC;
  bool const has_heat = frame.heat_source_W.size() > 0;
  bool const has_displacement = frame.displacement_m.cols() > 0;
  add_cell_numbers(grid, mesh, field_names(FieldMeaning::state).temperature.c_str(),
                   [&](int node) { return temperature[node]; });
  add_cell_numbers(grid, mesh, "temperature_rise_K", [&](int node) { return temperature[node] - reference_degC; });
  add_cell_numbers(grid, mesh, "heat_source_W_per_m3",
                   [&](int node) { return has_heat ? frame.heat_source_W[node] / mesh.node_volumes()[node] : 0.0; });
  add_displacements(grid, mesh, field_names(FieldMeaning::state).displacement,
                    has_displacement ? frame.displacement_m : Eigen::Matrix3Xd::Zero(3, mesh.n_nodes()).eval());
}

FieldNames field_names(FieldMeaning meaning) {
  if (meaning == FieldMeaning::state) return {"temperature_degC", "displacement_um"};
  if (meaning == FieldMeaning::difference) return {"temperature_difference_K", "displacement_difference_um"};
  return {"temperature_residual_K", ""};
}

void set_difference(vtkUnstructuredGrid& grid, FieldMesh const& mesh, Frame const& frame, FieldMeaning meaning) {
  check(frame, mesh.n_nodes());
  auto const names = field_names(meaning);
  add_node_numbers(grid, mesh, names.temperature, frame.temperature_degC);
  if (!names.displacement.empty()) add_displacements(grid, mesh, names.displacement, frame.displacement_m);
}

void add_node_numbers(vtkUnstructuredGrid& grid, FieldMesh const& mesh, std::string const& name,
                      Eigen::VectorXd const& of_nodes) {
  add_cell_numbers(grid, mesh, name.c_str(), [&](int node) { return of_nodes[node]; });
}

}  // namespace thermotwin::output
