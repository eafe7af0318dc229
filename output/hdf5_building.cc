#include "output/hdf5_building.h"

#include <algorithm>
#include <hdf5.h>
#include <hdf5_hl.h>

namespace thermotwin::output::hdf5 {
namespace {

constexpr hsize_t values_per_chunk = 16'384;
constexpr unsigned deflate_level = 4;
constexpr std::size_t superblock_version = 8, old_status = 20, status = 11;  // bytes; HDF5 file format 3.0, II.A

/// Rows in a chunk: about `values_per_chunk` values; not more than 1024, so that short runs stay small.
hsize_t rows_per_chunk(Shape const& shape) {
  hsize_t values_per_row = 1;
  for (std::size_t i = 1; i < shape.size(); ++i) values_per_row *= std::max<hsize_t>(1, shape[i]);
  return std::clamp<hsize_t>(values_per_chunk / values_per_row, 1, 1024);
}

void set_layout(Id how, VariableKind const& kind) {
  Shape chunk = kind.shape;
  std::replace(chunk.begin(), chunk.end(), hsize_t{0}, hsize_t{1});
  chunk[0] = rows_per_chunk(kind.shape);
  H5Pset_chunk(how, static_cast<int>(chunk.size()), chunk.data());
  H5Pset_shuffle(how);
  H5Pset_deflate(how, deflate_level);
}

}  // namespace

Handle space_of(Shape const& shape, Shape const& limit) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose, "scalar"};
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), limit.data()), H5Sclose, "shape"};
}

Handle properties(Id kind) {
  Handle list(H5Pcreate(kind), H5Pclose, "properties");
  return list;
}

Handle dataset_properties() {
  auto how = properties(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(how, false);
  return how;
}

void set_attribute(Id object, std::string const& name, std::string const& text) {
  auto const type = fixed_text_type(std::max<std::size_t>(1, text.size()));
  auto const space = space_of({}, {});
  Handle const attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  expect(H5Awrite(attribute, type, text.c_str()), name);
}

void set_attribute(Id object, std::string const& name, int number) {
  auto const space = space_of({}, {});
  Handle const attribute(H5Acreate2(object, name.c_str(), H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         name);
  expect(H5Awrite(attribute, H5T_NATIVE_INT, &number), name);
}

Handle make_group(Id parent, std::string const& name) {
  auto const how = properties(H5P_GROUP_CREATE);
  H5Pset_obj_track_times(how, false);
  H5Pset_link_creation_order(how, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, how, H5P_DEFAULT), H5Gclose, name};
}

Handle make_variable(Id group, std::string const& name, VariableKind const& kind, std::string const& unit,
                     std::string const& long_name) {
  auto const how = dataset_properties();
  if (kind.grows) set_layout(how, kind);
  return make_variable(group, name, kind, how, unit, long_name);
}

Handle make_variable(Id group, std::string const& name, VariableKind const& kind, Id how, std::string const& unit,
                     std::string const& long_name) {
  Shape limit = kind.shape;
  if (kind.grows) limit[0] = H5S_UNLIMITED;
  auto const space = space_of(kind.shape, limit);
  Handle variable(H5Dcreate2(group, name.c_str(), kind.type, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose, name);
  set_attribute(variable, "units", unit);
  set_attribute(variable, "long_name", long_name.empty() ? name : long_name);
  return variable;
}

void store(Id variable, Id type, void const* values) {
  expect(H5Dwrite(variable, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "values");
}

Handle write_axis(Id group, std::string const& name, Eigen::VectorXd const& values, bool grows, std::string const& unit,
                  std::string const& long_name) {
  auto axis = make_variable(group, name, {H5T_IEEE_F64LE, {count(values.size())}, grows}, unit, long_name);
  store(axis, H5T_NATIVE_DOUBLE, values.data());
  expect(H5DSset_scale(axis, name.c_str()), name);
  return axis;
}

Handle write_axis(Id group, std::string const& name, std::vector<std::string> const& values,
                  std::string const& long_name) {
  auto const type = any_text_type();
  auto axis = make_variable(group, name, {type, {values.size()}}, "1", long_name);
  std::vector<char const*> texts;
  for (auto const& value : values) texts.push_back(value.c_str());
  store(axis, type, texts.data());
  expect(H5DSset_scale(axis, name.c_str()), name);
  return axis;
}

void attach(Id variable, std::vector<Id> const& axes) {
  for (unsigned i = 0; i < axes.size(); ++i) expect(H5DSattach_scale(variable, axes[i], i), "dimension");
}

Handle make_file_in_memory() {
  auto const access = properties(H5P_FILE_ACCESS);
  constexpr std::size_t growth = 1 << 20;
  H5Pset_fapl_core(access, growth, false);
  H5Pset_sieve_buf_size(access, 0);  // nothing to be gathered before it goes to memory
  auto const how = properties(H5P_FILE_CREATE);
  H5Pset_obj_track_times(how, false);
  H5Pset_link_creation_order(how, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  return {H5Fcreate("in memory", H5F_ACC_TRUNC, how, access), H5Fclose, "file"};
}

std::string_view image_of(Id file) {
  expect(H5Fflush(file, H5F_SCOPE_GLOBAL), "flush");
  ssize_t const size = H5Fget_file_image(file, nullptr, 0);
  if (size < 0) fail("size");
  void* where = nullptr;  // of the pointer to the bytes
  expect(H5Fget_vfd_handle(file, H5P_DEFAULT, &where), "bytes");
  char* const bytes = *static_cast<char**>(where);
  bool const old = bytes[superblock_version] < 2;
  bytes[old ? old_status : status] = 0;  // that it is being written, as H5Fget_file_image does
  return {bytes, static_cast<std::size_t>(size)};
}

}  // namespace thermotwin::output::hdf5
