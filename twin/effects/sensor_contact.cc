#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct SensorContact {
  std::string name, sensor;
  double air_share = required;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &SensorContact::name, "unique among these");
    f.name("sensor", &SensorContact::sensor, "that touches badly");
    f("air_share", &SensorContact::air_share, dimension::dimensionless, "added to the instrument's own stem loss",
      Range{0.0, 0.3});
  }

  void add_to(Assembly& assembly) const { assembly.misread({.channel = sensor, .air_share = air_share}); }
};

}  // namespace

Effect const& sensor_contact_effect() {
  static Effect const effect = make_effect<SensorContact>(
      {"sensor_contact",
       "one temperature sensor touches badly and reads part of the air",
       "y = (1 − χ) T + χ T_air",
       "sensor",
       "one temperature sensor",
       "one channel alone: a constant ratio to the rise over the air, the same in warm-up and cool-down",
       "physics.md 4, §7 no. 29",
       {29},
       {"fit", "sensor_lag", "sensor_drift"},
       "swap the sensor; a fit changes the heat that all sensors see, this one reading only"},
      {{.amplitude = "air_share", .largest = 0.3, .ordinary = 0.05, .sites = {{"sensor", "sensor"}}}});
  return effect;
}

}  // namespace thermotwin::twin
