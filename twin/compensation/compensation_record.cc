#include "twin/compensation/compensation_record.h"

#include <exception>
#include <fmt/format.h>
#include <limits>
#include <utility>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

output::Dataset head_of(std::vector<ModelInput> const& inputs, std::string const& axis) {
  output::Dataset head;
  head.title = "Compensation of " + axis;
  for (auto const& input : inputs)
    (input.sensor ? head.readings : head.inputs).push_back({input.name, input.unit, input.name, {}});
  head.inputs.push_back({"support", "1", "what the offset rests on: 1 good, 2 held, 3 fading, 4 off", {}});
  head.displacements = {{"error", "um", "what the model tells", {}}, {"offset", "um", "origin shift of " + axis, {}}};
  return head;
}

std::filesystem::path const& new_record(std::filesystem::path const& path) {
  for (auto const& there : {path, output::partial_of(path)})
    if (std::filesystem::exists(there))
      throw thermal::InputError(fmt::format(
          "'{}' is there already, and what was measured cannot be made again; move it, or name another record",
          there.string()));
  return path;
}

}  // namespace

CompensationRecord::CompensationRecord(std::filesystem::path const& path, std::vector<ModelInput> const& inputs,
                                       std::string const& axis, std::function<void(std::string const&)> say,
                                       std::chrono::duration<double> between_checkpoints)
    : writer_(new_record(path), head_of(inputs, axis), between_checkpoints), say_(std::move(say)) {}

/// Readings that are not believed are missing.
output::Row CompensationRecord::row_of(Decision const& decision, Compensator const& compensator) const {
  auto const& inputs = compensator.inputs();
  std::vector<double> sensors, others;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    (inputs[i].sensor ? sensors : others)
        .push_back(compensator.fault(i, decision.time) == SensorFault::none ? compensator.value(i)
                                                                            : std::numeric_limits<double>::quiet_NaN());
  others.push_back(double(decision.support));
  output::Row row;
  row.time_s = decision.time - first_;
  row.readings = Eigen::Map<Eigen::VectorXd>(sensors.data(), Eigen::Index(sensors.size()));
  row.inputs = Eigen::Map<Eigen::VectorXd>(others.data(), Eigen::Index(others.size()));
  row.displacements = Eigen::Vector2d(decision.error, decision.offset);
  return row;
}

void CompensationRecord::add(Decision const& decision, Compensator const& compensator) {
  if (decision.support == Support::waiting) return;
  if (failed_ || (rows_ > 0 && decision.time <= last_)) return;
  if (rows_ == 0) first_ = decision.time;
  last_ = decision.time;
  ++rows_;
  try {
    writer_.append(row_of(decision, compensator));
  } catch (std::exception const& error) {
    failed_ = true;
    say_(fmt::format("{}; compensation goes on without a record", error.what()));
  }
}

void CompensationRecord::finish() {
  if (rows_ > 0 && !failed_) (void)writer_.finish({{"start_s", fmt::format("{}", first_)}});
}

}  // namespace thermotwin::twin
