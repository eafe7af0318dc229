#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "thermal/geometry.h"

namespace thermotwin::thermal {

/// The smallest box along the machine's axes around cells; empty for none.
[[nodiscard]] Eigen::AlignedBox3d bounding_box(std::vector<Cell> const& cells);

}  // namespace thermotwin::thermal
