#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "thermal/geometry.h"

namespace thermotwin::output {

/// A number per node of the network; nodes beyond the geometry's last are not looked at.
struct NodeField {
  std::string name;  ///< with its unit: "error_removed_um"
  Eigen::VectorXd values;
};

/// One file (.vtu) that shows these numbers on the machine at rest. Cell data: the fields, node, body_name; field data:
/// the metadata. Replaced atomically. thermal::InputError when the geometry is empty or a field has too few values.
void write_node_fields(std::filesystem::path const& path, thermal::Geometry const& geometry,
                       std::vector<NodeField> const& fields, std::map<std::string, std::string> const& metadata = {});

}  // namespace thermotwin::output
