#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "output/hdf5_handle.h"

/// Groups, variables and their attributes as every file of ours has them; for output/hdf5_*.cc only. No dates are
/// stored, so that the same data give the same bytes.
namespace thermotwin::output::hdf5 {

using Shape = std::vector<unsigned long long>;  ///< of hsize_t

inline unsigned long long count(Eigen::Index n) { return static_cast<unsigned long long>(n); }

/// A scalar for no extents; `limit` as long as the shape.
Handle space_of(Shape const& shape, Shape const& limit);

Handle properties(Id kind);
/// For creating a variable.
Handle dataset_properties();

void set_attribute(Id object, std::string const& name, std::string const& text);
void set_attribute(Id object, std::string const& name, int number);

Handle make_group(Id parent, std::string const& name);

struct VariableKind {
  Id type;
  Shape shape;
  bool grows = false;  ///< along the first dimension
};

/// With the attributes `units` and `long_name` (the name itself, if empty); one that grows is chunked and packed.
Handle make_variable(Id group, std::string const& name, VariableKind const& kind, std::string const& unit,
                     std::string const& long_name);
/// The same with a layout of its own: `how` are dataset_properties().
Handle make_variable(Id group, std::string const& name, VariableKind const& kind, Id how, std::string const& unit,
                     std::string const& long_name);

void store(Id variable, Id type, void const* values);

/// A variable that is a dimension scale of its own name.
Handle write_axis(Id group, std::string const& name, Eigen::VectorXd const& values, bool grows, std::string const& unit,
                  std::string const& long_name);
Handle write_axis(Id group, std::string const& name, std::vector<std::string> const& values,
                  std::string const& long_name);
/// The scales of a variable's dimensions, in order.
void attach(Id variable, std::vector<Id> const& axes);

Handle make_file_in_memory();
/// The bytes that the file in memory would have on the disk, while it lives and is not changed.
std::string_view image_of(Id file);

}  // namespace thermotwin::output::hdf5
