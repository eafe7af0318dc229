#include "twin/diagnosis/excitation.h"

#include <algorithm>
#include <cmath>
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
  auto const& channels = run.course->channels();
  auto const it = std::find_if(channels.begin(), channels.end(), [&](auto const& c) { return c.name == name; });
  if (it == channels.end()) return 0.0;
  std::vector<double> values(channels.size());
  double low = INFINITY, high = -INFINITY;
  for (double const t : run.time) {
    run.course->evaluate(t, values);
    double const value = values[std::size_t(it - channels.begin())];
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return high - low;
}

}  // namespace

bool is_excited(Hypothesis const& hypothesis, Value const& document, Machine const& machine,
                std::vector<BinnedRun> const& runs) {
  if (hypothesis.site != "machine") return true;
  auto const before = followed(machine);
  auto const after = followed(Machine::build(with_hypothesis(document, hypothesis, "trial", hypothesis.largest)));
  bool follows = false;
  for (auto const& name : after) {
    if (before.contains(name)) continue;
    follows = true;
    for (auto const& run : runs)
      if (change(*run.run, name) >= least_change) return true;
  }
  return !follows;
}

}  // namespace thermotwin::twin
