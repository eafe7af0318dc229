#pragma once

#include <string>
#include <vector>

#include "twin/file/schema.h"

namespace thermotwin::twin {

/// The values of a file outside the plausible range of their field, each with its place; none of them is refused.
[[nodiscard]] std::vector<std::string> implausible_values(Value const& document,
                                                          std::vector<FieldRecord> const& fields);

}  // namespace thermotwin::twin
