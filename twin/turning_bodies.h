#pragma once

#include <string>
#include <vector>

#include "twin/file/value.h"

namespace thermotwin::twin {

/// Bodies that turn, and so carry no sensor: inner rings of bearings, screws, what a film of a rotating surface is on,
/// and what these carry.
[[nodiscard]] std::vector<std::string> turning_bodies(Value const& document);

/// Those of them that turn with the spindle, or say themselves that they turn. A feed drive can be measured at rest.
[[nodiscard]] std::vector<std::string> bodies_on_spindle(Value const& document);

}  // namespace thermotwin::twin
