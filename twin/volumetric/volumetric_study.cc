#include "twin/volumetric/volumetric_study.h"

#include <fmt/format.h>
#include <utility>

#include "thermal/error.h"
#include "thermal/units.h"

namespace thermotwin::twin {
namespace {

void check_resolution(double resolution) {
  if (resolution >= 0.0) return;
  throw thermal::InputError(fmt::format("the controller's resolution is {}; it must be positive, or 0 um for none",
                                        thermal::format_quantity(resolution, thermal::dimension::length)));
}

PoseFunction pose_of(VolumetricMachine const& machine, GeometricErrors errors) {
  return [model = machine.model(std::move(errors))](Eigen::Vector3d const& q) { return model.pose(q); };
}

VolumeGrid grid_for(VolumetricMachine const& machine) {
  int const points = machine.description.measurement.steps + 1;
  return {machine.workspace, {points, points, points}};
}

ErrorField field_of(PoseFunction const& pose, VolumeGrid const& grid) {
  return without_rigid_motion(sample(error_of(pose, grid.workspace.from), grid.positions()));
}

Drift drift_at(VolumetricStudy const& study, GeometricErrors const& warm, ErrorField const& at_measurement,
               Eigen::Vector3d const& tool, double time) {
  auto const pose = pose_of(study.machine, warm);
  auto const& grid = study.table.grid;
  auto const error = [&](Eigen::Vector3d const& q) -> Eigen::Vector3d { return pose(q).translation() - q - tool; };
  ErrorField moved = sample(error, grid.positions());
  moved.errors -= at_measurement.errors;
  auto const functions = nine_functions_of(pose, grid.workspace, 1);
  Drift drift{time,
              moved.largest(),
              field_of(pose, grid).largest(),
              field_of(compensated(pose, study.table), grid).largest(),
              squareness_of(functions),
              {}};
  for (int axis = 0; axis < 3; ++axis) drift.linear_totals[axis] = functions.values[std::size_t(axis)](axis, 1);
  return drift;
}

/// At nine instants spread over the run, its first and last among them.
std::vector<Drift> drift_over(VolumetricStudy const& study, output::Dataset const& run, GeometricErrors const& then) {
  constexpr int instants = 9;
  auto const pose = pose_of(study.machine, then);
  Eigen::Vector3d const& tool = study.machine.description.tool_offset;
  auto const error = [&](Eigen::Vector3d const& q) -> Eigen::Vector3d { return pose(q).translation() - q - tool; };
  auto const at_measurement = sample(error, study.table.grid.positions());
  std::vector<Drift> drift;
  for (int i = 0; i < instants; ++i) {
    auto const row = (run.time_s.size() - 1) * i / (instants - 1);
    double const time = run.time_s[row];
    drift.push_back(drift_at(study, warmed(study.machine, run, time), at_measurement, tool, time));
  }
  return drift;
}

std::vector<std::string> remarks_of(VolumetricStudy const& study, bool plain) {
  auto remarks = limits(study.plain.closure);
  if (plain && !remarks.empty())
    remarks.emplace_back("compensated by the plain identification nevertheless, as asked for");
  if (study.joint.rank < 14)
    remarks.push_back(fmt::format("the joint identification has rank {} of 14", study.joint.rank));
  double const shown = study.verification.after.largest_diagonal(), real = study.verification.after.largest;
  if (real > 2.0 * shown)
    remarks.push_back(
        fmt::format("after compensation the volume has {:.1f} times the error that the diagonals show", real / shown));
  if (study.verification.misleading())
    remarks.emplace_back("the diagonals got better and the volume worse: this table must not be used");
  return remarks;
}

}  // namespace

VolumetricStudy study_volume(VolumetricMachine const& machine, VolumetricOptions const& options) {
  check_resolution(options.resolution);
  auto const& how = machine.description.measurement;
  auto const state = options.run ? warmed(machine, *options.run, options.measured_at) : machine.cold;
  auto const pose = pose_of(machine, state);
  auto const grid = grid_for(machine);
  VolumetricStudy study;
  study.machine = machine;
  study.measured = measure_diagonals(pose, machine.workspace, machine.laser, how, options.seed);
  study.linear_totals = measure_linear_totals(pose, machine.workspace, how.linear_noise, options.seed);
  study.plain = identify_plain(study.measured);
  study.joint = identify_jointly(study.measured, study.linear_totals, how.linear_noise);
  study.truth = nine_functions_of(pose, machine.workspace, how.steps);
  NineFunctions const& found = options.plain ? study.plain.functions : study.joint.functions;
  auto const truth = error_of(pose, machine.workspace.from);
  for (auto const& method : prediction_methods()) {
    auto prediction = method.predict(found, options.seed);
    auto const score_of_it = score(prediction, truth, grid);
    study.predictions.push_back({std::move(prediction), score_of_it});
  }
  study.chosen = prediction_method(options.method).predict(found, options.seed);
  study.table = compensation_table(study.chosen.functions, grid, options.resolution);
  auto const better = compensated(pose, study.table);
  auto const again = measure_diagonals(better, machine.workspace, machine.laser, how, options.seed + 1);
  VolumeGrid const fine{machine.workspace, {21, 21, 21}};
  study.verification = {state_of(pose, study.measured, fine), state_of(better, again, fine)};
  study.before = field_of(pose, grid);
  study.after = field_of(better, grid);
  if (options.run) study.drift = drift_over(study, *options.run, state);
  study.remarks = remarks_of(study, options.plain);
  return study;
}

}  // namespace thermotwin::twin
