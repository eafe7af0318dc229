#include "twin/study/selection_row.h"

#include <map>
#include <set>
#include <string>
#include <vector>

#include "models/selection_variability.h"

namespace thermotwin::twin {

SelectionTruth selection_truth(StudiedWorld const& world, Combinations const& combinations) {
  std::set<int> counts;
  for (auto const& repetition : world.repetitions)
    for (std::size_t q = 0; q < repetition.fits; ++q)
      for (std::size_t s = 0; s < combinations.selections.size(); ++s)
        if (auto const& choice = repetition.trials[q].choices[s];
            combinations.selections[s].name != "all" && choice.refused.empty())
          counts.insert(int(choice.columns.size()));
  SelectionTruth truth(world.data);
  for (int const count : counts) truth.prepare(count);
  return truth;
}

SelectionFigures selection_row(StudiedWorld const& world, Combinations const& combinations, std::size_t selection,
                               SelectionTruth const& truth) {
  SelectionFigures result{world.description.name, combinations.selection_names[selection], {}, {}, {}};
  auto const& named = combinations.selections[selection];
  std::string refused;
  std::size_t refusals = 0;
  for (auto const& repetition : world.repetitions) {
    bool chose = true;
    std::map<std::string, std::vector<double>> values;
    std::vector<std::vector<Eigen::Index>> chosen;
    for (std::size_t q = 0; q < repetition.fits; ++q) {
      auto const& choice = repetition.trials[q].choices[selection];
      if (!choice.refused.empty()) {
        if (refused.empty()) refused = choice.refused;
        chose = false;
        continue;
      }
      if (result.remark.empty()) result.remark = choice.selection.remark;
      if (result.evidence.empty()) result.evidence = choice.selection.evidence;
      chosen.push_back(choice.columns);
      values["count"].push_back(double(choice.columns.size()));
      auto const quality = named.name == "all" ? std::nullopt : truth.quality(choice);
      if (!quality) continue;
      values["regret"].push_back(quality->regret);
      values["informative"].push_back(quality->score.informative);
      values["found"].push_back(quality->score.found);
      if (named.sensors.empty()) values["rank_correlation"].push_back(quality->score.rank_correlation);
    }
    for (auto const& [name, of_questions] : values) result.figures[name].push_back(interval(of_questions).mean);
    if (auto const share = models::switch_share(chosen)) result.figures["switches"].push_back(*share);
    refusals += chose ? 0 : 1;
  }
  if (refusals > 0) {
    result.remark = "refused: " + world.in_some(refused, refusals);
    result.figures.clear();
  }
  return result;
}

}  // namespace thermotwin::twin
