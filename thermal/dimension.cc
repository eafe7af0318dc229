#include "thermal/dimension.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace thermotwin::thermal {
namespace {

namespace dim = dimension;

/// How one dimension is spoken of; `usual` as in usual_units.
struct Usage {
  Dimension dimension;
  std::string_view name;
  std::string_view unit;
  std::string_view example;
  std::vector<std::string_view> usual;
};

std::vector<Usage> const& usages() {
  static std::vector<Usage> const table = {
      {dim::dimensionless, "number", "1", "0.8", {"1"}},
      {dim::angle, "angle", "1", "15 deg", {"1"}},
      {dim::tilt, "angle", "1", "15 urad", {"1"}},
      {dim::length, "length", "m", "600 mm", {"mm", "um", "m"}},
      {dim::area, "area", "m2", "0.06 m2", {"m2", "mm2"}},
      {dim::volume, "volume", "m3", "200 L", {"L", "m3", "mm3"}},
      {dim::curvature, "curvature", "1/m", "1e-6 1/m", {"1/m"}},
      {dim::second_moment, "second moment of area", "m4", "1e-4 m4", {"m4", "mm4"}},
      {dim::mass, "mass", "kg", "14 kg", {"kg", "g"}},
      {dim::time, "time", "s", "15 min", {"min", "s", "h", "day"}},
      {dim::angular_speed, "angular speed", "rad/s", "6000 rpm", {"rpm", "rad/s"}},
      {dim::speed, "speed", "m/s", "8000 mm/min", {"mm/min", "m/s", "um/h"}},
      {dim::acceleration, "acceleration", "m/s2", "9.81 m/s2", {"m/s2"}},
      {dim::density, "density", "kg/m3", "7850 kg/m3", {"kg/m3"}},
      {dim::force, "force", "N", "1500 N", {"N", "kN"}},
      {dim::torque, "torque", "N m", "0.45 N m", {"N m"}},
      {dim::power, "power", "W", "40 W", {"W", "kW", "mW"}},
      {dim::stiffness, "stiffness", "N/m", "0.9 kN/um", {"kN/um", "N/um", "N/m"}},
      {dim::pressure, "pressure", "Pa", "210 GPa", {"bar", "GPa", "MPa", "kPa", "Pa"}},
      {dim::viscosity, "kinematic viscosity", "m2/s", "32 mm2/s", {"mm2/s", "m2/s"}},
      {dim::dynamic_viscosity, "dynamic viscosity", "Pa s", "1 mPa s", {"mPa s", "Pa s"}},
      {dim::volume_flow, "volume flow", "m3/s", "8 L/min", {"L/min", "L/h", "m3/s"}},
      {dim::mass_flow, "mass flow", "kg/s", "1.2 kg/s", {"kg/s", "g/s"}},
      {dim::temperature_difference, "temperature difference", "K", "0.2 K", {"K", "mK"}},
      {dim::temperature_gradient, "temperature gradient", "K/m", "1.5 K/m", {"K/m"}},
      {dim::temperature_rate, "temperature rate", "K/s", "3 K/day", {"K/h", "K/day", "K/min", "K/s"}},
      {dim::expansion, "thermal expansion", "1/K", "11.8 um/(m K)", {"um/(m K)", "1/K"}},
      {dim::growth_per_kelvin, "growth per kelvin", "m/K", "0.5 um/K", {"um/K", "m/K"}},
      {dim::conductance, "conductance", "W/K", "9 W/K", {"W/K"}},
      {dim::conductivity, "conductivity", "W/(m K)", "42 W/(m K)", {"W/(m K)"}},
      {dim::film_coefficient, "film coefficient", "W/(m2 K)", "8 W/(m2 K)", {"W/(m2 K)", "kW/(m2 K)"}},
      {dim::heat_flux, "heat flux", "W/m2", "100 W/m2", {"W/m2", "kW/m2"}},
      {dim::heat_density, "heat density", "W/m3", "1e5 W/m3", {"W/m3", "kW/m3"}},
      {dim::heat_capacity, "heat capacity", "J/K", "169 J/K", {"J/K", "kJ/K"}},
      {dim::specific_heat, "specific heat", "J/(kg K)", "460 J/(kg K)", {"J/(kg K)"}},
      {dim::latent_heat, "latent heat", "J/kg", "2450 kJ/kg", {"kJ/kg", "J/kg"}},
      {dim::current, "current", "A", "1.6 A", {"A", "mA"}},
      {dim::voltage, "voltage", "V", "24 V", {"V", "mV"}},
      {dim::resistance, "resistance", "ohm", "0.8 ohm", {"ohm"}},
      {dim::torque_constant, "torque constant", "N m/A", "1.6 N m/A", {"N m/A"}},
  };
  return table;
}

Usage const* usage_of(Dimension dimension) {
  auto const found = std::find_if(usages().begin(), usages().end(), [&](Usage const& usage) {
    return usage.dimension == dimension && usage.dimension.turn == dimension.turn;
  });
  return found == usages().end() ? nullptr : &*found;
}

std::string base_units(Dimension const& d) {
  std::array<std::pair<std::string_view, int>, 5> const bases = {
      {{"m", d.length}, {"kg", d.mass}, {"s", d.time}, {"K", d.temperature}, {"A", d.current}}};
  std::string text;
  for (auto const& [symbol, power] : bases) {
    if (power == 0) continue;
    text += (text.empty() ? "" : " ") + std::string(symbol) + (power == 1 ? "" : "^" + std::to_string(power));
  }
  return text;
}

}  // namespace

std::string name_of(Dimension dimension) {
  Usage const* usage = usage_of(dimension);
  return usage != nullptr ? std::string(usage->name) : "quantity in " + base_units(dimension);
}

std::string unit_of(Dimension dimension) {
  Usage const* usage = usage_of(dimension);
  return usage != nullptr ? std::string(usage->unit) : base_units(dimension);
}

std::string example_of(Dimension dimension) {
  Usage const* usage = usage_of(dimension);
  return usage != nullptr ? std::string(usage->example) : "1 " + base_units(dimension);
}

std::span<std::string_view const> usual_units(Dimension dimension) {
  Usage const* usage = usage_of(dimension);
  return usage != nullptr ? std::span<std::string_view const>(usage->usual) : std::span<std::string_view const>();
}

}  // namespace thermotwin::thermal
