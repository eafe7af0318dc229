#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct ExtraMass {
  std::string name, at;
  double heat_capacity = required, conductance = required;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &ExtraMass::name, "unique among these");
    f.name("at", &ExtraMass::at, "place to which it is tied");
    f("heat_capacity", &ExtraMass::heat_capacity, dimension::heat_capacity, "C_m", Range{1e3, 5e4});
    f("conductance", &ExtraMass::conductance, dimension::conductance, "G_m to the place", Range{0.5, 20});
  }

  void add_to(Assembly& assembly) const {
    Place const place = assembly.place(at);
    auto const mass = assembly.network().add_body("extra mass '" + name + "'", {heat_capacity});
    for (auto const& contact : place.site.contacts)
      assembly.network().connect(assembly.part(), assembly.node(place, contact.node), mass,
                                 contact.in_series(conductance));
  }
};

/// What is inside a lump lags behind its surface, as such a mass would.
constexpr double against = 30.0;

}  // namespace

Effect const& extra_mass_effect() {
  static Effect const effect = make_effect<ExtraMass>(
      {"extra_mass",
       "a thermal mass that was left out: drawbar, cables, wall of a hose",
       "C_m dT_m/dt = G_m (T − T_m),  q = G_m (T_m − T)",
       "link",
       "any place",
       "nothing in the steady state; residual like a delayed slope, − in warm-up, + in cool-down; neighbours "
       "answer too; τ 5 min…3 h",
       "physics.md §7 no. 41",
       {41},
       {"sensor_lag"},
       "a step and a long hold: neighbours answer to a mass, a lag stays in one channel"},
      {{.amplitude = "conductance",
        .largest = 20.0,
        .against = against,
        .sites = {{"at", "solid"}},
        .proportional = {{"heat_capacity", 600.0}}},
       {.amplitude = "conductance",
        .largest = 20.0,
        .against = against,
        .sites = {{"at", "solid"}},
        .proportional = {{"heat_capacity", 2400.0}}},
       {.amplitude = "conductance",
        .largest = 7.0,
        .against = against,
        .sites = {{"at", "solid"}},
        .proportional = {{"heat_capacity", 7200.0}}}});
  return effect;
}

}  // namespace thermotwin::twin
