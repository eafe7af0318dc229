#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace thermotwin::output {

/// A report as JSON that people read, too: indented, its numbers without the last bits that arithmetic leaves (0.2804,
/// not 0.28040000000000004), with a line break at its end.
[[nodiscard]] std::string json_text(nlohmann::ordered_json report);

}  // namespace thermotwin::output
