#pragma once

#include <string>
#include <vector>

#include "twin/file/value.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// What is odd about a machine though it can be built, with the places in its file: values that are not plausible,
/// inputs that nearly have a known name, sensors that turn with the spindle, masses that do not fit their box, nuts
/// with another lead than their axis. FileError for what building it does not look at: a count that is no whole number,
/// an uncertain range that is none.
[[nodiscard]] std::vector<std::string> machine_remarks(Value const& document, Machine const& machine);

}  // namespace thermotwin::twin
