#include "twin/study/study_modes.h"

#include <algorithm>

#include "scenarios/course.h"
#include "twin/diagnosis/measured_run.h"
#include "twin/thermal_modes.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;

/// Those of `times` at which one of the parts' rows stands or, being a mean over `period`, lasts.
std::vector<double> within(std::vector<RunPart> const& parts, Eigen::VectorXd const& rows, double period,
                           std::vector<double> const& times) {
  double const slack = 1e-6;
  std::vector<double> chosen;
  for (double const time : times)
    if (std::any_of(parts.begin(), parts.end(), [&](RunPart const& part) {
          double const end = rows[part.first + part.count - 1] + (period > 0.0 ? period - slack : slack);
          return time > rows[part.first] - slack && time < end;
        }))
      chosen.push_back(time);
  return chosen;
}

OperatingState state_of(StudyWorld const& world, WorldData const& data, std::vector<RunPart> const& parts) {
  auto const& machine = *data.runs->machine;
  auto const run = parts.front().run;
  auto const& rows = data.train.front()[run].seen.time;
  if (auto const& measured = data.runs->measured[run]) {
    auto const first = first_reading(*measured);
    std::vector<double> times;
    for (Index i = first; i < measured->time.size(); ++i) times.push_back(measured->time[i] - measured->time[first]);
    auto chosen = within(parts, rows, world.sampling.value_or(0.0), times);
    for (auto& time : chosen) time += measured->time[first];
    return mean_state(machine, *measured->course, chosen);
  }
  auto const& experiment = *data.runs->experiments[run];
  return mean_state(machine, scenarios::ExperimentCourse(experiment, machine.limits),
                    within(parts, rows, 0.0, scenarios::sample_times(experiment)), experiment.ambient.mean);
}

}  // namespace

std::vector<RunPart> of_first_run(std::vector<RunPart> const& parts) {
  std::vector<RunPart> first;
  for (auto const& part : parts)
    if (part.run == parts.front().run) first.push_back(part);
  return first;
}

ModeShapes mode_shapes(StudyWorld const& world, WorldData const& data, std::vector<RunPart> const& parts) {
  if (!data.runs->machine) return {{}, std::string(no_machine)};
  auto const& machine = *data.runs->machine;
  std::vector<Index> rows;
  for (auto const& name : data.sensors)
    for (std::size_t s = 0; s < machine.sensors.size(); ++s)
      if (machine.sensors[s].description.name == name) rows.push_back(Index(s));
  try {
    int const count = std::min(machine.network().nodes(), int(machine.sensors.size()));
    return {thermal_modes(machine, state_of(world, data, parts), count).sensors(rows, Eigen::all), ""};
  } catch (thermal::InputError const& error) {
    return {{}, error.what()};
  }
}

}  // namespace thermotwin::twin
