#include "twin/known_names.h"

#include <fmt/format.h>
#include <string_view>

#include "scenarios/course.h"
#include "thermal/fluid.h"
#include "thermal/material.h"
#include "thermal/physical_constant.h"

namespace thermotwin::twin {

std::string material_list() {
  constexpr std::string_view heads = "  {:<25} {:>7} {:>12} {:>13} {:>9}\n";
  std::string text = "materials of bodies at 20 degC; a [[material]] of the file changes numbers of one of them\n\n" +
                     fmt::format(heads, "", "density", "conductivity", "specific heat", "expansion") +
                     fmt::format(heads, "", "kg/m3", "W/(m K)", "J/(kg K)", "um/(m K)");
  for (auto const& name : thermal::material_names()) {
    auto const& solid = thermal::material(name);
    text += fmt::format("  {:<25} {:>7.0f} {:>12.4g} {:>13.0f} {:>9.4g}{}{}\n", name, solid.density, solid.conductivity,
                        solid.specific_heat, 1e6 * solid.expansion, solid.meaning.empty() ? "" : "  ", solid.meaning);
  }
  text += "\nfluids of channels at 20 degC\n\n" +
          fmt::format(heads, "", "density", "conductivity", "specific heat", "viscosity") +
          fmt::format(heads, "", "kg/m3", "W/(m K)", "J/(kg K)", "mm2/s");
  for (auto const& name : thermal::fluid_names()) {
    auto const fluid = thermal::properties(thermal::fluid(name), thermal::reference_temperature);
    text += fmt::format("  {:<25} {:>7.4g} {:>12.3g} {:>13.0f} {:>9.3g}\n", name, fluid.density, fluid.conductivity,
                        fluid.specific_heat, 1e6 * fluid.kinematic_viscosity);
  }
  return text;
}

std::string channel_list() {
  std::string text =
      "input channels; AXIS: the name of an axis of the machine\n"
      "A file may give them in any unit of the same kind: rpm, mm/min, degC, %.\n\n";
  for (auto const& channel : scenarios::own_channels({0.0, {{"AXIS"}}}))
    text += fmt::format("  {:<27} {:<6} {}\n", channel.name, channel.unit, channel.description);
  return text +
         "\nA record must hold spindle.speed where the spindle turns, ambient.temperature, and what a part asks\n"
         "for beyond these channels (while_on = \"pump.on\"). Of these, what follows from others is found; what\n"
         "else is missing is supposed, and said. [[inputs]] of an experiment give any channel a programme.\n";
}

}  // namespace thermotwin::twin
