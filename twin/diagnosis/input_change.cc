#include "twin/diagnosis/input_change.h"

#include <algorithm>
#include <cmath>

namespace thermotwin::twin {

std::vector<InputChange> changes_of(scenarios::SampledInput const& input, scenarios::Signal const& signal) {
  auto const samples = scenarios::recorded_times(input);
  auto const jumps = signal.jumps();
  if (2 * jumps.size() > samples.size()) return {};
  double const largest = signal.largest_magnitude();
  std::vector<InputChange> changes;
  std::vector<std::size_t> rows;
  for (double const time : jumps) {
    auto const shown = std::lower_bound(samples.begin(), samples.end(), time);
    if (shown == samples.begin() || shown == samples.end()) continue;
    rows.push_back(std::size_t(shown - samples.begin()));
    double const before = *(shown - 1);
    changes.push_back({time, time - before, std::abs(signal.at(time) - signal.at(before)) / largest});
  }
  return scenarios::are_written_at_changes(samples, rows) ? std::vector<InputChange>{} : changes;
}

std::vector<InputChange> merged(std::vector<InputChange> changes, std::size_t most) {
  auto const sooner = [](InputChange const& a, InputChange const& b) { return a.time < b.time; };
  std::stable_sort(changes.begin(), changes.end(), sooner);
  std::vector<InputChange> result;
  for (auto const& change : changes) {
    if (result.empty() || result.back().time != change.time) {
      result.push_back(change);
      continue;
    }
    result.back().earlier = std::max(result.back().earlier, change.earlier);
    result.back().size += change.size;
  }
  if (result.size() <= most) return result;
  std::stable_sort(result.begin(), result.end(),
                   [](auto const& a, auto const& b) { return a.size * a.earlier > b.size * b.earlier; });
  result.resize(most);
  std::sort(result.begin(), result.end(), sooner);
  return result;
}

}  // namespace thermotwin::twin
