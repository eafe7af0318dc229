#include "thermal/evaporation.h"

#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

/// Port 0 liquid, port 1 room air (read only). c = {A, h, Le^(−2/3), relative humidity}, u = {flag}.
struct EvaporationHeat {
  static constexpr std::string_view name = "evaporation";
  static constexpr int ports = 2, coefficients = 4, inputs = 1;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    q[0] = -u[0] * thermal::evaporation_heat<S>(c[0], c[1], c[2], T[0], T[1], c[3]);
  }
};

struct Evaporation {
  std::string name, from;
  double area = required;
  double coefficient = 8.0;
  double lewis = thermal::lewis_factor;
  double humidity = 0.5;
  std::string while_on = "machine.on";

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Evaporation::name, "unique among these");
    f.name("from", &Evaporation::from, "body of the liquid, or wet place");
    f("area", &Evaporation::area, dimension::area, "wet surface", Range{0.0, 10.0});
    f("coefficient", &Evaporation::coefficient, dimension::film_coefficient, "of the film without evaporation",
      Range{2, 30});
    f("lewis", &Evaporation::lewis, dimension::dimensionless, "Le^(-2/3)", Range{0.8, 1.2});
    f("humidity", &Evaporation::humidity, dimension::dimensionless, "relative humidity of the room",
      Range{0.1, 0.95}.up_to(1.0));
    f("while_on", &Evaporation::while_on, "input channel between 0 and 1 that scales it");
  }

  void add_to(Assembly& assembly) const {
    Place wet = assembly.place(from);
    wet.site = thermal::with_area(wet.site, area);
    for (auto const& contact : wet.site.contacts)
      assembly.network().add<EvaporationHeat>(assembly.part(),
                                              {assembly.node(wet, contact.node), assembly.air(contact.centre)},
                                              {contact.area, coefficient, lewis, humidity}, {assembly.share(while_on)});
  }
};

}  // namespace

Effect const& evaporation_effect() {
  static Effect const effect =
      make_effect<Evaporation>({"evaporation",
                                "heat that coolant takes with it when it evaporates from a wet surface",
                                "q = −A h/(ρ c_p) Le^(−2/3) h_fg (ρ_s(T) − φ ρ_s(T_air))",
                                "source",
                                "tank, wet table, chip washing",
                                "wet surfaces sit 2…5 K below the room; goes on at stop; does not follow the spindle",
                                "physics.md 2.14 (2.12); Magnus; Lewis analogy",
                                {10},
                                {"heat", "flood_coolant"},
                                "cover the tank; log its temperature and the humidity"});
  return effect;
}

}  // namespace thermotwin::twin
