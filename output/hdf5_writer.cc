#include <algorithm>
#include <fmt/core.h>
#include <hdf5.h>
#include <hdf5_hl.h>

#include "output/dataset_file.h"
#include "output/error.h"
#include "output/hdf5_handle.h"

namespace thermotwin::output {
namespace {

using hdf5::any_text_type;
using hdf5::expect;
using hdf5::fail;
using hdf5::fixed_text_type;
using hdf5::Handle;
using RowMajorXd = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowMajorXf = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Shape = std::vector<hsize_t>;

constexpr std::size_t largest_text_attribute = 60'000;  // HDF5 takes 64 KiB for an attribute with its header
constexpr hsize_t values_per_chunk = 16'384;
constexpr unsigned deflate_level = 4;

Handle space_of(Shape const& shape, Shape const& limit) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose, "scalar"};
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), limit.data()), H5Sclose, "shape"};
}

Handle properties(hid_t kind) {
  Handle list(H5Pcreate(kind), H5Pclose, "properties");
  return list;
}

// -----------------------------------------------------------------------------------------------------------

void set_attribute(hid_t object, std::string const& name, std::string const& text) {
  auto const type = fixed_text_type(std::max<std::size_t>(1, text.size()));
  auto const space = space_of({}, {});
  Handle const attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  expect(H5Awrite(attribute, type, text.c_str()), name);
}

void set_attribute(hid_t object, std::string const& name, int number) {
  auto const space = space_of({}, {});
  Handle const attribute(H5Acreate2(object, name.c_str(), H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         name);
  expect(H5Awrite(attribute, H5T_NATIVE_INT, &number), name);
}

Handle make_group(hid_t parent, std::string const& name) {
  auto const how = properties(H5P_GROUP_CREATE);
  H5Pset_obj_track_times(how, false);
  H5Pset_link_creation_order(how, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, how, H5P_DEFAULT), H5Gclose, name};
}

struct VariableKind {
  hid_t type;
  Shape shape;
  bool grows = false;  ///< along the first dimension
};

/// Rows in a chunk: about `values_per_chunk` values; not more than 1024, so that short runs stay small.
hsize_t rows_per_chunk(Shape const& shape) {
  hsize_t values_per_row = 1;
  for (std::size_t i = 1; i < shape.size(); ++i) values_per_row *= std::max<hsize_t>(1, shape[i]);
  return std::clamp<hsize_t>(values_per_chunk / values_per_row, 1, 1024);
}

void set_layout(hid_t how, VariableKind const& kind) {
  Shape chunk = kind.shape;
  std::replace(chunk.begin(), chunk.end(), hsize_t{0}, hsize_t{1});
  chunk[0] = rows_per_chunk(kind.shape);
  H5Pset_chunk(how, static_cast<int>(chunk.size()), chunk.data());
  H5Pset_shuffle(how);
  H5Pset_deflate(how, deflate_level);
}

Handle make_variable(hid_t group, std::string const& name, VariableKind const& kind, std::string const& unit,
                     std::string const& long_name) {
  auto const how = properties(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(how, false);
  Shape limit = kind.shape;
  if (kind.grows) {
    limit[0] = H5S_UNLIMITED;
    set_layout(how, kind);
  }
  auto const space = space_of(kind.shape, limit);
  Handle variable(H5Dcreate2(group, name.c_str(), kind.type, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose, name);
  set_attribute(variable, "units", unit);
  set_attribute(variable, "long_name", long_name.empty() ? name : long_name);
  return variable;
}

void store(hid_t variable, hid_t type, void const* values) {
  expect(H5Dwrite(variable, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "values");
}

hsize_t count(Eigen::Index n) { return static_cast<hsize_t>(n); }

Handle write_axis(hid_t group, std::string const& name, Eigen::VectorXd const& values, bool grows,
                  std::string const& unit, std::string const& long_name) {
  auto axis = make_variable(group, name, {H5T_IEEE_F64LE, {count(values.size())}, grows}, unit, long_name);
  store(axis, H5T_NATIVE_DOUBLE, values.data());
  expect(H5DSset_scale(axis, name.c_str()), name);
  return axis;
}

void attach(hid_t variable, std::vector<hid_t> const& axes) {
  for (unsigned i = 0; i < axes.size(); ++i) expect(H5DSattach_scale(variable, axes[i], i), "dimension");
}

void show_time_in(hid_t group, hid_t root) {
  expect(H5Lcreate_hard(root, "/time", group, "time", H5P_DEFAULT, H5P_DEFAULT), "time");
}

void write_channels(hid_t root, std::string const& name, std::vector<Channel> const& channels, hid_t time) {
  if (channels.empty()) return;
  auto const group = make_group(root, name);
  show_time_in(group, root);
  for (auto const& channel : channels) {
    auto const variable = make_variable(group, channel.name, {H5T_IEEE_F64LE, {count(channel.values.size())}, true},
                                        channel.unit, channel.long_name);
    store(variable, H5T_NATIVE_DOUBLE, channel.values.data());
    attach(variable, {time});
  }
}

void write_positioning(hid_t root, std::string const& name, std::vector<Positioning> const& tables) {
  if (tables.empty()) return;
  auto const parent = make_group(root, name);
  for (auto const& table : tables) {
    auto const group = make_group(parent, table.axis);
    auto const time = write_axis(group, "pass_time", table.time_s, false, "s", "time of the pass from the start");
    auto const position = write_axis(group, "position", table.position_mm, false, "mm", "target along " + table.axis);
    auto const write_errors = [&](char const* direction, Eigen::MatrixXd const& errors) {
      RowMajorXd const rows = errors;
      VariableKind const kind{H5T_IEEE_F64LE, {count(rows.rows()), count(rows.cols())}};
      auto const variable = make_variable(group, direction, kind, "um",
                                          fmt::format("error of position along {}, {}", table.axis, direction));
      store(variable, H5T_NATIVE_DOUBLE, rows.data());
      attach(variable, {time, position});
    };
    write_errors("forward", table.forward_um);
    write_errors("backward", table.backward_um);
  }
}

Handle write_node_names(hid_t group, std::vector<std::string> const& names) {
  auto const type = any_text_type();
  auto axis = make_variable(group, "node", {type, {names.size()}}, "1", "name of the node");
  std::vector<char const*> texts;
  for (auto const& name : names) texts.push_back(name.c_str());
  store(axis, type, texts.data());
  expect(H5DSset_scale(axis, "node"), "node");
  return axis;
}

void write_nodes(hid_t root, Dataset const& dataset, hid_t time) {
  if (!dataset.node_temperatures) return;
  auto const group = make_group(root, "nodes");
  show_time_in(group, root);
  auto const node = write_node_names(group, dataset.node_names);
  RowMajorXf const rows = *dataset.node_temperatures;
  VariableKind const kind{H5T_IEEE_F32LE, {count(rows.rows()), count(rows.cols())}, true};
  auto const variable = make_variable(group, "temperature", kind, "degC", "temperature of every node");
  store(variable, H5T_NATIVE_FLOAT, rows.data());
  attach(variable, {time, node});
}

void write_provenance(hid_t root, std::map<std::string, std::string> const& provenance) {
  auto const group = make_group(root, "provenance");
  for (auto const& [key, text] : provenance) {
    if (text.size() <= largest_text_attribute) {
      set_attribute(group, key, text);
      continue;
    }
    auto const type = any_text_type();
    auto const variable = make_variable(group, key, {type, {}}, "1", key);
    char const* const bytes = text.c_str();
    store(variable, type, &bytes);
  }
}

void write_root_attributes(hid_t root, Dataset const& dataset) {
  auto const version = dataset.provenance.find("version");
  set_attribute(root, "title", dataset.title);
  set_attribute(root, "Conventions", std::string("CF-1.8"));
  set_attribute(root, "source", version == dataset.provenance.end() ? "ThermoTwin" : "ThermoTwin " + version->second);
  set_attribute(root, "complete", dataset.complete ? 1 : 0);
}

Handle make_file_in_memory() {
  auto const access = properties(H5P_FILE_ACCESS);
  constexpr std::size_t growth = 1 << 20;
  H5Pset_fapl_core(access, growth, false);
  auto const how = properties(H5P_FILE_CREATE);
  H5Pset_obj_track_times(how, false);
  H5Pset_link_creation_order(how, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  return {H5Fcreate("in memory", H5F_ACC_TRUNC, how, access), H5Fclose, "file"};
}

std::string image_of(hid_t file) {
  expect(H5Fflush(file, H5F_SCOPE_GLOBAL), "flush");
  ssize_t const size = H5Fget_file_image(file, nullptr, 0);
  if (size < 0) fail("size");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file, bytes.data(), bytes.size()) != size) fail("bytes");
  return bytes;
}

}  // namespace

std::string to_hdf5(Dataset const& dataset) try {
  check(dataset);
  hdf5::Silence const silence;
  auto const file = make_file_in_memory();
  write_root_attributes(file, dataset);
  auto const time = write_axis(file, "time", dataset.time_s, true, "s", "time from the start");
  write_channels(file, "inputs", dataset.inputs, time);
  write_channels(file, "readings", dataset.readings, time);
  write_channels(file, "displacements", dataset.displacements, time);
  write_positioning(file, "positioning", dataset.positioning);
  if (!dataset.truth_readings.empty() || !dataset.truth_displacements.empty() || !dataset.truth_positioning.empty())
    make_group(file, "truth");
  write_channels(file, "truth/readings", dataset.truth_readings, time);
  write_channels(file, "truth/displacements", dataset.truth_displacements, time);
  write_positioning(file, "truth/positioning", dataset.truth_positioning);
  write_channels(file, "heat", dataset.heat, time);
  write_nodes(file, dataset, time);
  write_provenance(file, dataset.provenance);
  return image_of(file);
} catch (hdf5::Failure const& failure) {
  throw OutputError(fmt::format("data set '{}' cannot be made into HDF5: {}", dataset.title, failure.what()));
}

}  // namespace thermotwin::output
