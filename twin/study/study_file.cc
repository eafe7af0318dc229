#include "twin/study/study_file.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <span>
#include <stdexcept>

#include "models/error_model.h"
#include "models/selection.h"
#include "thermal/nearest_name.h"
#include "twin/file/document.h"
#include "twin/file/shipped_file.h"
#include "twin/file/tables.h"
#include "twin/file/value.h"
#include "twin/file_kind.h"
#include "twin/study/combinations.h"
#include "twin/study/figure.h"

namespace thermotwin::twin {
namespace {

/// Each item of a list through `check`, once; a complaint gets the item's place.
template <class Check>
void check_items(Value const& table, std::string const& key, std::vector<std::string> const& items, Check check) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < items.size(); ++i) {
    auto const where = where_of_item(table, key, i);
    try {
      check(items[i]);
    } catch (std::invalid_argument const& error) {
      throw FileError(where, error.what());
    } catch (thermal::InputError const& error) {
      throw FileError(where, error.what());
    }
    if (!seen.insert(items[i]).second) throw FileError(where, fmt::format("'{}' is given twice", items[i]));
  }
  if (items.empty()) throw FileError(where_of_item(table, key, 0), fmt::format("'{}' names none", key));
}

void check_world(Value const& table, StudyWorld const& world) {
  check_items(table, "train", world.train, [](auto const&) {});
  if (!world.sensors.empty()) check_items(table, "sensors", world.sensors, [](auto const&) {});
  for (auto const* key : {"set", "add"})
    if (world.machine.empty() && table.find(key))
      throw FileError(where_of(table, key), fmt::format("'{}' changes a machine; give 'machine', too", key));
  if (world.split && (world.train.size() != 1 || !world.test.empty()))
    throw FileError(where_of(table, "split"),
                    fmt::format("'split' cuts one run; here are {} in 'train' and {} in 'test'", world.train.size(),
                                world.test.size()));
  if (world.split && !(*world.split > 0.0))
    throw FileError(where_of(table, "split"), "'split' is 0 s; a time after the first reading is due");
  if (world.fit == "each" && (world.train.size() < 3 || world.test.size() == 1))
    throw FileError(
        where_of(table, "fit"),
        fmt::format("'fit' is each: at least three runs to train on, and none or at least two to test on, are due; "
                    "here are {} and {}",
                    world.train.size(), world.test.size()));
  if (world.fit == "together" && world.test.empty() && !world.split)
    throw FileError(table.where,
                    fmt::format("the world '{}' has nothing to test on; give 'test' or 'split'", world.name));
  for (auto const& name : world.test)
    if (std::find(world.train.begin(), world.train.end(), name) != world.train.end())
      throw FileError(where_of(table, "test"), fmt::format("'{}' is in 'train', too", name));
  if (world.sampling && !(*world.sampling > 0.0))
    throw FileError(where_of(table, "sampling"), "'sampling' is 0 s; an interval of more than 0 is due");
  if (!world.instants.empty() && !world.slope())
    throw FileError(where_of_item(table, "instant", 0),
                    fmt::format("an 'instant' judges the error over an axis, but 'error' is '{}'; give a slope, for "
                                "example \"slope z\"",
                                world.error));
  if (!world.instants.empty() && world.fit == "each")
    throw FileError(where_of_item(table, "instant", 0),
                    "an 'instant' is judged by the one model of all of 'train', but 'fit' is each; give fit = "
                    "\"together\", or no 'instant'");
  std::vector<std::string> runs = world.train;
  runs.insert(runs.end(), world.test.begin(), world.test.end());
  for (std::size_t i = 0; i < world.instants.size(); ++i)
    if (std::find(runs.begin(), runs.end(), world.instants[i].experiment) == runs.end())
      throw FileError(where_of_item(table, "instant", i),
                      fmt::format("no run '{}' in this world; {}", world.instants[i].experiment,
                                  thermal::did_you_mean(world.instants[i].experiment, runs)));
}

void check_combination(Value const& table, std::string const& key, std::string const& name,
                       std::vector<std::string> const& known) {
  if (!name.empty() && std::find(known.begin(), known.end(), name) == known.end())
    throw FileError(where_of(table, key),
                    fmt::format("the study has no combination '{}'; {}", name, thermal::did_you_mean(name, known)));
}

/// What is compared, and by which of the keys.
void check_comparison(Value const& table, StudyClaim const& claim) {
  if (claim.than.empty() == !claim.at_most)
    throw FileError(table.where, "a claim is either less 'than' another combination or 'at_most' a number");
  if (claim.improvement && claim.than.empty())
    throw FileError(where_of(table, "improvement"), "an 'improvement' is over another combination; give 'than'");
  if (claim.tolerance && (claim.than.empty() || claim.improvement))
    throw FileError(where_of(table, "tolerance"),
                    "a 'tolerance' says no worse than another combination; give 'than', and no 'improvement'");
  if (claim.share && (claim.than.empty() || claim.improvement || claim.tolerance))
    throw FileError(where_of(table, "share"),
                    "a 'share' is of another combination; give 'than', and no 'improvement' or 'tolerance'");
}

/// Where the default of a claim is the first world.
StudyWorld const& world_of(StudyClaim const& claim, StudyDescription const& study) {
  auto const named = [&](StudyWorld const& world) { return world.name == claim.world; };
  auto const world = std::find_if(study.worlds.begin(), study.worlds.end(), named);
  return world == study.worlds.end() ? study.worlds.front() : *world;
}

/// A world that a claim looks at and that names no machine; null: there is none.
StudyWorld const* world_without_machine(StudyClaim const& claim, StudyDescription const& study) {
  for (auto const& world : study.worlds)
    if (world.machine.empty() && (claim.world == mean_of_worlds || &world == &world_of(claim, study))) return &world;
  return nullptr;
}

/// What is refused in each row that a claim looks at, or stands in none, can be compared with nothing.
void check_rows(Value const& table, StudyClaim const& claim, StudyDescription const& study) {
  auto const* bare = world_without_machine(claim, study);
  bool papers = false;
  for (auto const& combination : named_combinations(study)) {
    if (!bare || !combination.needs_machine()) {
      papers = papers || combination.of_papers();
      continue;
    }
    for (auto const& [key, name] : {std::pair{"combination", claim.combination}, {"than", claim.than}})
      if (name == combination.name())
        throw FileError(where_of(table, key),
                        fmt::format("'{}' needs a machine, and the world '{}' names none", name, bare->name));
  }
  if (claim.than == best_of_papers && !papers)
    throw FileError(where_of(table, "than"),
                    fmt::format("'{}' is of none: the study has no combination of a selection of the papers{} ({}) and "
                                "a model of theirs ({})",
                                best_of_papers, bare ? " that needs no machine" : "",
                                fmt::join(selections_of_papers(), ", "), fmt::join(models_of_papers(), ", ")));
}

/// What a claim may be of: the columns of figures_of(), but for those that the study cannot have.
std::vector<std::string> figures_to_claim(StudyClaim const& claim, StudyDescription const& study) {
  std::vector<std::string> parts = {"self", "cross"};
  if (study.folds > 0) parts.emplace_back("validation");
  std::vector<std::string> figures;
  for (auto const& part : parts) figures.push_back(part + ".rmse");
  if (claim.world == mean_of_worlds) return figures;
  for (auto const& part : parts)
    for (auto const* measure : {".mae", ".max", ".r_squared", ".mape"}) figures.push_back(part + measure);
  for (std::string const statistic : {"S", "Mn", "Sd", "verification.Mn", "verification.Sd"})
    for (auto const* of : {"", ".least", ".most"}) figures.push_back(statistic + of);
  figures.emplace_back("improvement");
  for (std::string const worth : {"regret", "informative", "found", "rank_correlation", "switches", "count"})
    figures.push_back("selection." + worth);
  for (auto const& instant : world_of(claim, study).instants)
    for (auto const* measure : {".rmse", ".mae", ".max"}) figures.push_back(instant.name() + measure);
  return figures;
}

/// That there is the figure, and what is asked of it.
void check_figure(Value const& table, StudyClaim const& claim, StudyDescription const& study) {
  auto const known = figures_to_claim(claim, study);
  if (std::find(known.begin(), known.end(), claim.figure) == known.end())
    throw FileError(where_of(table, "figure"),
                    fmt::format("a study has no figure '{}'{}; {}", claim.figure,
                                claim.world == mean_of_worlds ? " in the mean of worlds" : "",
                                claim.figure.starts_with("validation.") && study.folds == 0
                                    ? "give 'folds', which it is of"
                                    : thermal::did_you_mean(claim.figure, known)));
  bool const more = more_is_better(claim.figure);
  if (claim.share && more)
    throw FileError(where_of(table, "share"),
                    fmt::format("a 'share' is at most so much of the other's figure, but of '{}' more is better; give "
                                "'improvement' or 'tolerance'",
                                claim.figure));
  if (claim.improvement && *claim.improvement > 100.0 && !more)
    throw FileError(where_of(table, "improvement"),
                    fmt::format("an 'improvement' by {:g} % leaves less than nothing of the other's '{}'; 100 % is all",
                                *claim.improvement, claim.figure));
}

void check_claim(Value const& table, StudyClaim const& claim, std::vector<std::string> combinations,
                 StudyDescription const& study) {
  combinations.emplace_back(best_of_papers);
  check_combination(table, "than", claim.than, combinations);
  combinations.back() = chosen_by_validation;
  check_combination(table, "combination", claim.combination, combinations);
  check_comparison(table, claim);
  if (claim.combination == chosen_by_validation && study.folds == 0)
    throw FileError(where_of(table, "combination"), "there is no cross-validation to choose by; give 'folds'");
  std::vector<std::string> worlds;
  for (auto const& world : study.worlds) worlds.push_back(world.name);
  if (worlds.size() > 1) worlds.emplace_back(mean_of_worlds);
  if (!claim.world.empty() && std::find(worlds.begin(), worlds.end(), claim.world) == worlds.end())
    throw FileError(where_of(table, "world"),
                    fmt::format("no world '{}'; {}", claim.world, thermal::did_you_mean(claim.world, worlds)));
  check_rows(table, claim, study);
  check_figure(table, claim, study);
}

template <class Method>
std::vector<std::string> names_of(std::span<Method const> methods) {
  std::vector<std::string> names;
  for (auto const& method : methods) names.emplace_back(method.name);
  return names;
}

void require_known(char const* kind, std::string const& name, std::vector<std::string> const& known) {
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw thermal::InputError(fmt::format("no {} '{}'; {}", kind, name, thermal::did_you_mean(name, known)));
}

/// "T1, T4": what stands between commas, without blanks around it.
std::vector<std::string> listed_sensors(std::string const& text, std::string const& list) {
  std::vector<std::string> names;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = list.find(',', begin);
    auto name = list.substr(begin, end - begin);
    auto const first = name.find_first_not_of(' ');
    if (first == std::string::npos)
      throw thermal::InputError(fmt::format("'{}': after 'sensors', names with commas between them are due", text));
    name = name.substr(first, name.find_last_not_of(' ') + 1 - first);
    if (std::find(names.begin(), names.end(), name) != names.end())
      throw thermal::InputError(fmt::format("'{}': '{}' is given twice", text, name));
    names.push_back(name);
  }
  return names;
}

Value::List const& tables(Value const& document, std::string const& key) {
  static Value::List const none;
  Value const* value = document.find(key);
  return value ? std::get<Value::List>(value->content) : none;
}

/// The names of all combinations.
std::vector<std::string> checked_combinations(Value const& document, StudyDescription const& study) {
  auto const& worlds = study.worlds;
  bool const bare = !worlds.empty() &&
                    std::all_of(worlds.begin(), worlds.end(), [](auto const& world) { return world.machine.empty(); });
  auto const refuse_bare = [&](std::string const& text, bool needs_machine) {
    if (bare && needs_machine)
      throw thermal::InputError(fmt::format("'{}' needs a machine, and no [[world]] names one; give 'machine'", text));
  };
  check_items(document, "selections", study.selections,
              [&](auto const& text) { refuse_bare(text, named_selection(text).needs_machine()); });
  check_items(document, "models", study.models,
              [&](auto const& text) { refuse_bare(text, need_machine(named_models(text))); });
  auto const is_in = [](std::string const& name, std::vector<std::string> const& list) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  auto const check = [&](std::string const& text) {
    auto const named = named_combination(text);
    if (is_in(named.selection, study.selections) && is_in(named.model, study.models))
      throw thermal::InputError(fmt::format("'{}' is there already, of 'selections' and 'models'", text));
    refuse_bare(text, named.needs_machine());
  };
  if (!study.also.empty()) check_items(document, "also", study.also, check);
  std::vector<std::string> names;
  for (auto const& named : named_combinations(study)) names.push_back(named.name());
  return names;
}

void check_study(Value const& document, StudyDescription const& study) {
  auto const combinations = checked_combinations(document, study);
  if (study.worlds.empty()) throw FileError(document.where, "the study has no [[world]]");
  std::vector<std::string> names;
  for (std::size_t w = 0; w < study.worlds.size(); ++w) {
    auto const& world = study.worlds[w];
    auto const& table = tables(document, "world")[w];
    if (std::find(names.begin(), names.end(), world.name) != names.end())
      throw FileError(table.where, fmt::format("a world '{}' is there already", world.name));
    names.push_back(world.name);
    check_world(table, world);
  }
  check_combination(document, "reference", study.reference, combinations);
  for (std::size_t c = 0; c < study.claims.size(); ++c)
    check_claim(tables(document, "claim")[c], study.claims[c], combinations, study);
  for (std::size_t w = 0; w < study.worlds.size(); ++w)
    if (study.folds > 0 && study.worlds[w].fit == "each")
      throw FileError(
          where_of(tables(document, "world")[w], "fit"),
          "'fit' is each: every run predicts every other, and 'folds' have nothing to leave out; give 'folds' "
          "= 0, or fit = \"together\"");
  if (study.folds == 1) throw FileError(where_of(document, "folds"), "'folds' is 1; 0 or at least 2 are due");
}

}  // namespace

NamedModel named_model(std::string const& text) {
  bool const twin = text == twin_alone || text.starts_with(std::string(twin_alone) + " ");
  NamedModel model{twin, twin ? text.substr(std::min(twin_alone.size() + 1, text.size())) : text};
  if (model.observes() || (twin && model.method.empty())) return model;
  auto known = names_of(models::model_methods());
  if (twin)
    known.emplace_back("observer");
  else
    known.insert(known.end(), {"twin", "twin observer"});
  require_known("model", model.method, known);
  return model;
}

NamedSelection named_selection(std::string const& text) {
  auto const space = text.find(' ');
  NamedSelection selection{text.substr(0, space), {}};
  if (selection.name == "sensors") {
    selection.sensors = listed_sensors(text, text.substr(std::min(space, text.size())));
    return selection;
  }
  auto known = names_of(models::selection_methods());
  known.insert(known.end(), {"all", "sensors"});
  require_known("selection method", selection.name, known);
  if (space == std::string::npos) return selection;
  int count = 0;
  auto const [end, error] = std::from_chars(text.data() + space + 1, text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 1)
    throw thermal::InputError(fmt::format("'{}': after the method's name, a number of sensors from 1 on is due", text));
  if (selection.name == "all") throw thermal::InputError(fmt::format("'{}': all sensors have no number", text));
  selection.count = count;
  return selection;
}

std::vector<NamedModel> named_models(std::string const& text) {
  std::string const between = " & ";
  std::vector<NamedModel> models;
  for (std::size_t begin = 0;;) {
    auto const end = text.find(between, begin);
    auto const model = named_model(text.substr(begin, end - begin));
    if (std::find(models.begin(), models.end(), model) != models.end())
      throw std::invalid_argument(fmt::format("'{}' has a model twice", text));
    models.push_back(model);
    if (end == std::string::npos) return models;
    begin = end + between.size();
  }
}

bool need_machine(std::vector<NamedModel> const& models) {
  return std::any_of(models.begin(), models.end(), [](auto const& model) { return model.twin; });
}

thermal::InputError about(Value const& table, std::string const& complaint, std::string const& before) {
  auto const text = before + complaint;
  if (!table.is_table()) return thermal::InputError(text);
  return FileError(place_of(table, complaint.substr(0, complaint.find(';'))), text);  // not at what it offers
}

thermal::InputError about(StudyWorld const& world, std::string const& complaint) {
  return about(world.table, complaint, fmt::format("world '{}': ", world.name));
}

Study read_study(std::filesystem::path const& file) {
  Value const document = read_toml(file);
  Study study;
  read_file_fields(document, FileKind::study, study.description);
  study.directory = file.has_parent_path() ? file.parent_path() : ".";
  check_study(document, study.description);
  for (std::size_t w = 0; w < study.description.worlds.size(); ++w)
    study.description.worlds[w].table = tables(document, "world")[w];
  study.document = document;
  if (study.description.reference.empty())
    study.description.reference =
        combination_name(study.description.selections.front(), study.description.models.front());
  return study;
}

std::filesystem::path study_file(std::string const& name_or_path) {
  return shipped_file("study", "scenarios/studies", name_or_path);
}

std::string combination_name(std::string const& selection, std::string const& model) {
  return selection + " + " + model;
}

}  // namespace thermotwin::twin
