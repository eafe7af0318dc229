#include "twin/study/study.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>

#include "twin/parallel.h"
#include "twin/study/choice.h"
#include "twin/study/combination_row.h"
#include "twin/study/combinations.h"
#include "twin/study/judgement.h"
#include "twin/study/selection_row.h"
#include "twin/study/studied_world.h"
#include "twin/study/study_remarks.h"
#include "twin/study/study_twin.h"
#include "twin/study/verdict.h"

namespace thermotwin::twin {
namespace {

using Columns = std::vector<Eigen::Index>;

class StudyRunner {
 public:
  StudyRunner(Study const& study, StudyOptions const& options)
      : study_(study.description),
        options_(options),
        combinations_(study_),
        worlds_(studied_worlds(study_, study_data(study, progress("runs"), options.stop), combinations_)) {
    for (auto& world : worlds_)
      for (auto& repetition : world.repetitions)
        for (auto& trial : repetition.trials) places_.push_back({world, repetition, trial});
  }
  StudyReport run();

 private:
  /// Where a trial stands.
  struct Place {
    StudiedWorld& world;
    Repetition const& repetition;
    StudyTrial& trial;
  };

  [[nodiscard]] std::function<void(double)> progress(std::string what) const;
  void find_modes();
  void choose_all();
  void calibrate_twins();
  void fit_all();
  [[nodiscard]] FittedModel fitted(Place const& place, NamedModel const& model, Columns const& columns) const;
  void judge_selections(StudyReport& report) const;
  void judge_combinations(StudyReport& report) const;

  StudyDescription const& study_;
  StudyOptions const& options_;
  Combinations combinations_;
  std::vector<StudiedWorld> worlds_;
  std::vector<Place> places_;  ///< of all trials, world by world
  StudyWork work_;
};

std::function<void(double)> StudyRunner::progress(std::string what) const {
  if (!options_.progress) return {};
  return [this, what = std::move(what)](double share) { options_.progress(what, share); };
}

/// Once for all repetitions, whose inputs are the same.
void StudyRunner::find_modes() {
  auto const& selections = combinations_.selections;
  if (std::none_of(selections.begin(), selections.end(), [](auto const& one) { return one.name == modes_method; }))
    return;
  struct Task {
    StudiedWorld const* world;
    std::vector<RunPart> const* parts;
    ModeShapes* shapes;
  };
  std::vector<Task> tasks;
  for (auto const& [world, repetition, trial] : places_) {
    auto const [place, fresh] = world.modes.try_emplace(of_first_run(trial.question.parts));
    trial.modes = &place->second;
    if (fresh) tasks.push_back({&world, &place->first, &place->second});
  }
  in_parallel(tasks.size(), progress("modes"), options_.stop, [&](std::size_t i) {
    auto const& [world, parts, shapes] = tasks[i];
    *shapes = mode_shapes(world->description, world->data, *parts);
  });
}

void StudyRunner::choose_all() {
  struct Task {
    Place const* place;
    std::size_t selection;
  };
  std::vector<Task> tasks;
  auto const& selections = combinations_.selections;
  for (auto const& place : places_)
    for (std::size_t s = 0; s < selections.size(); ++s)
      if (!place.trial.choice_before(selections[s])) tasks.push_back({&place, s});
  in_parallel(tasks.size(), progress("selections"), options_.stop, [&](std::size_t i) {
    auto const& [world, repetition, trial] = *tasks[i].place;
    auto const s = tasks[i].selection;
    auto options = selection_options(study_.screening);
    options.seed = repetition.seed();
    options.shared = trial.screen;
    trial.choices[s] = choose(selections[s], trial.question, world.data, trial.modes ? *trial.modes : ModeShapes{},
                              std::move(options));
  });
  for (auto const& place : places_) {
    for (std::size_t s = 0; s < selections.size(); ++s)
      if (auto const* before = place.trial.choice_before(selections[s])) place.trial.choices[s] = before->choices[s];
    work_.clusterings += std::size_t(place.trial.screen->made());
  }
  work_.selections = tasks.size();
}

void StudyRunner::calibrate_twins() {
  if (!need_machine(combinations_.models)) return;
  std::map<std::string, std::vector<Place const*>> sharing;
  for (auto const& place : places_) {
    auto const& [world, repetition, trial] = place;
    sharing[twin_key(world.description, world.data, repetition.number, trial.question)].push_back(&place);
  }
  std::vector<std::vector<Place const*> const*> tasks;
  for (auto const& [key, places] : sharing) tasks.push_back(&places);
  in_parallel(tasks.size(), progress("twins"), options_.stop, [&](std::size_t i) {
    auto const& first = *tasks[i]->front();
    auto const twin =
        twin_runs(first.world.description, first.world.data, first.repetition.number, first.trial.question);
    for (auto const* place : *tasks[i]) {
      auto const& [world, repetition, trial] = *place;
      trial.twin_refused = twin.refused;
      trial.twin = twin.machine;
      if (twin.refused.empty())
        trial.less_twin = less_twin(trial.question, world.description, world.data, repetition.number, twin);
    }
  });
  work_.twins = std::size_t(std::count_if(
      tasks.begin(), tasks.end(), [](auto const* places) { return places->front()->trial.twin_refused.empty(); }));
}

FittedModel StudyRunner::fitted(Place const& place, NamedModel const& model, Columns const& columns) const {
  auto const& [world, repetition, trial] = place;
  if (model.twin && !trial.twin_refused.empty()) return {{}, trial.twin_refused};
  if (model.observes())
    return observed(world.description, world.data, repetition.number, trial.question, *trial.twin, columns);
  return fit_model(model, trial.asked(model), columns, repetition.seed());
}

/// On the readings alone, what is trained alike is fitted once; a twin knows its world.
void StudyRunner::fit_all() {
  struct Task {
    Place const* place;
    NamedModel const* model;
    Columns const* columns;
    FittedModel* fit;
  };
  std::vector<Task> tasks;
  auto const& models = combinations_.models;
  for (auto const& place : places_)
    for (std::size_t s = 0; s < combinations_.selections.size(); ++s) {
      auto const& choice = place.trial.choices[s];
      if (!choice.refused.empty()) continue;
      for (auto const m : combinations_.models_on(s)) {
        if (!models[m].twin && place.trial.trained_alike) continue;
        auto const [fit, fresh] = place.trial.fits[m].try_emplace(choice.columns);
        if (fresh) tasks.push_back({&place, &models[m], &fit->first, &fit->second});
      }
    }
  work_.fits = tasks.size();
  in_parallel(tasks.size(), progress("models"), options_.stop, [&](std::size_t i) {
    auto const& [place, model, columns, fit] = tasks[i];
    *fit = fitted(*place, *model, *columns);
  });
  for (auto const& place : places_)
    for (std::size_t m = 0; m < models.size(); ++m)
      if (auto const* before = place.trial.trained_alike; before && !models[m].twin)
        place.trial.fits[m] = before->fits[m];
}

void StudyRunner::judge_selections(StudyReport& report) const {
  std::vector<std::optional<SelectionTruth>> truths(worlds_.size());
  in_parallel(worlds_.size(), progress("best sets"), options_.stop,
              [&](std::size_t w) { truths[w] = selection_truth(worlds_[w], combinations_); });
  for (std::size_t w = 0; w < worlds_.size(); ++w)
    for (std::size_t s = 0; s < combinations_.selections.size(); ++s)
      report.selections.push_back(selection_row(worlds_[w], combinations_, s, *truths[w]));
}

void StudyRunner::judge_combinations(StudyReport& report) const {
  std::vector<int> unclaimed;
  for (auto const& world : worlds_) unclaimed.push_back(world.unclaimed_instants());
  std::size_t const per_world = combinations_.all.size();
  report.rows.resize(worlds_.size() * per_world);
  in_parallel(report.rows.size(), progress("judgement"), options_.stop, [&](std::size_t i) {
    auto const w = i / per_world;
    report.rows[i] = judged_combination(worlds_[w], combinations_, combinations_.all[i % per_world], unclaimed[w]);
  });
}

StudyReport StudyRunner::run() {
  StudyReport report;
  report.description = study_;
  for (auto const& world : worlds_) {
    report.units.push_back(world.data.unit);
    report.repetitions.push_back(world.data.repetitions());
    work_.runs += world.data.runs->made;
  }
  find_modes();
  choose_all();
  calibrate_twins();
  fit_all();
  judge_selections(report);
  judge_combinations(report);
  put_improvements(report);
  put_means(report);
  report.work = work_;
  report.remarks = study_remarks(worlds_, combinations_);
  put_verdict(report);
  return report;
}

}  // namespace

Figures figures_of(StudyReport const& report, Combination const& row) {
  Figures figures = row.figures;
  for (auto const& selection : report.selections)
    if (selection.world == row.world && selection.selection == row.selection)
      for (auto const& [name, values] : selection.figures) figures["selection." + name] = values;
  return figures;
}

StudyReport run_study(Study const& study, StudyOptions const& options) { return StudyRunner(study, options).run(); }

}  // namespace thermotwin::twin
