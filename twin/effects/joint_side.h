#pragma once

#include <string>

#include "twin/assembly.h"

namespace thermotwin::twin {

/// Where a joint meets a body: the face that is named; without one the mantle of a cylinder or bar, or the cells.
[[nodiscard]] inline Place joint_side(Assembly& assembly, std::string const& text) {
  Place place = assembly.place(text);
  bool const plain = text.find('.') == std::string::npos || text.find('.') > text.find('[');
  bool const mantle = place.body->shape == thermal::Body::Shape::axial && place.body->faces.contains("surface");
  return plain && mantle && place.site.contacts.size() > 1 ? assembly.surface(text) : place;
}

}  // namespace thermotwin::twin
