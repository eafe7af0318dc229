#include "twin/study/study.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <set>

#include "twin/parallel.h"
#include "twin/study/choice.h"
#include "twin/study/judgement.h"
#include "twin/study/study_twin.h"
#include "twin/study/verdict.h"

namespace thermotwin::twin {
namespace {

using Columns = std::vector<Eigen::Index>;

models::SelectionOptions selection_options(StudyScreening const& screening) {
  using models::BiasCorrection, models::BinCount, models::BinEdges, models::Normalisation;
  static std::map<std::string, BinCount> const counts = {{"cellucci", BinCount::cellucci},
                                                         {"sturges", BinCount::sturges},
                                                         {"square_root", BinCount::square_root},
                                                         {"freedman_diaconis", BinCount::freedman_diaconis}};
  static std::map<std::string, BiasCorrection> const biases = {{"shuffle_null", BiasCorrection::shuffle_null},
                                                               {"miller_madow", BiasCorrection::miller_madow},
                                                               {"none", BiasCorrection::none}};
  static std::map<std::string, Normalisation> const normalisations = {{"across_sensors", Normalisation::across_sensors},
                                                                      {"over_time", Normalisation::over_time},
                                                                      {"z_score", Normalisation::z_score}};
  models::SelectionOptions options;
  options.normalisation = normalisations.at(screening.normalisation);
  options.resolution = screening.resolution;
  options.information.count = counts.at(screening.bins);
  options.information.bias = biases.at(screening.bias);
  options.information.edges = screening.edges == "equal_width" ? BinEdges::equal_width : BinEdges::equal_frequency;
  options.information.permutations = screening.permutations;
  return options;
}

/// What of a machine and its runs selections get to see that do not look at the error, but for the readings themselves.
bool read_alike(StudyWorld const& a, StudyWorld const& b) {
  return a.machine == b.machine && a.added == b.added && a.changes == b.changes && a.sampling == b.sampling;
}

/// "in 1 of 5 repetitions, T10 stands still", of what is not so in all.
std::string in_some(std::string const& what, int repetitions, int of) {
  return repetitions == of ? what : fmt::format("in {} of {} repetitions, {}", repetitions, of, what);
}

/// One of a study's questions.
struct QuestionPlace {
  std::size_t repetition, question;
};

/// One repetition of one world: its questions, and what selections and models made of them.
struct Repetition {
  std::size_t world;
  int number;  ///< within its world
  Questions questions;
  std::vector<Question const*> all;                               ///< fits, then validations
  std::vector<QuestionPlace> same;                                ///< per question: the first that is trained alike
  std::vector<QuestionPlace> same_readings;                       ///< ... but for the errors, which may be others
  std::vector<ModeShapes const*> modes;                           ///< per question, where a selection asks for them
  std::vector<std::shared_ptr<models::SharedScreen>> screens;     ///< per question, for all selections
  std::vector<std::vector<Choice>> choices;                       ///< per question, per selection
  std::vector<std::vector<std::map<Columns, FittedModel>>> fits;  ///< per question, per single model
  std::vector<Question> less_twin;                                ///< what a model beside a twin is asked, if any is
  std::vector<std::string> twin_refused;                          ///< per question; empty: it was calibrated
  std::vector<std::shared_ptr<Machine const>> twins;              ///< per question: the calibrated machine

  [[nodiscard]] Question const& asked(std::size_t question, NamedModel const& model) const {
    return model.twin ? less_twin[question] : *all[question];
  }
};

class StudyRunner {
 public:
  StudyRunner(Study const& study, StudyOptions const& options) : study_(study.description), options_(options) {
    worlds_ = study_data(study, progress("runs"), options.stop);
    for (auto const& name : study_.selections) selections_.push_back(named_selection(name));
    for (auto const& name : study_.models) {
      auto& own = members_.emplace_back();
      for (auto const& model : named_models(name)) {
        auto const known = std::find(models_.begin(), models_.end(), model);
        own.push_back(std::size_t(known - models_.begin()));
        if (known == models_.end()) models_.push_back(model);
      }
    }
  }
  StudyReport run();

 private:
  [[nodiscard]] std::function<void(double)> progress(std::string what) const;
  void ask();
  [[nodiscard]] QuestionPlace first_alike(QuestionPlace place, bool in_errors) const;
  [[nodiscard]] QuestionPlace first_choice(QuestionPlace place, std::size_t selection) const;
  [[nodiscard]] bool is_first(QuestionPlace place) const {
    return repetitions_[place.repetition].same[place.question].repetition == place.repetition;
  }
  void find_modes();
  void choose_all();
  void calibrate_twins();
  void fit_all();
  void judge_selections(StudyReport& report);
  void judge_combinations(StudyReport& report);
  void put_improvements(StudyReport& report) const;
  void put_means(StudyReport& report) const;
  [[nodiscard]] bool observes(std::size_t world) const;
  [[nodiscard]] std::vector<std::string> remarks() const;
  [[nodiscard]] int repetitions_remarking(std::size_t world, std::string const& remark) const;
  [[nodiscard]] std::string answers_of(Repetition const& repetition, std::size_t selection, std::size_t model,
                                       std::vector<Answer>& fits, std::vector<Answer>& validations) const;
  [[nodiscard]] Combination combination(std::size_t world, std::size_t selection, std::size_t model) const;
  [[nodiscard]] SelectionFigures selection_figures(std::size_t world, std::size_t selection) const;
  [[nodiscard]] int unclaimed_instants(std::size_t world) const;
  [[nodiscard]] std::uint64_t seed_of(Repetition const& repetition) const {
    return 1 + std::uint64_t(repetition.number);
  }

  StudyDescription const& study_;
  StudyOptions const& options_;
  std::vector<WorldData> worlds_;
  std::vector<NamedSelection> selections_;
  std::vector<NamedModel> models_;                 ///< each single one once
  std::vector<std::vector<std::size_t>> members_;  ///< per model of the study: those whose mean it is
  std::vector<Repetition> repetitions_;
  std::vector<SelectionTruth> truths_;
  std::vector<std::map<std::vector<RunPart>, ModeShapes>> modes_;  ///< per world, by where it is linearised
  StudyWork work_;
  std::vector<int> unclaimed_;  ///< per world: the first instants that none of its models is judged by
};

std::function<void(double)> StudyRunner::progress(std::string what) const {
  if (!options_.progress) return {};
  return [this, what = std::move(what)](double share) { options_.progress(what, share); };
}

void StudyRunner::ask() {
  for (std::size_t w = 0; w < worlds_.size(); ++w)
    for (int r = 0; r < worlds_[w].repetitions(); ++r) {
      try {
        repetitions_.push_back(
            {w, r, questions(study_.worlds[w], worlds_[w], r, study_.folds), {}, {}, {}, {}, {}, {}, {}, {}, {}, {}});
      } catch (thermal::InputError const& error) {
        throw about(study_.worlds[w], error.what());
      }
    }
  for (auto& repetition : repetitions_) {
    for (auto const* list : {&repetition.questions.fits, &repetition.questions.validations})
      for (auto const& question : *list) repetition.all.push_back(&question);
    for (std::size_t q = 0; q < repetition.all.size(); ++q)
      repetition.screens.push_back(std::make_shared<models::SharedScreen>());
    repetition.modes.assign(repetition.all.size(), nullptr);
    repetition.choices.assign(repetition.all.size(), std::vector<Choice>(selections_.size()));
    repetition.fits.assign(repetition.all.size(), std::vector<std::map<Columns, FittedModel>>(models_.size()));
  }
  for (std::size_t r = 0; r < repetitions_.size(); ++r)
    for (std::size_t q = 0; q < repetitions_[r].all.size(); ++q) {
      repetitions_[r].same.push_back(first_alike({r, q}, true));
      repetitions_[r].same_readings.push_back(first_alike({r, q}, false));
    }
}

/// Of another world's questions, alike in their readings and `in_errors`, too: what is tested there changes nothing of
/// what is learnt.
QuestionPlace StudyRunner::first_alike(QuestionPlace place, bool in_errors) const {
  auto const& own = repetitions_[place.repetition];
  for (std::size_t r = 0; r < place.repetition; ++r) {
    auto const& other = repetitions_[r];
    if (other.world == own.world || other.number != own.number ||
        !read_alike(study_.worlds[other.world], study_.worlds[own.world]) ||
        (in_errors && study_.worlds[other.world].error != study_.worlds[own.world].error) ||
        worlds_[other.world].sensors != worlds_[own.world].sensors)
      continue;
    for (std::size_t q = 0; q < other.all.size(); ++q)
      if (auto const& asked = *own.all[place.question];
          in_errors ? trained_alike(*other.all[q], asked) : read_alike(*other.all[q], asked))
        return in_errors ? other.same[q] : other.same_readings[q];
  }
  return place;
}

/// Where the selection chooses for all that it sees alike.
QuestionPlace StudyRunner::first_choice(QuestionPlace place, std::size_t selection) const {
  auto const& repetition = repetitions_[place.repetition];
  return (sees_error(selections_[selection]) ? repetition.same : repetition.same_readings)[place.question];
}

/// Once for all repetitions, whose inputs are the same.
void StudyRunner::find_modes() {
  modes_.resize(worlds_.size());
  if (std::none_of(selections_.begin(), selections_.end(), [](auto const& one) { return one.name == modes_method; }))
    return;
  struct Task {
    std::size_t world;
    std::vector<RunPart> const* parts;
    ModeShapes* shapes;
  };
  std::vector<Task> tasks;
  for (auto& repetition : repetitions_)
    for (std::size_t q = 0; q < repetition.all.size(); ++q) {
      auto const [place, fresh] = modes_[repetition.world].try_emplace(of_first_run(repetition.all[q]->parts));
      repetition.modes[q] = &place->second;
      if (fresh) tasks.push_back({repetition.world, &place->first, &place->second});
    }
  in_parallel(tasks.size(), progress("modes"), options_.stop, [&](std::size_t i) {
    auto const& [world, parts, shapes] = tasks[i];
    *shapes = mode_shapes(study_.worlds[world], worlds_[world], *parts);
  });
}

void StudyRunner::choose_all() {
  struct Task {
    Repetition* repetition;
    std::size_t question, selection;
  };
  std::vector<Task> tasks;
  for (std::size_t r = 0; r < repetitions_.size(); ++r)
    for (std::size_t q = 0; q < repetitions_[r].all.size(); ++q)
      for (std::size_t s = 0; s < selections_.size(); ++s)
        if (first_choice({r, q}, s).repetition == r) tasks.push_back({&repetitions_[r], q, s});
  in_parallel(tasks.size(), progress("selections"), options_.stop, [&](std::size_t i) {
    auto const& [repetition, q, s] = tasks[i];
    auto options = selection_options(study_.screening);
    options.seed = seed_of(*repetition);
    options.shared = repetition->screens[q];
    auto const* modes = repetition->modes[q];
    repetition->choices[q][s] = choose(selections_[s], *repetition->all[q], worlds_[repetition->world],
                                       modes ? *modes : ModeShapes{}, std::move(options));
  });
  for (std::size_t r = 0; r < repetitions_.size(); ++r)
    for (std::size_t q = 0; q < repetitions_[r].all.size(); ++q)
      for (std::size_t s = 0; s < selections_.size(); ++s)
        if (auto const [first, question] = first_choice({r, q}, s); first != r)
          repetitions_[r].choices[q][s] = repetitions_[first].choices[question][s];
  work_.selections = tasks.size();
  for (auto const& repetition : repetitions_)
    for (auto const& screen : repetition.screens) work_.clusterings += std::size_t(screen->made());
}

void StudyRunner::calibrate_twins() {
  if (std::none_of(models_.begin(), models_.end(), [](auto const& model) { return model.twin; })) return;
  struct Asking {
    Repetition* repetition;
    std::size_t question;
  };
  std::map<std::string, std::vector<Asking>> sharing;
  for (auto& repetition : repetitions_) {
    repetition.less_twin.resize(repetition.all.size());
    repetition.twin_refused.resize(repetition.all.size());
    repetition.twins.resize(repetition.all.size());
    for (std::size_t q = 0; q < repetition.all.size(); ++q)
      sharing[twin_key(study_.worlds[repetition.world], worlds_[repetition.world], repetition.number,
                       *repetition.all[q])]
          .push_back({&repetition, q});
  }
  std::vector<std::vector<Asking> const*> tasks;
  for (auto const& [key, askings] : sharing) tasks.push_back(&askings);
  work_.twins = tasks.size();
  in_parallel(tasks.size(), progress("twins"), options_.stop, [&](std::size_t i) {
    auto const& [first, question] = tasks[i]->front();
    auto const twin =
        twin_runs(study_.worlds[first->world], worlds_[first->world], first->number, *first->all[question]);
    for (auto const& [repetition, q] : *tasks[i]) {
      repetition->twin_refused[q] = twin.refused;
      repetition->twins[q] = twin.machine;
      if (twin.refused.empty())
        repetition->less_twin[q] = less_twin(*repetition->all[q], study_.worlds[repetition->world],
                                             worlds_[repetition->world], repetition->number, twin);
    }
  });
}

void StudyRunner::fit_all() {
  struct Task {
    Repetition* repetition;
    std::size_t question, model;
    Columns const* columns;
    FittedModel* fit;
  };
  std::vector<Task> tasks;
  for (std::size_t r = 0; r < repetitions_.size(); ++r)
    for (std::size_t q = 0; q < repetitions_[r].all.size(); ++q)
      for (auto const& choice : repetitions_[r].choices[q]) {
        if (!choice.refused.empty()) continue;
        for (std::size_t m = 0; m < models_.size(); ++m) {
          if (!models_[m].twin && !is_first({r, q})) continue;
          auto const [place, fresh] = repetitions_[r].fits[q][m].try_emplace(choice.columns);
          if (fresh) tasks.push_back({&repetitions_[r], q, m, &place->first, &place->second});
        }
      }
  work_.fits = tasks.size();
  in_parallel(tasks.size(), progress("models"), options_.stop, [&](std::size_t i) {
    auto const& task = tasks[i];
    auto const& repetition = *task.repetition;
    auto const& model = models_[task.model];
    if (model.twin && !repetition.twin_refused[task.question].empty())
      *task.fit = {{}, repetition.twin_refused[task.question]};
    else if (model.observes())
      *task.fit = observed(study_.worlds[repetition.world], worlds_[repetition.world], repetition.number,
                           *repetition.all[task.question], *repetition.twins[task.question], *task.columns);
    else
      *task.fit = fit_model(model, repetition.asked(task.question, model), *task.columns, seed_of(repetition));
  });
  for (std::size_t r = 0; r < repetitions_.size(); ++r)
    for (std::size_t q = 0; q < repetitions_[r].all.size(); ++q)
      for (std::size_t m = 0; m < models_.size() && !is_first({r, q}); ++m)
        if (!models_[m].twin) {
          auto const& [first, question] = repetitions_[r].same[q];
          repetitions_[r].fits[q][m] = repetitions_[first].fits[question][m];
        }
}

/// The first instants of each run that one of the world's models does not claim: a model that skips the start of a run
/// is compared with others on the rest alone.
int StudyRunner::unclaimed_instants(std::size_t world) const {
  int most = 0;
  for (auto const& repetition : repetitions_)
    if (repetition.world == world)
      for (auto const& of_question : repetition.fits)
        for (auto const& of_model : of_question)
          for (auto const& [columns, fit] : of_model)
            if (fit.refused.empty()) most = std::max(most, fit.model.unclaimed_instants());
  return most;
}

/// The models of all questions; or why there are none.
std::string StudyRunner::answers_of(Repetition const& repetition, std::size_t selection, std::size_t model,
                                    std::vector<Answer>& fits, std::vector<Answer>& validations) const {
  for (std::size_t q = 0; q < repetition.all.size(); ++q) {
    auto const& choice = repetition.choices[q][selection];
    auto const prefix = repetition.all.size() > 1 ? repetition.all[q]->name + ": " : std::string();
    if (!choice.refused.empty()) return prefix + choice.refused;
    Answer answer;
    for (auto const m : members_[model]) {
      auto const& fit = repetition.fits[q][m].at(choice.columns);
      if (!fit.refused.empty()) return prefix + fit.refused;
      answer.parts.push_back(
          {&repetition.asked(q, models_[m]), &fit.model, fit.observed.empty() ? nullptr : &fit.observed});
    }
    (q < repetition.questions.fits.size() ? fits : validations).push_back(std::move(answer));
  }
  return {};
}

Combination StudyRunner::combination(std::size_t world, std::size_t selection, std::size_t model) const {
  Combination row{study_.worlds[world].name, study_.selections[selection], study_.models[model], {}, {}, {}, {}, {}};
  int refusals = 0;
  auto const refuse = [&](std::string const& why) {
    if (refusals++ == 0) row.refused = why;
  };
  for (auto const& repetition : repetitions_) {
    if (repetition.world != world) continue;
    std::vector<Answer> fits, validations;
    if (auto const why = answers_of(repetition, selection, model, fits, validations); !why.empty()) {
      refuse(why);
      continue;
    }
    try {
      auto const judgement = judged(fits, validations, study_.worlds[world].train.size(), unclaimed_[world]);
      auto figures = judgement.figures;
      if (repetition.number == 0) row.deviations = judgement.deviations;
      bool const of_readings = members_[model].size() == 1 && !models_[members_[model].front()].twin;
      if (!study_.worlds[world].instants.empty() && fits.size() == 1 && of_readings)
        figures.merge(judged_instants(study_.worlds[world], worlds_[world], repetition.number,
                                      *fits.front().parts.front().model));
      for (auto const& [name, value] : figures) row.figures[name].push_back(value);
    } catch (std::invalid_argument const& error) {
      refuse(error.what());
      continue;
    }
    if (repetition.number > 0) continue;
    auto const& parts = fits.front().parts;
    row.sensors = parts.front().model->inputs;
    std::vector<std::string> remarks;
    for (auto const& part : parts)
      if (!part.model->remark.empty()) remarks.push_back(part.model->remark);
    row.remark = fmt::format("{}", fmt::join(remarks, "; "));
  }
  if (refusals > 0) {
    row.refused = in_some(row.refused, refusals, worlds_[world].repetitions());
    row.figures.clear();
  }
  return row;
}

void StudyRunner::judge_combinations(StudyReport& report) {
  for (std::size_t w = 0; w < worlds_.size(); ++w) unclaimed_.push_back(unclaimed_instants(w));
  std::size_t const per_world = selections_.size() * members_.size();
  report.rows.resize(worlds_.size() * per_world);
  in_parallel(report.rows.size(), progress("judgement"), options_.stop, [&](std::size_t i) {
    report.rows[i] = combination(i / per_world, i % per_world / members_.size(), i % members_.size());
  });
}

SelectionFigures StudyRunner::selection_figures(std::size_t world, std::size_t selection) const {
  SelectionFigures result{study_.worlds[world].name, study_.selections[selection], {}, {}, {}};
  std::string refused;
  int refusals = 0;
  for (auto const& repetition : repetitions_) {
    if (repetition.world != world) continue;
    bool chose = true;
    std::map<std::string, std::vector<double>> values;
    std::vector<Choice const*> choices;
    for (std::size_t q = 0; q < repetition.questions.fits.size(); ++q) {
      auto const& choice = repetition.choices[q][selection];
      if (!choice.refused.empty()) {
        if (refused.empty()) refused = choice.refused;
        chose = false;
        continue;
      }
      if (result.remark.empty()) result.remark = choice.selection.remark;
      if (result.evidence.empty()) result.evidence = choice.selection.evidence;
      choices.push_back(&choice);
      values["count"].push_back(double(choice.columns.size()));
      auto const quality = selections_[selection].name == "all" ? std::nullopt : truths_[world].quality(choice);
      if (!quality) continue;
      values["regret"].push_back(quality->regret);
      values["informative"].push_back(quality->score.informative);
      values["found"].push_back(quality->score.found);
      if (selections_[selection].sensors.empty()) values["rank_correlation"].push_back(quality->score.rank_correlation);
    }
    for (auto const& [name, of_questions] : values) result.figures[name].push_back(interval(of_questions).mean);
    if (auto const share = switch_share(choices)) result.figures["switches"].push_back(*share);
    refusals += chose ? 0 : 1;
  }
  if (refusals > 0) {
    result.remark = "refused: " + in_some(refused, refusals, worlds_[world].repetitions());
    result.figures.clear();
  }
  return result;
}

void StudyRunner::judge_selections(StudyReport& report) {
  for (auto const& world : worlds_) truths_.emplace_back(world);
  std::vector<std::set<int>> counts(worlds_.size());
  for (auto const& repetition : repetitions_)
    for (std::size_t q = 0; q < repetition.questions.fits.size(); ++q)
      for (std::size_t s = 0; s < selections_.size(); ++s)
        if (selections_[s].name != "all" && repetition.choices[q][s].refused.empty())
          counts[repetition.world].insert(int(repetition.choices[q][s].columns.size()));
  in_parallel(worlds_.size(), progress("best sets"), options_.stop, [&](std::size_t w) {
    for (int const count : counts[w]) truths_[w].prepare(count);
  });
  for (std::size_t w = 0; w < worlds_.size(); ++w)
    for (std::size_t s = 0; s < selections_.size(); ++s) report.selections.push_back(selection_figures(w, s));
}

void StudyRunner::put_improvements(StudyReport& report) const {
  auto const figure = "cross." + study_.metric;
  for (auto& row : report.rows) {
    auto const reference = std::find_if(report.rows.begin(), report.rows.end(), [&](auto const& other) {
      return other.world == row.world && other.name() == study_.reference;
    });
    auto const before = values_of(reference->figures, figure), after = values_of(row.figures, figure);
    double const whole = interval(before).mean;
    for (std::size_t r = 0; r < std::min(before.size(), after.size()); ++r)
      row.figures["improvement"].push_back(100.0 * (before[r] - after[r]) / whole);
  }
}

/// Repetition by repetition, over worlds of the same unit, where all have as many repetitions.
void StudyRunner::put_means(StudyReport& report) const {
  bool const alike = std::all_of(worlds_.begin(), worlds_.end(), [&](auto const& world) {
    return world.unit == worlds_.front().unit && world.repetitions() == worlds_.front().repetitions();
  });
  if (worlds_.size() < 2 || !alike) return;
  std::size_t const per_world = report.rows.size() / worlds_.size();
  for (std::size_t i = 0; i < per_world; ++i) {
    Combination mean{std::string(mean_of_worlds), report.rows[i].selection, report.rows[i].model, {}, {}, {}, {}, {}};
    for (auto const* figure : {"self.rmse", "cross.rmse", "validation.rmse"}) {
      std::vector<double> sum(std::size_t(worlds_.front().repetitions()), 0.0);
      bool everywhere = true;
      for (std::size_t w = 0; w < worlds_.size(); ++w) {
        auto const& row = report.rows[w * per_world + i];
        auto const values = values_of(row.figures, figure);
        everywhere = everywhere && values.size() == sum.size();
        if (!row.refused.empty()) mean.refused = row.world + ": " + row.refused;
        for (std::size_t r = 0; everywhere && r < sum.size(); ++r) sum[r] += values[r] / double(worlds_.size());
      }
      if (everywhere) mean.figures[figure] = sum;
    }
    report.means.push_back(std::move(mean));
  }
}

/// Of that world's, those whose questions say so.
int StudyRunner::repetitions_remarking(std::size_t world, std::string const& remark) const {
  return int(std::count_if(repetitions_.begin(), repetitions_.end(), [&](auto const& repetition) {
    auto const& remarks = repetition.questions.remarks;
    return repetition.world == world && std::find(remarks.begin(), remarks.end(), remark) != remarks.end();
  }));
}

/// Whether an observer was fitted for a combination of the world.
bool StudyRunner::observes(std::size_t world) const {
  for (auto const& repetition : repetitions_)
    for (auto const& question : repetition.fits)
      for (std::size_t m = 0; m < models_.size(); ++m)
        if (repetition.world == world && models_[m].observes() &&
            std::any_of(question[m].begin(), question[m].end(),
                        [](auto const& fit) { return fit.second.refused.empty(); }))
          return true;
  return false;
}

/// Each once, with the worlds that it is about.
std::vector<std::string> StudyRunner::remarks() const {
  std::vector<std::pair<std::string, std::vector<std::string>>> told;
  auto const tell = [&](std::string const& remark, std::string const& world) {
    auto it = std::find_if(told.begin(), told.end(), [&](auto const& one) { return one.first == remark; });
    if (it == told.end()) it = told.insert(it, {remark, {}});
    if (it->second.empty() || it->second.back() != world) it->second.push_back(world);
  };
  for (std::size_t w = 0; w < worlds_.size(); ++w) {
    for (auto const& remark : worlds_[w].remarks) tell(remark, study_.worlds[w].name);
    if (!observes(w)) continue;
    for (auto const& remark : observer_remarks(study_.worlds[w], *worlds_[w].runs)) tell(remark, study_.worlds[w].name);
  }
  for (auto const& repetition : repetitions_)
    for (auto const& remark : repetition.questions.remarks) {
      auto const world = repetition.world;
      tell(in_some(remark, repetitions_remarking(world, remark), worlds_[world].repetitions()),
           study_.worlds[world].name);
    }
  std::vector<std::string> texts;
  for (auto const& [remark, worlds] : told) texts.push_back(fmt::format("{}: {}", fmt::join(worlds, ", "), remark));
  return texts;
}

StudyReport StudyRunner::run() {
  StudyReport report;
  report.description = study_;
  ask();
  find_modes();
  choose_all();
  calibrate_twins();
  fit_all();
  judge_selections(report);
  judge_combinations(report);
  put_improvements(report);
  put_means(report);
  for (std::size_t w = 0; w < worlds_.size(); ++w) {
    report.units.push_back(worlds_[w].unit);
    report.repetitions.push_back(worlds_[w].repetitions());
    work_.runs += worlds_[w].runs->made;
  }
  report.work = work_;
  report.remarks = remarks();
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
