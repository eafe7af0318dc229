#include "thermal/channel_film.h"

#include <numbers>
#include <variant>

#include "thermal/error.h"
#include "thermal/joint.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/joint_side.h"

namespace thermotwin::twin {
namespace {

struct ChannelFilmPart {
  std::string name, wall, channel, flow, fluid = "water";
  double factor = 1.0;

  template <class Fields>
  static void fields(Fields& f) {
    using P = ChannelFilmPart;
    f.name("name", &P::name, "unique among these");
    f.name("wall", &P::wall, "surface that the fluid passes: bore of a cylinder, side of a block, a lump");
    f.name("channel", &P::channel, "[[channel]] that passes it");
    f.name("flow", &P::flow, "input channel with its mass flow, as there");
    f("fluid", &P::fluid, "known fluid, as there");
    f("factor", &P::factor, dimension::dimensionless, "of the wetted area, for roughness or fins", Range{0.5, 5.0});
  }

  void add_to(Assembly& assembly) const {
    Place const a = joint_side(assembly, wall), b = assembly.place(channel + ".wall");
    auto const* cell = std::get_if<thermal::RingCell>(&b.body->cells.front());
    if (!cell) throw thermal::InputError("channel_film '" + name + "': '" + channel + "' is no [[channel]]");
    double const section = std::numbers::pi * cell->outer_radius * cell->outer_radius;
    double const length = b.body->edges[0].back(), perimeter = b.area() / length;
    for (auto const& pair : thermal::pair(a.site, b.site)) {
      double const area = b.area() * pair.share;
      assembly.network().add<thermal::ChannelFilm>(assembly.part(),
                                                   {assembly.node(a, pair.a), assembly.node(b, pair.b)},
                                                   {factor * area, pair.resistance * area, section,
                                                    4.0 * section / perimeter, length, thermal::number_of_fluid(fluid)},
                                                   {assembly.channel(flow)});
    }
  }
};

}  // namespace

Effect const& channel_film_effect() {
  static Effect const effect = make_effect<ChannelFilmPart>(
      {"channel_film",
       "heat from a wall into the fluid of a channel that passes it, cell by cell",
       "q = A (T_wall − T_fluid)/(1/h + r);  h: laminar Nu = (3.66³ + 1.615³ Re Pr d/L)^(1/3), Gnielinski from Re 1e4, "
       "linear "
       "between, (Pr/Pr_w)^0.11",
       "link",
       "wall of a pipe, jacket or hose and the [[channel]] inside",
       "the fluid's front arrives late and rounded: the wall takes up and gives back heat; follows the flow",
       "physics.md 2.7; Gnielinski 1975; VDI Heat Atlas",
       {3},
       {"coolant_flow", "jacket"},
       "temperatures of supply and return; a step of the flow"});
  return effect;
}

}  // namespace thermotwin::twin
