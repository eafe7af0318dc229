#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct ProbeDrift {
  std::string name, displacement;
  double drift = 0.0;    ///< [m/s]
  double per_air = 0.0;  ///< [m/K]

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &ProbeDrift::name, "unique among these");
    f.name("displacement", &ProbeDrift::displacement,
           "channel whose probe or fixture drifts, or ball screw, for its laser");
    f("drift", &ProbeDrift::drift, dimension::speed, "steady, from the start of the run", Range{-1.4e-10, 1.4e-10});
    f("per_air", &ProbeDrift::per_air, dimension::growth_per_kelvin,
      "per kelvin of the air near the tool since the start", Range{-2e-6, 2e-6});
  }

  void add_to(Assembly& assembly) const {
    assembly.misread({.channel = displacement, .drift = drift, .per_air = per_air, .of_displacement = true});
  }
};

}  // namespace

Effect const& probe_drift_effect() {
  static Effect const effect = make_effect<ProbeDrift>(
      {"probe_drift",
       "probe, electronics or fixture of a displacement drift",
       "y = E + b t + a (T_air − T_air(0))",
       "sensor",
       "one displacement channel, or all errors of position of a ball screw",
       "the displacement alone, with the spindle locked too: with time, or with the air near the fixture",
       "physics.md 4, §7 nos. 35 and 36",
       {35, 36},
       {"compensation", "ambient_cycle", "displacement_step", "laser_air"},
       "cap test: a fixed target before the same probes"},
      {{.amplitude = "drift",
        .largest = 0.5e-6 / 3600.0,
        .either_sign = true,
        .sites = {{"displacement", "displacement or screw"}}},
       {.amplitude = "per_air",
        .largest = 2e-6,
        .either_sign = true,
        .sites = {{"displacement", "displacement or screw"}}}});
  return effect;
}

}  // namespace thermotwin::twin
