#include "twin/diagnosis/warmer_air.h"

namespace thermotwin::twin {

thermal::NetworkDerivative warmer_air(thermal::Network const& network) {
  thermal::NetworkDerivative d = thermal::lengthened({}, network);
  auto const& names = network.channel_names();
  for (std::size_t b = 0; b < network.boundaries().size(); ++b)
    for (auto const& term : network.boundaries()[b].terms)
      if (names[std::size_t(term.channel)] == "ambient.floor_temperature") d.boundary_offset[b] = 1.0;
  return d;
}

}  // namespace thermotwin::twin
