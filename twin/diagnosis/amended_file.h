#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace thermotwin::twin {

/// One line of a table that is added to a machine file: `key = text  # comment`. The text is what set_parameter takes:
/// a quantity, a name, a number, true or false; quotes are put where they are due.
struct AddedKey {
  std::string key, text, comment;
};

/// `[[effect]]` with its keys, under a comment of its own.
struct AddedTable {
  std::string effect;
  std::vector<AddedKey> keys;
  std::string comment;  ///< lines above the table; may be empty
};

/// A number of the file that became another one; `comment` stands behind the old value, "± 0.1 W/K".
struct ChangedValue {
  std::string path;  ///< as set_parameter takes it: bearing.front.grease_factor
  std::string text;
  std::string comment;
};

/// A machine file's text with tables at its end; nothing before them changes.
[[nodiscard]] std::string amended_text(std::string_view text, std::vector<AddedTable> const& tables);

/// A machine file's text with values replaced where they stand, or added where there were none: everything else stays
/// byte for byte, and the line says at its end what stood there: `mass = "41 kg"  # was 40 kg; ± 2 kg`.
/// InputError with the nearest name for a path that leads nowhere.
[[nodiscard]] std::string with_values(std::string_view text, std::vector<ChangedValue> const& changes);

/// A machine file's text with a comment as its last lines.
[[nodiscard]] std::string with_last_words(std::string_view text, std::string_view comment);

/// Writes `text`, which `machine_file` became, to `path`, atomically, and copies the machine's influence weights beside
/// it where none are. InputError when both are the same file: a user's file is never overwritten.
void write_amended(std::filesystem::path const& machine_file, std::filesystem::path const& path, std::string_view text);

}  // namespace thermotwin::twin
