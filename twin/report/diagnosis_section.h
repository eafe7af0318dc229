#pragma once

#include <filesystem>
#include <string>

#include "output/report_page.h"

namespace thermotwin::twin {

/// What `thermotwin diagnose --json` printed (docs/diagnosis.md), read back: the same document with, for people,
/// `sentence` that names what is missing, and with each effect its `meaning`, `separated_by` and amplitude as `text`.
/// InputError when the file is no diagnosis.
[[nodiscard]] output::Json diagnosis_json(std::filesystem::path const& path);

}  // namespace thermotwin::twin
