#include "twin/study/combinations.h"

#include <algorithm>
#include <set>

namespace thermotwin::twin {
namespace {

/// The number of an item, which is appended where it is new.
template <class Item>
std::size_t number_of(Item const& item, std::vector<Item>& known) {
  auto const place = std::size_t(std::find(known.begin(), known.end(), item) - known.begin());
  if (place == known.size()) known.push_back(item);
  return place;
}

}  // namespace

Combinations::Combinations(StudyDescription const& study) {
  for (auto const& selection : study.selections)
    for (auto const& model : study.models) {
      One one{number_of(selection, selection_names), {}, model};
      for (auto const& single : named_models(model)) one.models.push_back(number_of(single, models));
      all.push_back(std::move(one));
    }
  for (auto const& name : selection_names) selections.push_back(named_selection(name));
}

std::vector<std::size_t> Combinations::models_on(std::size_t selection) const {
  std::set<std::size_t> on;
  for (auto const& one : all)
    if (one.selection == selection) on.insert(one.models.begin(), one.models.end());
  return {on.begin(), on.end()};
}

}  // namespace thermotwin::twin
