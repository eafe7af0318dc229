#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct Compensation {
  std::string name, displacement, at;
  double gain = required;  ///< [m/K]

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Compensation::name, "unique among these");
    f.name("displacement", &Compensation::displacement,
           "channel that the controller corrects, or ball screw whose zero it shifts");
    f.name("at", &Compensation::at, "place of the sensor that the controller reads");
    f("gain", &Compensation::gain, dimension::growth_per_kelvin, "taken off per kelvin", Range{-5e-6, 5e-6});
  }

  void add_to(Assembly& assembly) const { assembly.displace(TemperatureTerm{displacement, assembly.place(at), -gain}); }
};

}  // namespace

Effect const& compensation_effect() {
  static Effect const effect = make_effect<Compensation>(
      {"compensation",
       "the controller's own compensation was left on while the error was measured",
       "ΔE = −k (T_s − T_s(0))",
       "deformation",
       "a displacement channel, or all errors of position of a ball screw; place of the controller's sensor",
       "the displacement alone: collinear with one temperature, and all temperatures agree",
       "physics.md §7 no. 34",
       {34},
       {"centrifugal_growth", "bearing_shift", "probe_drift", "scale"},
       "compensation switched off; the controller's sensor warmed alone; steps of 1 um"},
      {{.amplitude = "gain",
        .largest = 5e-6,
        .either_sign = true,
        .sites = {{"displacement", "displacement or screw"}, {"at", "resting solid"}}}});
  return effect;
}

}  // namespace thermotwin::twin
