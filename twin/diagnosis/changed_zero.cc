#include "twin/diagnosis/changed_zero.h"

#include <fmt/format.h>

namespace thermotwin::twin {

std::string ChangedZero::name(std::vector<BinnedRun> const& data) const {
  auto const& name = data[run].run->channels[channel].name;
  if (is_in_all_of(data[run])) return fmt::format("{} in run {}, beside the others", name, run + 1);
  return fmt::format("{} from {:.2f} h of run {} on", name, from / 3600.0, run + 1);
}

Eigen::VectorXd ChangedZero::share(BinnedRun const& data) const {
  Eigen::VectorXd share = Eigen::VectorXd::Zero(data.time.size());
  for (std::size_t s = 0; s < data.steps.size(); ++s) {
    auto const& step = data.steps[s];
    auto const& readings = data.readings[channel][s];
    for (double const after : readings.samples)
      if (step.begin + after >= from) share[step.row] += readings.share;
  }
  return share;
}

}  // namespace thermotwin::twin
