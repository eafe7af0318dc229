#include "twin/channel_flow.h"

#include <cmath>

#include "thermal/error.h"
#include "thermal/fluid.h"
#include "thermal/physical_constant.h"

namespace thermotwin::twin {
namespace {

thermal::FluidProperties<double> properties_at_20(ChannelDescription const& description) {
  return thermal::properties(thermal::fluid(description.fluid), thermal::reference_temperature);
}

}  // namespace

thermal::Channel channel_of(ChannelDescription const& description) {
  auto const fluid = properties_at_20(description);
  double const d = description.diameter;
  return {description.origin, description.axis(), description.length,  M_PI / 4.0 * d * d,
          M_PI * d,           fluid.density,      fluid.specific_heat, description.cells};
}

void add_channel_flow(Assembly& assembly, ChannelDescription const& description) {
  if (description.flow.empty() && description.inlet.empty()) return;
  if (description.flow.empty() || description.inlet.empty())
    throw thermal::InputError("channel '" + description.name + "' needs both flow and inlet, or neither in a circuit");
  auto const inlet = assembly.boundary(description.inlet);
  thermal::add_flow(assembly.network(), assembly.part(), assembly.body(description.name),
                    properties_at_20(description).specific_heat, assembly.channel(description.flow), inlet, inlet);
}

}  // namespace thermotwin::twin
