#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct ChannelWall {
  std::string name, channel;
  double heat_capacity = required;
  double time_constant = 20.0;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &ChannelWall::name, "unique among these");
    f.name("channel", &ChannelWall::channel, "[[channel]] that it encloses");
    f("heat_capacity", &ChannelWall::heat_capacity, dimension::heat_capacity, "C_w of the whole wall",
      Range{100.0, 1e6});
    f("time_constant", &ChannelWall::time_constant, dimension::time,
      "τ = C_w/(h A): 5 mm of steel 10 s in turbulent water, 300 s in laminar oil", Range{1.0, 1800.0}.above_zero());
  }

  void add_to(Assembly& assembly) const {
    Place const wetted = assembly.surface(channel + ".wall");
    std::vector<double> capacities;
    for (auto const& contact : wetted.site.contacts) capacities.push_back(heat_capacity * contact.share);
    thermal::Port wall = assembly.network().add_body("channel wall '" + name + "'", capacities);
    for (auto const& contact : wetted.site.contacts) {
      assembly.network().connect(assembly.part(), assembly.node(wetted, contact.node), wall,
                                 heat_capacity * contact.share / time_constant);
      ++wall.index;
    }
  }
};

}  // namespace

Effect const& channel_wall_effect() {
  static Effect const effect = make_effect<ChannelWall>(
      {"channel_wall",
       "the wall of a pipe, hose or jacket takes up heat from the fluid that passes it",
       "C_w dT_w/dt = C_w (T − T_w)/τ,  q = C_w (T_w − T)/τ, cell by cell, without conduction along the wall",
       "link",
       "[[channel]]",
       "nothing in the steady state; the fluid's front arrives late, by C_w over the heat capacity of the flow, and "
       "rounded",
       "physics.md §7 no. 41; plug flow with heat capacity of the wall: van der Heijde et al. 2017",
       {41},
       {"film", "sensor_lag"},
       "a step of the inlet and a long hold, at two flows: a wall delays, heat loss lowers the end, a lag of the "
       "sensor "
       "does not depend on the flow"},
      {{.amplitude = "heat_capacity",
        .largest = 3e5,
        .sites = {{"channel", "channel"}},
        .shapes = {{{"time_constant", "6 s"}}, {{"time_constant", "80 s"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
