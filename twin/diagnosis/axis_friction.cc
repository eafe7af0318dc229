#include "twin/diagnosis/axis_friction.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "twin/description.h"
#include "twin/diagnosis/expected_noise.h"
#include "twin/diagnosis/start.h"
#include "twin/file/tables.h"

namespace thermotwin::twin {
namespace {

std::string path_of_friction(std::string const& axis) { return "axis." + axis + ".friction_at"; }

bool rests_at_times(std::string const& axis, BinnedRun const& run) {
  auto const mean = run.run->input(axis + ".speed", run.time),
             moving = run.run->input(axis + ".moving_speed", run.time);
  return mean.size() > 0 && (moving.array() > 1.001 * mean.array().abs()).any();
}

double evidence_against(Value const& document, std::vector<BinnedRun> const& runs, FitWatch const& watch) {
  return best_fit(expected_estimation(document, runs).with_form_of_file().watched(watch)).evidence;
}

}  // namespace

std::vector<ChangedValue> FrictionWhileMoving::changes() const {
  std::vector<ChangedValue> changes;
  for (auto const& axis : axes)
    changes.push_back({path_of_friction(axis), "moving speed", fmt::format("2 ln {:.0f}", gain)});
  return changes;
}

std::string FrictionWhileMoving::remark() const {
  return fmt::format(
      "the friction of axis {} is that of its speed while it moves, not of its mean speed, by 2 ln {:.0f}: "
      "the file's 'friction_at' should say so",
      fmt::join(axes, ", "), gain);
}

std::optional<FrictionWhileMoving> friction_while_moving(Value const& machine, std::vector<BinnedRun> const& runs,
                                                         double threshold, FitWatch const& watch) {
  FrictionWhileMoving other{{}, 0.0, machine};
  Tables tables(machine);
  for (auto const& [axis, table] : tables.read<AxisDescription>("axis")) {
    if (axis.friction_at != "mean speed") continue;
    if (std::none_of(runs.begin(), runs.end(),
                     [&, &name = axis.name](auto const& run) { return rests_at_times(name, run); }))
      continue;
    other.axes.push_back(axis.name);
    set_parameter(other.document, path_of_friction(axis.name), "moving speed");
  }
  if (other.axes.empty()) return std::nullopt;
  other.gain = evidence_against(machine, runs, watch) - evidence_against(other.document, runs, watch);
  if (other.gain < threshold) return std::nullopt;
  return other;
}

}  // namespace thermotwin::twin
