#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct SensorDrift {
  std::string name, sensor;
  double drift = required;  ///< [K/s]

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &SensorDrift::name, "unique among these");
    f.name("sensor", &SensorDrift::sensor, "whose reading drifts");
    f("drift", &SensorDrift::drift, dimension::temperature_rate,
      "besides the instrument's own: a fault is 0.02 to 0.5 K/day", Range{-6e-6, 6e-6});
  }

  void add_to(Assembly& assembly) const { assembly.misread({.channel = sensor, .drift = drift}); }
};

}  // namespace

Effect const& sensor_drift_effect() {
  static Effect const effect = make_effect<SensorDrift>(
      {"sensor_drift",
       "the reading of one temperature sensor drifts away",
       "y = T + b t",
       "sensor",
       "one temperature sensor",
       "one channel alone: no other sensor and no displacement answers, no heat balance explains it; goes on at "
       "standstill",
       "physics.md 4, §7 no. 27",
       {27},
       {"ambient_cycle", "foundation", "sensor_contact"},
       "swap the sensor, or read it in ice; leave it out and see what the others say"},
      {{.amplitude = "drift", .largest = 0.5 / 86400.0, .either_sign = true, .sites = {{"sensor", "sensor"}}}});
  return effect;
}

}  // namespace thermotwin::twin
