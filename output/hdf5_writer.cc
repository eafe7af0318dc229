#include <fmt/core.h>
#include <hdf5.h>
#include <hdf5_hl.h>

#include "output/dataset_file.h"
#include "output/error.h"
#include "output/hdf5_building.h"

namespace thermotwin::output {
namespace {

using hdf5::any_text_type;
using hdf5::attach;
using hdf5::count;
using hdf5::expect;
using hdf5::make_group;
using hdf5::make_variable;
using hdf5::set_attribute;
using hdf5::store;
using hdf5::VariableKind;
using hdf5::write_axis;
using RowMajorXd = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowMajorXf = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::size_t largest_text_attribute = 60'000;  // HDF5 takes 64 KiB for an attribute with its header

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

void write_nodes(hid_t root, Dataset const& dataset, hid_t time) {
  if (!dataset.node_temperatures) return;
  auto const group = make_group(root, "nodes");
  show_time_in(group, root);
  auto const node = write_axis(group, "node", dataset.node_names, "name of the node");
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

}  // namespace

std::string to_hdf5(Dataset const& dataset) try {
  check(dataset);
  hdf5::Silence const silence;
  auto const file = hdf5::make_file_in_memory();
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
  return std::string(hdf5::image_of(file));
} catch (hdf5::Failure const& failure) {
  throw OutputError(fmt::format("data set '{}' cannot be made into HDF5: {}", dataset.title, failure.what()));
}

}  // namespace thermotwin::output
