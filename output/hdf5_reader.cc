#include <fmt/core.h>
#include <hdf5.h>
#include <optional>

#include "output/dataset_file.h"
#include "output/hdf5_handle.h"
#include "output/hdf5_reading.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

using hdf5::expect;
using hdf5::Handle;
using hdf5::names_in;
using hdf5::open_variable;
using hdf5::read_text;
using hdf5::text_attribute;
using thermal::InputError;
using RowMajorXd = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowMajorXf = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Shape = std::vector<hsize_t>;

// -----------------------------------------------------------------------------------------------------------

bool has(hid_t group, std::string const& name) { return H5Lexists(group, name.c_str(), H5P_DEFAULT) > 0; }

bool is_complete(hid_t root) {
  if (H5Aexists(root, "complete") <= 0) return true;
  int complete = 0;
  Handle const attribute(H5Aopen(root, "complete", H5P_DEFAULT), H5Aclose, "complete");
  expect(H5Aread(attribute, H5T_NATIVE_INT, &complete), "complete");
  return complete != 0;
}

/// Extents, checked: a variable of another rank is not ours.
Shape shape_of(hid_t variable, std::string const& name, int rank) {
  Handle const space(H5Dget_space(variable), H5Sclose, name);
  if (H5Sget_simple_extent_ndims(space) != rank)
    throw hdf5::Failure(
        fmt::format("'{}' has {} dimensions, expected {}", name, H5Sget_simple_extent_ndims(space), rank));
  Shape shape(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

Eigen::VectorXd read_vector(hid_t group, std::string const& name) {
  auto const variable = open_variable(group, name);
  Eigen::VectorXd values(static_cast<Eigen::Index>(shape_of(variable, name, 1)[0]));
  expect(H5Dread(variable, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  return values;
}

template <class Matrix>
Matrix read_matrix(hid_t group, std::string const& name, hid_t type) {
  auto const variable = open_variable(group, name);
  auto const shape = shape_of(variable, name, 2);
  Matrix values(static_cast<Eigen::Index>(shape[0]), static_cast<Eigen::Index>(shape[1]));
  expect(H5Dread(variable, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  return values;
}

/// The group at a path of one or two steps, if it is there.
std::optional<Handle> find_group(hid_t root, std::string const& path) {
  auto const slash = path.find('/');
  if (slash != std::string::npos && !has(root, path.substr(0, slash))) return std::nullopt;
  if (!has(root, path)) return std::nullopt;
  return Handle(H5Gopen2(root, path.c_str(), H5P_DEFAULT), H5Gclose, path);
}

std::vector<Channel> read_channels(hid_t root, std::string const& path) {
  std::vector<Channel> channels;
  auto const group = find_group(root, path);
  if (!group) return channels;
  for (auto const& name : names_in(*group)) {
    if (name == "time") continue;
    auto const variable = open_variable(*group, name);
    channels.push_back(
        {name, text_attribute(variable, "units"), text_attribute(variable, "long_name"), read_vector(*group, name)});
  }
  return channels;
}

std::vector<Positioning> read_positioning(hid_t root, std::string const& path) {
  std::vector<Positioning> tables;
  auto const group = find_group(root, path);
  if (!group) return tables;
  for (auto const& axis : names_in(*group)) {
    Handle const table(H5Gopen2(*group, axis.c_str(), H5P_DEFAULT), H5Gclose, axis);
    tables.push_back({axis, read_vector(table, "position"), read_vector(table, "pass_time"),
                      read_matrix<RowMajorXd>(table, "forward", H5T_NATIVE_DOUBLE),
                      read_matrix<RowMajorXd>(table, "backward", H5T_NATIVE_DOUBLE)});
  }
  return tables;
}

std::map<std::string, std::string> read_provenance(hid_t root) {
  std::map<std::string, std::string> provenance;
  auto const group = find_group(root, "provenance");
  if (!group) return provenance;
  for (auto const& key : names_in(*group)) {
    auto const variable = open_variable(*group, key);
    Handle const type(H5Dget_type(variable), H5Tclose, key);
    provenance[key] = read_text(
        type, [&](hid_t as, void* into) { return H5Dread(variable, as, H5S_ALL, H5S_ALL, H5P_DEFAULT, into); });
  }
  H5O_info_t info;
  expect(H5Oget_info(*group, &info), "provenance");
  for (hsize_t i = 0; i < info.num_attrs; ++i) {
    Handle const attribute(H5Aopen_by_idx(*group, ".", H5_INDEX_NAME, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose, "provenance");
    std::string key(static_cast<std::size_t>(H5Aget_name(attribute, 0, nullptr)), '\0');
    H5Aget_name(attribute, key.size() + 1, key.data());
    provenance[key] = hdf5::read_text_of(attribute);
  }
  return provenance;
}

Dataset read_all(hid_t root) {
  if (has(root, "run") && has(root, "seed"))  // output/campaign_file.h
    throw hdf5::Failure(
        "it holds the runs of a campaign, for xarray and the like; `thermotwin campaign CAMPAIGN --show N` prints the "
        "command that makes run N a data set of its own, and `thermotwin report DIR` shows them all");
  if (!has(root, "time")) throw hdf5::Failure("it is an HDF5 file without a variable 'time'");
  Dataset dataset;
  dataset.title = text_attribute(root, "title");
  dataset.complete = is_complete(root);
  dataset.time_s = read_vector(root, "time");
  dataset.inputs = read_channels(root, "inputs");
  dataset.readings = read_channels(root, "readings");
  dataset.displacements = read_channels(root, "displacements");
  dataset.positioning = read_positioning(root, "positioning");
  dataset.truth_readings = read_channels(root, "truth/readings");
  dataset.truth_displacements = read_channels(root, "truth/displacements");
  dataset.truth_positioning = read_positioning(root, "truth/positioning");
  dataset.heat = read_channels(root, "heat");
  dataset.provenance = read_provenance(root);
  if (auto const nodes = find_group(root, "nodes")) {
    dataset.node_temperatures = read_matrix<RowMajorXf>(*nodes, "temperature", H5T_NATIVE_FLOAT);
    dataset.node_names = hdf5::read_names(*nodes, "node");
  }
  return dataset;
}

Handle open_file(std::filesystem::path const& path) {
  std::error_code error;
  auto const status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw hdf5::Failure("no such file");
  if (!std::filesystem::is_regular_file(status)) throw hdf5::Failure("it is not a file");
  if (H5Fis_hdf5(path.c_str()) == 0) throw hdf5::Failure("it is not an HDF5 file");
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "HDF5 cannot open it"};
}

}  // namespace

Dataset read(std::filesystem::path const& path) {
  hdf5::Silence const silence;
  try {
    auto const file = open_file(path);
    Dataset dataset = read_all(file);
    check(dataset);
    return dataset;
  } catch (hdf5::Failure const& failure) {
    throw InputError(fmt::format("'{}' cannot be read as a data set: {}", path.string(), failure.what()));
  } catch (InputError const& failure) {
    throw InputError(fmt::format("'{}' cannot be read as a data set: {}", path.string(), failure.what()));
  }
}

std::map<std::string, std::string> provenance_in(std::filesystem::path const& path) {
  hdf5::Silence const silence;
  try {
    return read_provenance(open_file(path));
  } catch (hdf5::Failure const&) {
    return {};
  }
}

}  // namespace thermotwin::output
