#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct Scale {
  std::string name, screw, at;
  double expansion = required;  ///< [1/K]

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Scale::name, "unique among these");
    f.name("screw", &Scale::screw, "ball screw whose errors of position are read");
    f.name("at", &Scale::at, "place of the scale, or of the sensor that the controller reads");
    f("expansion", &Scale::expansion, dimension::expansion, "of the scale, or taken off per metre and kelvin",
      Range{-25e-6, 25e-6});
  }

  void add_to(Assembly& assembly) const {
    assembly.displace(TemperatureTerm{screw, assembly.place(at), 0.0, -expansion});
  }
};

}  // namespace

Effect const& scale_effect() {
  static Effect const effect = make_effect<Scale>(
      {"scale",
       "the scale of an axis grows, or its position is corrected by a temperature",
       "ΔE(x) = −α x (T_s − T_s(0))",
       "deformation",
       "all errors of position of a ball screw; place of the scale or of the controller's sensor",
       "the errors of position alone, in proportion to the position, with the temperature of the scale "
       "and not of the screw",
       "physics.md 3.8, §7 nos. 33 and 34",
       {33, 34},
       {"compensation", "laser_air"},
       "errors of position over the temperature of the scale while the screw is at rest"},
      {{.amplitude = "expansion",
        .largest = 12e-6,
        .either_sign = true,
        .sites = {{"screw", "screw"}, {"at", "casting"}}}});
  return effect;
}

}  // namespace thermotwin::twin
