#include "thermal/radiation.h"

#include "thermal/laws.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/sized_surface.h"

namespace thermotwin::twin {
namespace {

/// q = σ ε₁₂ A F₁₂ (T₂⁴ − T₁⁴) into port 0, through its half cell. c = {ε₁₂, A, F₁₂, R of the half cell [K/W]}.
struct RadiationLaw {
  static constexpr std::string_view name = "radiation";
  static constexpr int ports = 2, coefficients = 4, inputs = 0;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const*, S* q) {
    thermal::exchange<S>(thermal::radiation_heat<S>(c[0], c[1], c[2], T[0], T[1], c[3]), q);
  }
};

struct Radiation {
  std::string name, on, to = "ambient";
  std::optional<double> area;
  double emissivity = 0.9, other_emissivity = 1.0;
  double view = 1.0, view_back = 0.0;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Radiation::name, "unique among these");
    f.name("on", &Radiation::on, "surface");
    f("to", &Radiation::to, "place that it faces, or \"ambient\": a room of air temperature");
    f("area", &Radiation::area, dimension::area, "default: that of the surface; a lump has none of its own",
      Range{1e-3, 20.0});
    f("emissivity", &Radiation::emissivity, dimension::dimensionless, "painted 0.9, cast 0.6, machined 0.2",
      Range{0.05, 1.0}.up_to(1.0));
    f("other_emissivity", &Radiation::other_emissivity, dimension::dimensionless, "of the other side; a room: 1",
      Range{0.05, 1.0}.up_to(1.0));
    f("view", &Radiation::view, dimension::dimensionless, "F12, share of its radiation that meets the other side",
      Range{0.05, 1.0}.up_to(1.0));
    f("view_back", &Radiation::view_back, dimension::dimensionless, "F21 = F12 A1/A2; 0 where the other is far larger",
      Range{0.0, 1.0}.up_to(1.0));
  }

  void add_to(Assembly& assembly) const {
    Place const place =
        sized_surface(area ? assembly.place(on) : assembly.surface(on), area, "radiation '" + name + "'");
    double const both = thermal::exchange_emissivity<double>(emissivity, other_emissivity, view, view_back);
    for (auto const& contact : place.site.contacts)
      assembly.network().add<RadiationLaw>(
          assembly.part(),
          {assembly.node(place, contact.node),
           to == "ambient" ? assembly.air(contact.centre) : assembly.port(assembly.place(to, {"ambient"}))},
          {both, contact.area, view, contact.resistance()});
  }
};

}  // namespace

Effect const& radiation_effect() {
  static Effect const effect =
      make_effect<Radiation>({"radiation",
                              "radiation between two surfaces, or from one to the room",
                              "q = σ ε12 A F12 (T2⁴ − T1⁴),  ε12 = ε1 ε2/(1 − (1 − ε1)(1 − ε2) F12 F21)",
                              "link, film",
                              "surfaces that see each other: motor and column, cover and bed; any surface and the room",
                              "proportional to the difference of two temperatures, about 5 W/K per m²; does not follow "
                              "speed; a room film holds "
                              "radiation already",
                              "physics.md 2.9, §7 no. 23",
                              {23},
                              {"air_gap", "motor_loss"},
                              "a shield between both; what remains is the loss itself"},
                             {{.amplitude = "area", .largest = 1.0, .sites = {{"on", "pair", "to"}}},
                              {.amplitude = "area", .largest = 1.0, .sites = {{"on", "bare surface"}}}});
  return effect;
}

}  // namespace thermotwin::twin
