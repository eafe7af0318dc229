#include <cmath>

#include "thermal/stroke.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

/// Q = ΔE v d/s: one reversal per stroke s. Ports: nut, screw. c = {ΔE, nut's share, stroke or 0}, u = {v, d, from,
/// to}.
struct ReversalHeat {
  static constexpr std::string_view name = "heat of a ball nut's reversals";
  static constexpr int ports = 2, coefficients = 3, inputs = 4;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const*, S const* c, double const* u, S* q) {
    S const stroke = c[2] > S(0.0) ? c[2] : S(std::abs(u[3] - u[2]));
    if (u[0] == 0.0 || !(stroke > S(0.0))) return;
    S const heat = c[0] * u[0] * u[1] / stroke;
    q[0] = c[1] * heat;
    q[1] = (1.0 - c[1]) * heat;
  }
};

struct NutReversal {
  std::string name, nut, screw, axis = "z";
  double energy = required;
  std::optional<double> stroke;
  double nut_length = required, nut_share = 0.5;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &NutReversal::name, "unique among these");
    f.name("nut", &NutReversal::nut, "body of the nut");
    f.name("screw", &NutReversal::screw, "bar along which it runs");
    f("axis", &NutReversal::axis, "whose feed moves it");
    f("energy", &NutReversal::energy, dimension::energy, "of one reversal", Range{0.5, 5.0});
    f("stroke", &NutReversal::stroke, dimension::length,
      "between reversals; default: the axis' stroke; must be given where the nut is followed to and fro",
      Range{0.01, 10.0}.above_zero());
    f("nut_length", &NutReversal::nut_length, dimension::length, "over which the balls run",
      Range{0.02, 0.5}.above_zero());
    f("nut_share", &NutReversal::nut_share, dimension::dimensionless, "of the heat, into the nut", share_range);
  }

  void add_to(Assembly& assembly) const {
    int const from = assembly.channel(axis + ".stroke_from"), to = assembly.channel(axis + ".stroke_to");
    auto const under =
        thermal::add_moving_average(assembly.network(), assembly.place(screw).site, from, to, nut_length);
    assembly.network().add<ReversalHeat>(
        assembly.part(), {assembly.port(nut), under}, {energy, nut_share, stroke.value_or(0.0)},
        {assembly.channel(axis + ".feed"), assembly.channel(axis + ".duty"), from, to});
  }
};

}  // namespace

Effect const& nut_reversal_effect() {
  static Effect const effect = make_effect<NutReversal>(
      {"nut_reversal",
       "heat of a ball nut each time that its axis reverses",
       "Q = ΔE f,  f = v d/stroke",
       "source",
       "nut and screw",
       "proportional to the number of reversals: at one mean feed more with short strokes; ends at stop",
       "physics.md 1.8, §7 no. 17",
       {17},
       {"ball_nut", "nut_preload", "guide"},
       "the same mean feed with another stroke"},
      {{.amplitude = "energy",
        .largest = 5.0,
        .sites = {{"nut", "nut", "screw"}},
        .shapes = {{{"nut_length", "60 mm"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
