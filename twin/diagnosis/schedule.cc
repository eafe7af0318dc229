#include "twin/diagnosis/schedule.h"

#include <algorithm>

#include "scenarios/course.h"
#include "thermal/error.h"
#include "twin/experiment_file.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

/// A machine without spindle and axes has switches of its own, which no schedule of the catalogue knows.
bool can_do(Machine const& machine, Schedule const& schedule) {
  if (machine.limits.max_spindle_speed <= 0.0 && machine.limits.axes.empty()) return false;
  try {
    scenarios::ExperimentCourse const course(schedule.experiment, machine.limits);
    return true;
  } catch (thermal::InputError const&) {
    return false;
  }
}

}  // namespace

Schedule read_schedule(std::filesystem::path const& file) { return {file, read_experiment(read_toml(file), file)}; }

std::vector<Schedule> separating_schedules(Machine const& machine) {
  std::vector<std::filesystem::path> files;
  for (auto const& entry : std::filesystem::directory_iterator(experiment_file("separate_steps").parent_path()))
    if (entry.path().filename().string().starts_with("separate_")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Schedule> schedules;
  for (auto const& file : files)
    if (auto schedule = read_schedule(file); can_do(machine, schedule)) schedules.push_back(std::move(schedule));
  return schedules;
}

MeasuredRun simulated_run(Machine const& machine, Schedule const& schedule) {
  RunOptions options;
  options.integration.relative_tolerance = options.integration.absolute_tolerance = 1e-5;
  return measured_run(run(machine, schedule.experiment, options).dataset, machine, schedule.name());
}

}  // namespace thermotwin::twin
