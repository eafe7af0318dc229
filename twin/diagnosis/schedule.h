#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/experiment.h"
#include "twin/diagnosis/binned_run.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// An experiment that somebody could make: a file of scenarios/catalogue, or the user's.
struct Schedule {
  std::filesystem::path file;
  scenarios::Experiment experiment;

  [[nodiscard]] std::string name() const { return file.stem().string(); }
  [[nodiscard]] double hours() const { return experiment.duration / 3600.0; }
};

[[nodiscard]] Schedule read_schedule(std::filesystem::path const& file);

/// The catalogue's schedules for telling effects apart, `separate_*.toml`, but for those that this machine cannot do.
/// Inputs of the machine's own, which they do not know, are held at their mean over the runs so far.
[[nodiscard]] std::vector<Schedule> separating_schedules(Machine const& machine, std::vector<BinnedRun> const& runs);

/// What the machine's channels would show of it, instruments included.
[[nodiscard]] MeasuredRun simulated_run(Machine const& machine, Schedule const& schedule);

}  // namespace thermotwin::twin
