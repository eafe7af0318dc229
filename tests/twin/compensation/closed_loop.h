#pragma once

#include <functional>
#include <map>
#include <string>

#include "twin/compensation/compensation_loop.h"
#include "twin/compensation/virtual_machine.h"
#include "twin/experiment_file.h"
#include "twin/machine.h"
#include "twin/run.h"

namespace thermotwin::twin::tests {

/// A run of a machine of the tree with some of its numbers changed.
inline output::Dataset simulated(std::string const& experiment, double sampling,
                                 std::map<std::string, std::string> const& changes = {},
                                 std::string const& machine = "g200") {
  auto const file = experiment_file(experiment);
  auto programme = read_experiment(read_toml(file), file);
  programme.sampling = sampling;
  auto document = read_toml(machine_file(machine));
  for (auto const& [path, value] : changes) set_parameter(document, path, value);
  return run(Machine::build(document), programme, {}).dataset;
}

/// A model of E_X of these sensors, fitted to a run.
inline models::ErrorModel fitted(output::Dataset const& data, std::vector<std::string> const& sensors,
                                 std::string const& method = "linear") {
  models::Batch batch{"training", data.time_s, sensors, sensors, {}, {}};
  batch.temperature_rise.resize(data.time_s.size(), Eigen::Index(sensors.size()));
  for (std::size_t j = 0; j < sensors.size(); ++j)
    for (auto const& channel : data.readings)
      if (channel.name == sensors[j])
        batch.temperature_rise.col(Eigen::Index(j)) = channel.values.array() - channel.values[0];
  for (auto const& channel : data.displacements)
    if (channel.name == "E_X") batch.error = channel.values;
  return models::model_method(method).fit(std::vector{batch}, {});
}

inline std::vector<std::string> const key_sensors{"T2", "T4", "T10", "T12", "T15"};  ///< of paper 003

/// The loop without a broker: what the machine tells reaches the compensation after a millisecond each, and its offset
/// the machine at once. `tamper` may change a payload, or empty it: then it does not arrive.
using Tamper = std::function<void(double time, std::string const& topic, std::string& payload)>;
inline PlayedRun close_loop(CompensationLoop& loop, VirtualMachine machine, Tamper const& tamper = {},
                            std::function<void(Decision const&)> const& watch = {}) {
  for (std::size_t row = 0; row < machine.rows(); ++row) {
    double wall = machine.time(row);
    auto const hand_over = [&](std::optional<Decision> const& decision) {
      if (!decision) return;
      if (watch) watch(*decision);
      machine.take(payload_of({"X", decision->offset, "um", decision->time, "good"}));
    };
    for (auto& [topic, payload] : machine.begin(row)) {
      wall += 1e-3;
      if (tamper) tamper(machine.time(row), topic, payload);
      if (!payload.empty()) hand_over(loop.take(topic, payload, wall));
    }
    hand_over(loop.idle(wall + 0.5));
  }
  return machine.played();
}

}  // namespace thermotwin::twin::tests
