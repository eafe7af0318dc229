#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "output/locked_file.h"

namespace thermotwin::output {

/// A file of records that only grows. Whatever was appended before the process was killed is read back whole; a record
/// that was cut short at the end is dropped when the file is opened again. A file that is something else, or damaged in
/// front of whole records, is refused and left as it is.
///
/// Per record: a mark, its length and its CRC-32, eight bytes each, then the bytes. (Little endian.)
class Journal {
 public:
  /// Opens the file or makes it, for this process alone. OutputError while another one has it; thermal::InputError for
  /// a file that does not begin as a journal, or is damaged.
  explicit Journal(std::filesystem::path const& path);

  /// What was in the file when it was opened; empty when taken a second time.
  [[nodiscard]] std::vector<std::string> take_records() { return std::move(records_); }

  /// The whole records of a file, which is left as it is, whoever has it. thermal::InputError as above.
  [[nodiscard]] static std::vector<std::string> read(std::filesystem::path const& path);

  /// Whole records of a file that another process may be writing, by their lengths alone; 0 when it is not there.
  [[nodiscard]] static std::int64_t count(std::filesystem::path const& path);

  void append(std::string_view record);
  void remove() const { file_.remove(); }

 private:
  LockedFile file_;
  std::vector<std::string> records_;
};

}  // namespace thermotwin::output
