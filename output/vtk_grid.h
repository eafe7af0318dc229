#pragma once

#include <string>

#include "output/field_mesh.h"
#include "output/fields.h"

class vtkUnstructuredGrid;

/// What the seams to VTK share: the mesh as a grid, and a frame on it; for output/vtk_*.cc only.
namespace thermotwin::output {

void set_mesh(vtkUnstructuredGrid& grid, FieldMesh const& mesh);

/// Cell and point data as FieldSeries documents them, except names and metadata.
void set_frame(vtkUnstructuredGrid& grid, FieldMesh const& mesh, Frame const& frame, double reference_degC);

/// What a series calls its numbers; an empty name: it has none.
struct FieldNames {
  std::string temperature, displacement;
};
[[nodiscard]] FieldNames field_names(FieldMeaning meaning);

/// The same of a difference or a residual.
void set_difference(vtkUnstructuredGrid& grid, FieldMesh const& mesh, Frame const& frame, FieldMeaning meaning);

/// One more number per cell, from a number per node.
void add_node_numbers(vtkUnstructuredGrid& grid, FieldMesh const& mesh, std::string const& name,
                      Eigen::VectorXd const& of_nodes);

/// Throws thermal::InputError when the frame has fewer values than the geometry has nodes.
void check(Frame const& frame, Eigen::Index n_nodes);

}  // namespace thermotwin::output
