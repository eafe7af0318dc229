#include "thermal/laws.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/sized_surface.h"

namespace thermotwin::twin {
namespace {

struct Draught {
  std::string name, on, while_on = "ambient.door";
  double coefficient = required;
  std::optional<double> area;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Draught::name, "unique among these");
    f.name("on", &Draught::on, "surface that the air sweeps");
    f("coefficient", &Draught::coefficient, dimension::film_coefficient,
      "added to the film that is there: 0.5 to 3 times 8 W/(m2 K)", Range{4, 24});
    f("area", &Draught::area, dimension::area, "default: that of the surface; a lump has none of its own",
      Range{0.01, 20.0});
    f("while_on", &Draught::while_on, "input channel between 0 and 1: an open door, an extraction");
  }

  void add_to(Assembly& assembly) const {
    Place const place = sized_surface(assembly.surface(on), area, "draught '" + name + "'");
    for (auto const& contact : place.site.contacts)
      assembly.network().add<thermal::SwitchedConductance>(
          assembly.part(), {assembly.node(place, contact.node), assembly.air(contact.centre)},
          {contact.area / (1.0 / coefficient + contact.half_resistance)}, {assembly.share(while_on)});
  }
};

}  // namespace

Effect const& draught_effect() {
  static Effect const effect = make_effect<Draught>(
      {"draught",
       "moving air while a door is open or the enclosure is extracted",
       "q = u Δh A (T_air − T),  u = 0…1",
       "film",
       "table, front of head and column",
       "comes and goes with the door within minutes, at standstill too; the room's own step is the experiment's",
       "physics.md 2.13, §7 no. 15",
       {15},
       {"chiller", "stratification", "flood_coolant"},
       "record the door; a sensor in the air before the surface"},
      {{.amplitude = "coefficient",
        .largest = 24.0,
        .sites = {{"on", "room surface"}},
        .shapes = {{{"area", "0.5 m2"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
