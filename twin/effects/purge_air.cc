#include "thermal/fluid.h"
#include "thermal/laws.h"
#include "thermal/physical_constant.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/given_temperature.h"

namespace thermotwin::twin {
namespace {

struct PurgeAir : GivenTemperature {
  std::string name, through, while_on = "machine.on";
  double flow = required;

  PurgeAir() { follows = "ambient.temperature"; }

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &PurgeAir::name, "unique among these");
    f.name("through", &PurgeAir::through, "place that the air passes and whose temperature it takes on");
    f("flow", &PurgeAir::flow, dimension::volume_flow, "of air at 20 degC and 1 bar", Range{1.6e-4, 1.7e-3});
    GivenTemperature::fields_of<PurgeAir>(f);
    f("while_on", &PurgeAir::while_on, "input channel between 0 and 1 that scales it");
  }

  void add_to(Assembly& assembly) const {
    auto const air = thermal::properties(thermal::Air{}, thermal::reference_temperature);
    Place const place = assembly.place(through);
    auto const supply = port(assembly, "purge_air '" + name + "'");
    for (auto const& contact : place.site.contacts)
      assembly.network().add<thermal::SwitchedConductance>(
          assembly.part(), {assembly.node(place, contact.node), supply},
          {contact.in_series(flow * air.density * air.specific_heat)}, {assembly.share(while_on)});
  }
};

}  // namespace

Effect const& purge_air_effect() {
  static Effect const effect = make_effect<PurgeAir>(
      {"purge_air",
       "sealing air, or the air of oil-air lubrication, that cools what it passes",
       "q = V̇ ρ c (T_air − T)",
       "boundary",
       "spindle nose, bearings",
       "power of speed 0; there while the air is on, at standstill too; pulls to the temperature of the air line",
       "physics.md 1.6, §7 no. 25",
       {25},
       {"fan_cooling", "flood_coolant"},
       "air off at standstill"},
      {{.amplitude = "flow", .largest = 1.7e-3, .sites = {{"through", "shaft"}}},
       {.amplitude = "flow", .largest = 1.7e-3, .sites = {{"through", "ring"}}}});
  return effect;
}

}  // namespace thermotwin::twin
