#include "twin/study/combinations.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <span>

#include "models/error_model.h"
#include "models/selection.h"
#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

/// The number of an item, which is appended where it is new.
template <class Item>
std::size_t number_of(Item const& item, std::vector<Item>& known) {
  auto const place = std::size_t(std::find(known.begin(), known.end(), item) - known.begin());
  if (place == known.size()) known.push_back(item);
  return place;
}

template <class Method>
std::vector<std::string> of_papers(std::span<Method const> methods) {
  std::vector<std::string> names;
  for (auto const& method : methods)
    if (method.source.find("methods.md") != std::string_view::npos) names.emplace_back(method.name);
  return names;
}

bool is_in(std::string const& name, std::vector<std::string> const& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::vector<std::string> selections_of_papers() { return of_papers(models::selection_methods()); }

std::vector<std::string> models_of_papers() { return of_papers(models::model_methods()); }

bool NamedCombination::needs_machine() const {
  return named_selection(selection).needs_machine() || need_machine(named_models(model));
}

bool NamedCombination::of_papers() const {
  return is_in(named_selection(selection).name, selections_of_papers()) && is_in(model, models_of_papers());
}

NamedCombination named_combination(std::string const& text) {
  std::string const between = " + ";
  auto const place = text.rfind(between);
  if (place == std::string::npos)
    throw thermal::InputError(
        fmt::format("'{}' is no combination; write \"selection + model\", for example \"all + twin observer\"", text));
  NamedCombination named{text.substr(0, place), text.substr(place + between.size())};
  static_cast<void>(named_selection(named.selection));
  static_cast<void>(named_models(named.model));
  return named;
}

std::vector<NamedCombination> named_combinations(StudyDescription const& study) {
  std::vector<NamedCombination> combinations;
  for (auto const& selection : study.selections)
    for (auto const& model : study.models) combinations.push_back({selection, model});
  for (auto const& text : study.also) combinations.push_back(named_combination(text));
  return combinations;
}

Combinations::Combinations(StudyDescription const& study) {
  for (auto const& named : named_combinations(study)) {
    One one{named, number_of(named.selection, selection_names), {}};
    for (auto const& single : named_models(named.model)) one.models.push_back(number_of(single, models));
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
