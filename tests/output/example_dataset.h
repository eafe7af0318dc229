#pragma once

#include <cmath>
#include <limits>

#include "output/dataset.h"

namespace thermotwin::tests {

inline output::Channel example_channel(std::string const& name, std::string const& unit, Eigen::Index rows,
                                       double scale) {
  output::Channel channel{name, unit, "example of " + name, Eigen::VectorXd(rows)};
  for (Eigen::Index i = 0; i < rows; ++i)
    channel.values[i] = scale * std::sin(0.1 * static_cast<double>(i)) + 1.0 / static_cast<double>(3 + i);
  return channel;
}

inline output::Positioning example_positioning(double scale) {
  Eigen::VectorXd const position = Eigen::VectorXd::LinSpaced(3, 0.0, 400.0);
  Eigen::VectorXd const time = Eigen::VectorXd::LinSpaced(2, 0.0, 900.0);
  Eigen::MatrixXd const forward = scale * (time.array() + 1.0).matrix() * position.transpose();
  return {"z", position, time, forward, forward.array() + 0.5};
}

/// A simulated run with something in every place; reading T2 misses its second sample.
inline output::Dataset example_dataset(Eigen::Index rows = 50) {
  output::Dataset dataset;
  dataset.title = "warm-up at 4000 rpm, 20 °C";
  dataset.time_s = Eigen::VectorXd::LinSpaced(rows, 0.0, 10.0 * static_cast<double>(rows - 1));
  dataset.inputs = {example_channel("spindle.speed", "rpm", rows, 4000.0),
                    example_channel("ambient.temperature", "degC", rows, 20.0)};
  dataset.readings = {example_channel("T2", "degC", rows, 25.0), example_channel("T1", "degC", rows, 26.0),
                      example_channel("T10", "degC", rows, 27.0)};
  if (rows > 1) dataset.readings[0].values[1] = std::numeric_limits<double>::quiet_NaN();
  dataset.displacements = {example_channel("E_Z", "um", rows, 12.0), example_channel("A", "urad", rows, 3.0)};
  dataset.positioning = {example_positioning(1e-3)};
  dataset.truth_readings = {example_channel("T2", "degC", rows, 25.5)};
  dataset.truth_displacements = {example_channel("E_Z", "um", rows, 12.5)};
  dataset.truth_positioning = {example_positioning(2e-3)};
  dataset.heat = {example_channel("bearing.front", "W", rows, 120.0)};
  dataset.node_names = {"bed", "Säule/oben", "spindle[0]"};
  dataset.node_temperatures = Eigen::MatrixXf::Random(rows, 3);
  dataset.provenance = {{"version", "0.1.0"},
                        {"seed", "7"},
                        {"empty", ""},
                        {"machine", std::string(59'000, 'm')},
                        {"experiment", std::string(200'000, 'e')}};
  return dataset;
}

}  // namespace thermotwin::tests
