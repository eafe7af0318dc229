#include "twin/diagnosis/channel_reading.h"

namespace thermotwin::twin {
namespace {

ChannelReading reading_of(Machine const& machine, MeasuredChannel const& channel, thermal::Course const& course) {
  ChannelReading reading;
  for (auto const& sensor : machine.sensors)
    if (!channel.displacement && sensor.description.name == channel.name) reading.sensor = &sensor;
  for (auto const& displacement : machine.linear_channels)
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
  reading.height = reading.sensor ? reading.sensor->position.dot(machine.up) : height_near_tool;
  reading.air = RoomAir(course);
  if (reading.displacement) reading.motion = InputMotion(reading.displacement->input_terms, course);
  return reading;
}

}  // namespace

double ChannelReading::before_lag(double of_nodes, std::vector<double> const& inputs,
                                  std::vector<double> const& at_start) const {
  double const around = air.at(height, inputs);
  if (sensor) {
    double const body = sensor->weights.empty() ? around : of_nodes;
    return body - air_share * (body - around);
  }
  if (!displacement) return 0.0;
  return of_nodes + motion(inputs, at_start) + per_air * (around - air.at(height, at_start));
}

Eigen::VectorXd ChannelReading::shown(Eigen::VectorXd const& behind_lag, Eigen::VectorXd const& time) const {
  return (behind_lag.array() + offset + drift * time.array()).matrix();
}

std::vector<ChannelReading> readings_of(Machine const& machine, MeasuredRun const& run) {
  std::vector<ChannelReading> readings;
  for (auto const& channel : run.channels) readings.push_back(reading_of(machine, channel, *run.course));
  return readings;
}

}  // namespace thermotwin::twin
