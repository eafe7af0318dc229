#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/given_temperature.h"

namespace thermotwin::twin {
namespace {

struct Foundation : GivenTemperature {
  std::string name, at;
  double conductance = required;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Foundation::name, "unique among these");
    f.name("at", &Foundation::at, "place that stands on the ground");
    GivenTemperature::fields_of<Foundation>(f);
    f("conductance", &Foundation::conductance, dimension::conductance, "to the soil", Range{5, 50});
  }

  void add_to(Assembly& assembly) const {
    Place const place = assembly.place(at);
    auto const soil = port(assembly, "foundation '" + name + "'");
    for (auto const& contact : place.site.contacts)
      assembly.network().connect(assembly.part(), assembly.node(place, contact.node), soil,
                                 contact.in_series(conductance));
  }
};

}  // namespace

Effect const& foundation_effect() {
  static Effect const effect =
      make_effect<Foundation>({"foundation",
                               "conduction through feet and foundation into soil of its own temperature",
                               "q = G (T_soil − T), in series with the half cell of a discretised body",
                               "boundary",
                               "underside of the bed",
                               "drift over days and weeks, bottom of the bed first; does not follow spindle or room",
                               "physics.md §7 no. 40",
                               {40},
                               {"ambient_cycle", "heat"},
                               "idle for days in a room of constant temperature; a sensor in the soil"},
                              {{.amplitude = "conductance",
                                .largest = 50.0,
                                .sites = {{"at", "base"}},
                                .shapes = {{{"temperature", "15 degC"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
