#include <cmath>

#include "thermal/material.h"
#include "thermal/shaft_deformation.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct CentrifugalGrowth {
  std::string name, displacement;
  double growth = 0.0;  ///< [m]
  double power = 2.0;
  double shaft_length = 0.0, outer_diameter = 0.0, inner_diameter = 0.0;
  std::string material = "42CrMo4";
  double weight = 1.0;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &CentrifugalGrowth::name, "unique among these");
    f.name("displacement", &CentrifugalGrowth::displacement, "channel that it moves");
    f("growth", &CentrifugalGrowth::growth, dimension::length,
      "at full speed, of bearings, drawbar and tool seat: positive where the channel is", Range{-20e-6, 20e-6});
    f("power", &CentrifugalGrowth::power, dimension::dimensionless, "of the speed, for that growth", Range{1.0, 4.0});
    f("shaft_length", &CentrifugalGrowth::shaft_length, dimension::length,
      "besides, a shaft of this length gets shorter: from its locating bearing to the tip", Range{0.0, 2.0});
    f("outer_diameter", &CentrifugalGrowth::outer_diameter, dimension::length, "of that shaft", Range{0.0, 0.5});
    f("inner_diameter", &CentrifugalGrowth::inner_diameter, dimension::length, "of that shaft", Range{0.0, 0.5});
    f("material", &CentrifugalGrowth::material, "known material of that shaft");
    f("weight", &CentrifugalGrowth::weight, dimension::dimensionless, "sign with which the shaft counts in the channel",
      Range{-1.0, 1.0});
  }

  /// c of c ω² [m s²].
  [[nodiscard]] double shortening() const {
    auto const& metal = thermal::material(material);
    thermal::RotatingRing const shaft{0.5 * inner_diameter, 0.5 * outer_diameter, metal.youngs_modulus,
                                      metal.poisson_ratio, metal.density};
    return shaft_length * thermal::centrifugal_strain<double>(shaft, 1.0);
  }

  void add_to(Assembly& assembly) const {
    double const full_speed = assembly.maximum_spindle_speed();
    if (growth != 0.0 && full_speed > 0.0)
      assembly.displace(InputTerm{displacement, "spindle.speed", growth / std::pow(full_speed, power), power});
    if (shaft_length > 0.0) assembly.displace(InputTerm{displacement, "spindle.speed", weight * shortening(), 2.0});
  }
};

}  // namespace

Effect const& centrifugal_growth_effect() {
  static Effect const effect = make_effect<CentrifugalGrowth>(
      {"centrifugal_growth",
       "displacement that follows the speed at once, without heat",
       "ΔE = g (ω/ω_max)^p + w L ε,  ε = −ν ρ ω² (a² + b²)/(2E)",
       "deformation",
       "a displacement channel",
       "power of speed 2; within 10 s of a change of speed, equal and opposite at stop; no temperature answers",
       "physics.md 3.7, §7 no. 32",
       {32},
       {"compensation", "bearing_shift", "held_shaft"},
       "stop and go every few minutes, extrapolated to the moment of the change; the controller's compensation "
       "switched off"},
      {{.amplitude = "growth",
        .largest = 20e-6,
        .either_sign = true,
        .needs_spindle = true,
        .sites = {{"displacement", "displacement"}}}});
  return effect;
}

}  // namespace thermotwin::twin
