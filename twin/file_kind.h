#pragma once

#include <string_view>

#include "twin/file/schema.h"

namespace thermotwin::twin {

/// The text files (TOML) that the program reads.
enum class FileKind { experiment, campaign, error_model, study, measurement, candidates, machine };

/// The kind that knows most of the keys at the top of a document; among equals the first, and a machine where none
/// knows any.
[[nodiscard]] FileKind file_kind(Value const& document);

/// FileError "is a machine file; an experiment is due" where one other kind knows more of the document's keys than all
/// the rest.
void refuse_other_kind(Value const& document, FileKind due);

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
