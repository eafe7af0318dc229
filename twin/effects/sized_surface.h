#pragma once

#include <fmt/format.h>
#include <optional>
#include <string>

#include "thermal/error.h"
#include "twin/assembly.h"

namespace thermotwin::twin {

/// The place with the area that a table gives; without one its own. InputError where there is neither, as on a lump.
[[nodiscard]] inline Place sized_surface(Place place, std::optional<double> area, std::string const& table) {
  if (area) place.site = thermal::with_area(place.site, *area);
  if (!(place.area() > 0.0))
    throw thermal::InputError(fmt::format("{}: '{}' has no area of its own; give one", table, place.text));
  return place;
}

}  // namespace thermotwin::twin
