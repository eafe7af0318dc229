#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct SensorLag {
  std::string name, sensor;
  double lag = required;  ///< [s]

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &SensorLag::name, "unique among these");
    f.name("sensor", &SensorLag::sensor, "whose reading lags");
    f("lag", &SensorLag::lag, dimension::time, "added to the instrument's own", Range{0.0, 900.0});
  }

  void add_to(Assembly& assembly) const { assembly.misread({.channel = sensor, .lag = lag}); }
};

}  // namespace

Effect const& sensor_lag_effect() {
  static Effect const effect = make_effect<SensorLag>(
      {"sensor_lag",
       "the reading of one temperature sensor lags: filter, paste, a heavy case",
       "τ dy/dt = T − y",
       "sensor",
       "one temperature sensor",
       "one channel alone: residual like the slope, − at the start, + at stop, nothing in the steady state",
       "physics.md 4, §7 no. 28",
       {28},
       {"extra_mass", "sensor_contact"},
       "a step and a long hold: neighbours answer to a mass, a lag stays in one channel"},
      {{.amplitude = "lag", .largest = 900.0, .also_about = 0.5, .sites = {{"sensor", "sensor"}}}});
  return effect;
}

}  // namespace thermotwin::twin
