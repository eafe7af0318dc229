#include "twin/diagnosis/excitation.h"

#include <algorithm>
#include <set>

namespace thermotwin::twin {
namespace {

constexpr double least_change = 0.25;

/// Input channels that the machine's boundaries follow.
std::set<std::string> followed(Machine const& machine) {
  auto const& network = machine.network();
  std::set<std::string> names;
  for (auto const& boundary : network.boundaries())
    for (auto const& term : boundary.terms) names.insert(network.channel_names()[std::size_t(term.channel)]);
  return names;
}

double change(MeasuredRun const& run, std::string const& name) {
  Eigen::VectorXd const values = run.input(name, run.time);
  return values.size() == 0 ? 0.0 : values.maxCoeff() - values.minCoeff();
}

}  // namespace

bool is_excited(Hypothesis const& hypothesis, Value const& document, Machine const& machine,
                std::vector<BinnedRun> const& runs) {
  auto const changes = [&](std::string const& name) {
    return std::any_of(runs.begin(), runs.end(),
                       [&](BinnedRun const& run) { return change(*run.run, name) >= least_change; });
  };
  if (auto const& channel = hypothesis.trial->if_changes; !channel.empty()) return changes(channel);
  if (hypothesis.site != "machine") return true;
  auto const before = followed(machine);
  auto const after = followed(Machine::build(with_hypothesis(document, hypothesis, "trial", hypothesis.largest)));
  bool follows = false;
  for (auto const& name : after) {
    if (before.contains(name)) continue;
    follows = true;
    if (changes(name)) return true;
  }
  return !follows;
}

}  // namespace thermotwin::twin
