#include "thermal/laws.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/sized_surface.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

struct FloodCoolant {
  std::string name, on, from, follows = "coolant.temperature", while_on = "coolant.on";
  double coefficient = required, offset = 0.0;
  std::optional<double> area;

  template <class Fields>
  static void fields(Fields& f) {
    using P = FloodCoolant;
    f.name("name", &P::name, "unique among these");
    f.name("on", &P::on, "surface that it wets: nose, table, workpiece; of a through-tool supply the bore");
    f("from", &P::from, "body of the coolant, to which it returns; without one its temperature follows a channel");
    f("follows", &P::follows, "input channel with the temperature of the supply");
    f("offset", &P::offset, dimension::temperature_difference, "added to it", Range{-20, 20});
    f("coefficient", &P::coefficient, dimension::film_coefficient, "of the wetted film", Range{200, 2000});
    f("area", &P::area, dimension::area, "default: that of the surface; a lump has none of its own", Range{1e-3, 10.0});
    f("while_on", &P::while_on, "input channel between 0 and 1 that scales it");
  }

  void check(Value const& table) const { refuse_both(table, "follows", "from"); }

  void add_to(Assembly& assembly) const {
    Place const place = sized_surface(assembly.surface(on), area, "flood_coolant '" + name + "'");
    auto const coolant = from.empty() ? assembly.boundary(follows, offset) : assembly.port(from);
    for (auto const& contact : place.site.contacts)
      assembly.network().add<thermal::SwitchedConductance>(
          assembly.part(), {assembly.node(place, contact.node), coolant},
          {contact.area / (1.0 / coefficient + contact.half_resistance)}, {assembly.share(while_on)});
  }
};

}  // namespace

Effect const& flood_coolant_effect() {
  static Effect const effect = make_effect<FloodCoolant>(
      {"flood_coolant",
       "cutting coolant that floods a surface or runs through the tool",
       "q = u h A (T_coolant − T)",
       "film",
       "nose, tool, table, workpiece, bed",
       "steps with the coolant's switch; pulls to the temperature of the coolant, often below the room's",
       "physics.md §7 no. 24",
       {24},
       {"draught", "purge_air", "cutting_heat"},
       "coolant on at standstill, with its temperature logged"},
      {{.amplitude = "coefficient",
        .largest = 2000.0,
        .sites = {{"on", "room surface"}},
        .shapes = {{{"area", "0.05 m2"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
