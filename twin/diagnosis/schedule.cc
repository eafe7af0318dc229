#include "twin/diagnosis/schedule.h"

#include <algorithm>
#include <fmt/format.h>
#include <span>

#include "scenarios/course.h"
#include "thermal/error.h"
#include "twin/experiment_file.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

/// Over the rows of all runs.
double mean_of(std::string const& channel, std::vector<BinnedRun> const& runs) {
  double sum = 0.0;
  Eigen::Index rows = 0;
  for (auto const& run : runs) {
    auto const& course = *run.run->course;
    std::vector<double> values(course.channels().size());
    auto const place = std::size_t(course.index_of(channel));
    for (double const time : run.time) {
      course.evaluate(time, values);
      sum += values[place];
    }
    rows += run.time.size();
  }
  return sum / double(rows);
}

/// Inputs that the machine asks for, and the schedule does not give.
void hold_others(Schedule& schedule, Machine const& machine, std::vector<BinnedRun> const& runs) {
  scenarios::ExperimentCourse const course(schedule.experiment, machine.limits);
  if (runs.empty()) return;
  auto const& names = machine.network().channel_names();
  auto const& known = runs.front().run->course->channels();
  for (auto const& name : std::span(names).first(std::size_t(machine.network().external_channels()))) {
    if (course.index_of(name) >= 0) continue;
    auto channel = known[std::size_t(runs.front().run->course->index_of(name))];
    schedule.experiment.driven.push_back({std::move(channel), scenarios::Signal(mean_of(name, runs))});
  }
}

/// A machine without spindle and axes has nothing that a schedule of the catalogue could move.
bool can_do(Machine const& machine, Schedule& schedule, std::vector<BinnedRun> const& runs) {
  if (machine.limits.max_spindle_speed <= 0.0 && machine.limits.axes.empty()) return false;
  try {
    hold_others(schedule, machine, runs);
    return true;
  } catch (thermal::InputError const&) {
    return false;
  }
}

}  // namespace

Schedule read_schedule(std::filesystem::path const& file) { return {file, read_experiment(read_toml(file), file)}; }

std::vector<Schedule> separating_schedules(Machine const& machine, std::vector<BinnedRun> const& runs) {
  std::vector<std::filesystem::path> files;
  for (auto const& entry : std::filesystem::directory_iterator(experiment_file("separate_steps").parent_path()))
    if (entry.path().filename().string().starts_with("separate_")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Schedule> schedules;
  for (auto const& file : files)
    if (auto schedule = read_schedule(file); can_do(machine, schedule, runs)) schedules.push_back(std::move(schedule));
  return schedules;
}

MeasuredRun simulated_run(Machine const& machine, Schedule const& schedule) {
  RunOptions options;
  options.integration.relative_tolerance = options.integration.absolute_tolerance = 1e-5;
  try {
    return measured_run(run(machine, schedule.experiment, options).dataset, machine, schedule.name());
  } catch (thermal::InputError const& error) {
    throw thermal::InputError(fmt::format("{}: {}", schedule.file.string(), error.what()));
  }
}

}  // namespace thermotwin::twin
