#include "thermal/laws.h"
#include "thermal/radiation.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/given_temperature.h"

namespace thermotwin::twin {
namespace {

/// q = u (q_r + G (T_n − T)), q_r = σ ε A F (T_n⁴ − T⁴) through the half cell. Ports: surface, neighbour. c = {ε, A, F,
/// G, R of the half cell [K/W]}, u = {flag}.
struct NeighbourHeat {
  static constexpr std::string_view name = "heat from a neighbour";
  static constexpr int ports = 2, coefficients = 5, inputs = 1;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    S const radiation = thermal::radiation_heat<S>(c[0], c[1], c[2], T[0], T[1], c[4]);
    thermal::exchange<S>(u[0] * (radiation + c[3] * (T[1] - T[0])), q);
  }
};

struct HotNeighbour : GivenTemperature {
  std::string name, on, while_on = "machine.on";
  double area = required;
  double emissivity = 0.9, view = 0.2, conductance = 0.0;

  template <class Fields>
  static void fields(Fields& f) {
    using P = HotNeighbour;
    f.name("name", &P::name, "unique among these");
    f.name("on", &P::on, "place that faces the neighbour");
    GivenTemperature::fields_of<P>(f);
    f("area", &P::area, dimension::area, "of the machine's side", Range{0.05, 5.0});
    f("emissivity", &P::emissivity, dimension::dimensionless, "of both sides together", Range{0.05, 1.0}.up_to(1.0));
    f("view", &P::view, dimension::dimensionless, "share of the side's radiation that meets the neighbour",
      Range{0.05, 0.5}.up_to(1.0));
    f("conductance", &P::conductance, dimension::conductance, "by warm air besides", Range{0.0, 20.0});
    f("while_on", &P::while_on, "input channel between 0 and 1: the neighbour's own hours, the sun");
  }

  void add_to(Assembly& assembly) const {
    Place const place = assembly.place(on);
    auto const neighbour = port(assembly, "hot_neighbour '" + name + "'");
    for (auto const& contact : place.site.contacts)
      assembly.network().add<NeighbourHeat>(
          assembly.part(), {assembly.node(place, contact.node), neighbour},
          {emissivity, area * contact.share, view, contact.in_series(conductance), contact.resistance()},
          {assembly.share(while_on)});
  }
};

}  // namespace

Effect const& hot_neighbour_effect() {
  static Effect const effect = make_effect<HotNeighbour>(
      {"hot_neighbour",
       "radiation and warm air from a cabinet, another machine or the sun",
       "q = u [σ ε A F (T_n⁴ − T⁴) + G (T_n − T)],  u = 0…1",
       "boundary",
       "one side of head, column or bed",
       "does not follow the spindle but hours of its own; one-sided: tilt, E_X in a symmetric machine; 5…100 W",
       "physics.md 2.9, §7 no. 13",
       {13},
       {"heat", "stratification", "copper_loss"},
       "reflective screen; thermography; the neighbour's own hours"},
      {{.amplitude = "area",
        .largest = 2.0,
        .sites = {{"on", "room surface"}},
        .shapes = {{{"temperature", "60 degC"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
