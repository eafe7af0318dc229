#pragma once

#include <string>
#include <vector>

#include "twin/file/value.h"

namespace thermotwin::twin {

/// Bodies that turn, and so carry no sensor: inner rings of bearings, screws, what a film of a rotating surface is on,
/// and what these carry.
[[nodiscard]] std::vector<std::string> turning_bodies(Value const& document);

}  // namespace thermotwin::twin
