#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct Stratification {
  std::string name;
  double gradient = required;  ///< [K/m]
  double reference_height = 1.0;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Stratification::name, "unique among these");
    f("gradient", &Stratification::gradient, dimension::temperature_gradient,
      "upwards, besides the one of the experiment", Range{-1.5, 1.5});
    f("reference_height", &Stratification::reference_height, dimension::length,
      "of the room's sensor above the machine's zero", Range{0.0, 3.0});
  }

  void add_to(Assembly& assembly) const {
    assembly.warm_air({.gradient = gradient, .reference_height = reference_height});
  }
};

}  // namespace

Effect const& stratification_effect() {
  static Effect const effect = make_effect<Stratification>(
      {"stratification",
       "the air is warmer at the top of the machine than the room's sensor tells",
       "T_air(z) = T_room + g (z − z_r)",
       "boundary, input",
       "all surfaces in the air",
       "a constant offset from bottom to top, motor and head first; the column tilts at standstill too",
       "physics.md 2.13, §7 no. 12",
       {12},
       {"heat", "hot_neighbour", "hydraulic_unit"},
       "a second sensor in the air, higher up; a fan that mixes the air"},
      {{.amplitude = "gradient", .largest = 1.5, .either_sign = true}});
  return effect;
}

}  // namespace thermotwin::twin
