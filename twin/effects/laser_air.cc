#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

constexpr double refraction_of_air = -0.955e-6;  // 1/K: how much longer a way seems through warmer air

struct LaserAir {
  std::string name, screw;
  double per_air = refraction_of_air;  ///< [1/K]

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &LaserAir::name, "unique among these");
    f.name("screw", &LaserAir::screw, "ball screw whose errors of position are read");
    f("per_air", &LaserAir::per_air, dimension::expansion,
      "per metre, and kelvin of the air near the tool since the start", Range{-3e-6, 3e-6});
  }

  void add_to(Assembly& assembly) const {
    assembly.misread({.channel = screw, .air_strain = per_air, .of_displacement = true});
  }
};

}  // namespace

Effect const& laser_air_effect() {
  static Effect const effect = make_effect<LaserAir>(
      {"laser_air",
       "a laser is not corrected for the temperature of the air in its path",
       "y(x) = E(x) + a x (T_air − T_air(0))",
       "sensor",
       "all errors of position of a ball screw",
       "the errors of position alone, in proportion to the position, with the air, while the machine rests, too",
       "physics.md 4, §7 no. 36",
       {36},
       {"scale", "probe_drift"},
       "a record of the air in the path; the zero set at another dead path"},
      {{.amplitude = "per_air", .largest = 1.5e-6, .either_sign = true, .sites = {{"screw", "screw"}}}});
  return effect;
}

}  // namespace thermotwin::twin
