#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "thermal/error.h"

namespace thermotwin::twin {

/// Where a text stands, counted from 1.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;

  [[nodiscard]] std::string text() const;  ///< "v450.toml:12:5"
};

/// A mistake in a file: what, where, and what instead. Exit code 2.
class FileError : public thermal::InputError {
 public:
  FileError(Location const& where, std::string_view what);
};

/// One value of a machine, experiment or study file, with the place where it was written.
class Value {
 public:
  struct Entry;
  using List = std::vector<Value>;
  using Table = std::vector<Entry>;  ///< in the order of the file

  Location where;
  std::variant<std::string, double, std::int64_t, bool, List, Table> content;

  [[nodiscard]] bool is_text() const { return std::holds_alternative<std::string>(content); }
  [[nodiscard]] bool is_table() const { return std::holds_alternative<Table>(content); }
  [[nodiscard]] bool is_list() const { return std::holds_alternative<List>(content); }

  /// The value under a key, or nullptr; only for tables.
  [[nodiscard]] Value const* find(std::string_view key) const;
  [[nodiscard]] Value* find(std::string_view key);
  [[nodiscard]] std::vector<std::string> keys() const;

  /// "a text", "a number", …: what stands here, for messages; and the value as it was written.
  [[nodiscard]] std::string kind() const;
  [[nodiscard]] std::string text() const;
};

struct Value::Entry {
  std::string key;
  Location where;  ///< of the key
  Value value;
};

/// Reads a TOML file. FileError for a syntax error or a file that cannot be read.
[[nodiscard]] Value read_toml(std::filesystem::path const& path);
[[nodiscard]] Value parse_toml(std::string_view text, std::string const& file_name);

/// Sets a value by the path that names a parameter: `bearing.front.grease_factor` is the key `grease_factor` of the
/// `[[bearing]]` whose name is "front"; `spindle.maximum_speed` is a key of the table `[spindle]`; tables without names
/// go by their number from 0: `displacement.E_Z.segment.2.length`. The key need not be there yet. Errors list the
/// nearest names; `prefix` is what messages put in front of the path.
void set_parameter(Value& document, std::string_view path, std::string const& text, std::string_view prefix = {});

/// The table that a path's first parts name, and the key that is left: {"bearing.front", "grease_factor"}.
[[nodiscard]] std::pair<Value*, std::string> find_parameter(Value& document, std::string_view path,
                                                            std::string_view prefix = {});

}  // namespace thermotwin::twin
