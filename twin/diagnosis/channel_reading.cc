#include "twin/diagnosis/channel_reading.h"

namespace thermotwin::twin {

ChannelReading reading_of(Machine const& machine, MeasuredChannel const& channel) {
  ChannelReading reading;
  for (auto const& sensor : machine.sensors)
    if (!channel.displacement && sensor.description.name == channel.name) reading.sensor = &sensor;
  for (auto const& displacement : machine.displacements)
    if (channel.displacement && displacement.name == channel.name) reading.displacement = &displacement;
  if (reading.sensor) {
    auto const& given = reading.sensor->description;
    reading.lag = given.lag.value_or(0.0);
    reading.air_share = given.stem_loss.value_or(0.0);
    reading.offset = given.offset.value_or(0.0);
    reading.drift = given.drift.value_or(0.0);
  }
  for (auto const& term : machine.reading_terms) {
    if (term.channel != channel.name) continue;
    reading.lag += term.lag;
    reading.air_share += term.air_share;
    reading.drift += term.drift;
    reading.per_air += term.per_air;
  }
  return reading;
}

}  // namespace thermotwin::twin
