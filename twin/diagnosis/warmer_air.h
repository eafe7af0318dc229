#pragma once

#include "thermal/parameter_columns.h"

namespace thermotwin::twin {

/// The room's air, wherever the machine meets it, one kelvin warmer.
[[nodiscard]] thermal::NetworkDerivative warmer_air(thermal::Network const& network);

}  // namespace thermotwin::twin
