#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "twin/file/schema.h"

namespace thermotwin::twin {

/// What stands at the top of the file, before any table.
struct HeadDescription {
  std::string name, title;
  std::string up = "z";

  [[nodiscard]] Eigen::Vector3d upwards() const { return Eigen::Vector3d::Unit(up[0] - 'x'); }

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &HeadDescription::name, "short, as other files refer to it");
    f("title", &HeadDescription::title, "one line for people");
    f.choice("up", &HeadDescription::up, {"x", "y", "z"}, "axis that points upwards");
  }
};

/// A table of a file, with its fields.
struct TableRecord {
  std::string name;
  std::string meaning;
  std::vector<FieldRecord> fields;
};

/// What `thermotwin describe machine` prints: every table of a machine file, first what stands above them.
[[nodiscard]] std::vector<TableRecord> describe_machine();

/// What may stand at the top of a machine file: the keys above its tables, and the names of these.
[[nodiscard]] std::vector<std::string> const& machine_keys();

}  // namespace thermotwin::twin
