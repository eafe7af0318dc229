#include "twin/diagnosis/channel_reading.h"

#include <cmath>

namespace thermotwin::twin {
namespace {

constexpr double tool_height = 1.0;     // where the air near the tool is taken [m]
constexpr double usual_floor = 293.15;  // where the course does not say [K]

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
  reading.height = reading.sensor ? reading.sensor->position.dot(machine.up) : tool_height;
  reading.floor_temperature = channel_index(course, "ambient.floor_temperature");
  reading.gradient = channel_index(course, "ambient.gradient");
  if (reading.displacement)
    for (auto const& term : reading.displacement->input_terms)
      reading.term_channels.push_back(channel_index(course, term.channel));
  return reading;
}

double value_of(std::vector<double> const& inputs, int channel, double otherwise) {
  return channel < 0 ? otherwise : inputs[std::size_t(channel)];
}

double air_at(ChannelReading const& reading, std::vector<double> const& inputs) {
  return value_of(inputs, reading.floor_temperature, usual_floor) +
         reading.height * value_of(inputs, reading.gradient, 0.0);
}

}  // namespace

double ChannelReading::before_lag(double of_nodes, std::vector<double> const& inputs,
                                  std::vector<double> const& at_start) const {
  if (sensor) {
    double const air = air_at(*this, inputs), body = sensor->weights.empty() ? air : of_nodes;
    return body - air_share * (body - air);
  }
  if (!displacement) return 0.0;
  double value = of_nodes;
  for (std::size_t t = 0; t < term_channels.size(); ++t) {
    auto const& term = displacement->input_terms[t];
    value += term.coefficient * (std::pow(value_of(inputs, term_channels[t], 0.0), term.power) -
                                 std::pow(value_of(at_start, term_channels[t], 0.0), term.power));
  }
  return value + per_air * (air_at(*this, inputs) - air_at(*this, at_start));
}

Eigen::VectorXd ChannelReading::shown(Eigen::VectorXd const& behind_lag, Eigen::VectorXd const& time) const {
  return (behind_lag.array() + offset + drift * time.array()).matrix();
}

std::vector<ChannelReading> readings_of(Machine const& machine, MeasuredRun const& run) {
  std::vector<ChannelReading> readings;
  for (auto const& channel : run.channels) readings.push_back(reading_of(machine, channel, *run.course));
  return readings;
}

int channel_index(thermal::Course const& course, std::string const& name) {
  auto const& channels = course.channels();
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i].name == name) return int(i);
  return -1;
}

}  // namespace thermotwin::twin
