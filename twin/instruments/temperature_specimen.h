#pragma once

#include <map>
#include <string>

#include "twin/instruments/readings.h"
#include "twin/instruments/temperature_sensor.h"

namespace thermotwin::twin {

/// The properties that one temperature sensor has [SI], as TemperatureSensor names them.
struct TemperatureSpecimen {
  double offset = 0.0;
  double gain = 0.0;
  double drift = 0.0;
  double beta_error = 0.0;
  double cold_junction = 0.0;
  double lag = 0.0;
  double stem_loss = 0.0;
  double self_heating = 0.0;
  double noise = 0.0;
  double resolution = 0.0;
  double lowest = 0.0;
  double highest = 0.0;
  double conversion_interval = 0.0;
};

/// What the file gives holds, the rest comes from the table at TemperatureSensor. Each property is drawn from a stream
/// of its own, so that to fix one in the file leaves the others as they were.
/// Throws InputError as check_sensor does.
TemperatureSpecimen draw_specimen(TemperatureSensor const& sensor, InstrumentChannel const& channel);

/// Draws nothing. Throws InputError for an unknown kind, class or mounting, for bits outside 9 to 12, for a range
/// upside down, and for a conversion interval that is not positive.
void check_sensor(TemperatureSensor const& sensor, std::string const& name);

/// Those properties that may be a matter of chance, by name.
std::map<std::string, double> chance_properties(TemperatureSpecimen const& specimen);

}  // namespace thermotwin::twin
