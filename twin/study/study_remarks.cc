#include "twin/study/study_remarks.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

#include "twin/study/study_twin.h"

namespace thermotwin::twin {
namespace {

/// Whether an observer was fitted for a combination of the world.
bool has_observer(StudiedWorld const& world, Combinations const& combinations) {
  for (auto const& repetition : world.repetitions)
    for (auto const& trial : repetition.trials)
      for (std::size_t m = 0; m < combinations.models.size(); ++m)
        if (combinations.models[m].observes() &&
            std::any_of(trial.fits[m].begin(), trial.fits[m].end(),
                        [](auto const& fit) { return fit.second.refused.empty(); }))
          return true;
  return false;
}

/// Of the world's, those whose questions say so.
std::size_t repetitions_remarking(StudiedWorld const& world, std::string const& remark) {
  return std::size_t(std::count_if(world.repetitions.begin(), world.repetitions.end(), [&](auto const& repetition) {
    auto const& remarks = repetition.remarks;
    return std::find(remarks.begin(), remarks.end(), remark) != remarks.end();
  }));
}

}  // namespace

std::vector<std::string> study_remarks(std::vector<StudiedWorld> const& worlds, Combinations const& combinations) {
  std::vector<std::pair<std::string, std::vector<std::string>>> told;
  auto const tell = [&](std::string const& remark, StudiedWorld const& world) {
    auto const& name = world.description.name;
    auto it = std::find_if(told.begin(), told.end(), [&](auto const& one) { return one.first == remark; });
    if (it == told.end()) it = told.insert(it, {remark, {}});
    if (it->second.empty() || it->second.back() != name) it->second.push_back(name);
  };
  for (auto const& world : worlds) {
    for (auto const& remark : world.data.remarks) tell(remark, world);
    if (!has_observer(world, combinations)) continue;
    for (auto const& remark : observer_remarks(world.description, *world.data.runs)) tell(remark, world);
  }
  for (auto const& world : worlds)
    for (auto const& repetition : world.repetitions)
      for (auto const& remark : repetition.remarks)
        tell(world.in_some(remark, repetitions_remarking(world, remark)), world);
  std::vector<std::string> texts;
  for (auto const& [remark, names] : told) texts.push_back(fmt::format("{}: {}", fmt::join(names, ", "), remark));
  return texts;
}

}  // namespace thermotwin::twin
