#pragma once

#include <filesystem>

#include "twin/file/schema.h"

namespace thermotwin::twin {

/// The text files (TOML) that the program reads, and the list of sensors that `place` writes.
enum class FileKind { experiment, campaign, error_model, study, measurement, candidates, machine, sensors };

/// The kind that knows most of the keys at the top of a document; among equals the first, and a machine where none
/// knows any.
[[nodiscard]] FileKind file_kind(Value const& document);

/// Whether no other kind knows more of the document's keys than all the rest.
[[nodiscard]] bool may_be(Value const& document, FileKind kind);

/// FileError "is a machine file; an experiment is due" where it may not be one.
void refuse_other_kind(Value const& document, FileKind due);

/// InputError where a file of kind `written` would take the place of one of another kind, or of any other text; an
/// empty file may go. Every command that writes a text file (TOML) asks this before any work.
void refuse_to_replace(std::filesystem::path const& output, FileKind written);

/// read_fields of a whole file: what is wrong with one of another kind is that.
template <class T>
void read_file_fields(Value const& document, FileKind due, T& object) {
  try {
    read_fields(document, object);
  } catch (FileError const&) {
    refuse_other_kind(document, due);
    throw;
  }
}

}  // namespace thermotwin::twin
