#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct AmbientCycle {
  std::string name;
  double cosine = 0.0, sine = 0.0;  ///< [K]

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &AmbientCycle::name, "unique among these");
    f("cosine", &AmbientCycle::cosine, dimension::temperature_difference, "positive: warmest at midnight",
      Range{-4.0, 4.0});
    f("sine", &AmbientCycle::sine, dimension::temperature_difference, "positive: warmest at six in the morning",
      Range{-4.0, 4.0});
  }

  void add_to(Assembly& assembly) const {
    assembly.warm_air({.channel = "clock.day_cosine", .rise = cosine});
    assembly.warm_air({.channel = "clock.day_sine", .rise = sine});
  }
};

}  // namespace

Effect const& ambient_cycle_effect() {
  static Effect const effect =
      make_effect<AmbientCycle>({"ambient_cycle",
                                 "a daily cycle of the air that the room's sensor does not tell",
                                 "T_air = T_room + a cos(2π t/24 h) + b sin(2π t/24 h)",
                                 "boundary, input",
                                 "all surfaces in the air",
                                 "a line at 24 h in all channels, thin parts first; does not follow the spindle",
                                 "physics.md 2.13, §7 no. 11",
                                 {11},
                                 {"sensor_drift", "foundation", "hot_neighbour"},
                                 "24 to 48 h without any motion, with a sensor in the air at the machine (ISO 230-3)"},
                                {{.amplitude = "cosine", .largest = 4.0, .either_sign = true},
                                 {.amplitude = "sine", .largest = 4.0, .either_sign = true}});
  return effect;
}

}  // namespace thermotwin::twin
