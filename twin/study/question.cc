#include "twin/study/question.h"

#include <algorithm>
#include <fmt/format.h>

#include "models/contiguous_folds.h"
#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using models::Batch;

Eigen::VectorXd const& truth_of(StudyRun const& run) { return run.truth ? run.truth->error : run.seen.error; }

Asked whole(StudyRun const& run, Role role, std::size_t number) {
  return {role, run.seen, truth_of(run), 0, run.seen.time.size(), number};
}

RunPart whole(StudyRun const& run, std::size_t number) { return {number, 0, run.seen.time.size()}; }

bool moves(std::vector<Batch> const& batches, Index column) {
  return std::any_of(batches.begin(), batches.end(), [&](Batch const& batch) {
    auto const values = batch.temperature_rise.col(column).array();
    return values.maxCoeff() > values.minCoeff();
  });
}

/// Whether what is learnt there is of the one run and not of the other.
bool parts_runs(Question const& question, std::size_t one, std::size_t other) {
  auto const has = [&](std::size_t run) {
    return std::any_of(question.parts.begin(), question.parts.end(), [&](auto const& part) { return part.run == run; });
  };
  return has(one) != has(other);
}

class QuestionWriter {
 public:
  QuestionWriter(StudyWorld const& world, WorldData const& data, int repetition)
      : world_(world),
        train_(data.train[std::size_t(repetition)]),
        test_(data.test[std::size_t(repetition)]),
        rows_are_means_(world.sampling && data.runs->measured.front()) {}
  Questions write(int folds);

 private:
  void add(std::vector<Question>& to, std::string name, std::vector<RunPart> parts, std::vector<Asked> asked);
  void ask_tests(std::vector<Asked>& asked) const;
  void together();
  void split_run();
  void each();
  void folds_of_run(Index rows, int folds);
  void folds_of_runs(int folds);
  void remark_repeated();
  [[nodiscard]] Index split_row() const;

  StudyWorld const& world_;
  std::vector<StudyRun> const& train_;
  std::vector<StudyRun> const& test_;
  bool rows_are_means_;  ///< over what follows their time
  Questions questions_;
};

void QuestionWriter::add(std::vector<Question>& to, std::string name, std::vector<RunPart> parts,
                         std::vector<Asked> asked) {
  std::vector<Batch> training;
  for (auto const& part : parts) training.push_back(rows_of(train_[part.run].seen, part));
  Question question{std::move(name), {}, {}, std::move(asked), std::move(parts)};
  auto const& sensors = training.front().sensors;
  for (std::size_t j = 0; j < sensors.size(); ++j)
    if (moves(training, Index(j)))
      question.columns.push_back(Index(j));
    else
      questions_.remarks.push_back(
          fmt::format("{} stands still in {}, and is left out there", sensors[j], question.name));
  if (question.columns.empty()) throw thermal::InputError(fmt::format("no sensor moves in {}", question.name));
  for (auto const& batch : training) question.training.push_back(models::with_sensors(batch, question.columns));
  to.push_back(std::move(question));
}

Index QuestionWriter::split_row() const {
  auto const& time = train_.front().seen.time;
  double const last = rows_are_means_ ? *world_.split - *world_.sampling + 1e-6 : *world_.split - 1e-6;
  auto const row = std::upper_bound(time.begin(), time.end(), last) - time.begin();
  if (row < 10 || time.size() - row < 10)
    throw thermal::InputError(
        fmt::format("'split' leaves {} rows to train on and {} to test on; ten are the least", row, time.size() - row));
  return row;
}

void QuestionWriter::split_run() {
  auto const& run = train_.front();
  Index const row = split_row(), rows = run.seen.time.size();
  add(questions_.fits, run.seen.name, {{0, 0, row}},
      {{Role::self, run.seen, truth_of(run), 0, row}, {Role::cross, run.seen, truth_of(run), row, rows - row}});
}

void QuestionWriter::ask_tests(std::vector<Asked>& asked) const {
  for (std::size_t k = 0; k < test_.size(); ++k) asked.push_back(whole(test_[k], Role::cross, train_.size() + k));
}

void QuestionWriter::together() {
  std::vector<RunPart> parts;
  std::vector<Asked> asked;
  for (std::size_t k = 0; k < train_.size(); ++k) {
    parts.push_back(whole(train_[k], k));
    asked.push_back(whole(train_[k], Role::self, k));
  }
  ask_tests(asked);
  add(questions_.fits, train_.size() == 1 ? train_.front().seen.name : "the training runs", std::move(parts),
      std::move(asked));
}

void QuestionWriter::each() {
  for (std::size_t l = 0; l < train_.size(); ++l) {
    std::vector<Asked> asked;
    for (std::size_t k = 0; k < train_.size(); ++k)
      asked.push_back(whole(train_[k], k == l ? Role::self : Role::cross, k));
    ask_tests(asked);
    add(questions_.fits, train_[l].seen.name, {whole(train_[l], l)}, std::move(asked));
  }
}

/// Of the first `rows` of the only run.
void QuestionWriter::folds_of_run(Index rows, int folds) {
  auto const& run = train_.front();
  for (auto const& fold : models::contiguous_folds(rows, folds)) {
    std::vector<RunPart> parts;
    Index const behind = fold.first + fold.count;
    if (fold.first > 0) parts.push_back({0, 0, fold.first});
    if (behind < rows) parts.push_back({0, behind, rows - behind});
    add(questions_.validations, fmt::format("{} without rows {} to {}", run.seen.name, fold.first + 1, behind),
        std::move(parts),
        {{Role::validation, rows_of(run.seen, 0, rows), truth_of(run).head(rows), fold.first, fold.count}});
  }
}

void QuestionWriter::folds_of_runs(int folds) {
  auto const runs = Index(train_.size());
  for (auto const& fold : models::contiguous_folds(runs, std::min(folds, int(runs)))) {
    std::vector<RunPart> parts;
    std::vector<Asked> asked;
    for (Index k = 0; k < runs; ++k) {
      auto const number = std::size_t(k);
      if (k >= fold.first && k < fold.first + fold.count) {
        asked.push_back(whole(train_[number], Role::validation, number));
      } else {
        parts.push_back(whole(train_[number], number));
      }
    }
    auto const name = fmt::format("the training runs without {}", asked.front().batch.name);
    add(questions_.validations, name, std::move(parts), std::move(asked));
  }
}

/// Training runs that hold the same data.
void QuestionWriter::remark_repeated() {
  for (std::size_t l = 1; l < train_.size(); ++l)
    for (std::size_t k = 0; k < l; ++k) {
      auto const &later = train_[l].seen, &first = train_[k].seen;
      if (!same_data(later, first)) continue;
      bool const parted = std::any_of(questions_.validations.begin(), questions_.validations.end(),
                                      [&](auto const& question) { return parts_runs(question, k, l); });
      questions_.remarks.push_back(
          fmt::format("{} has the same data as {}; {}", later.name, first.name,
                      world_.fit == "each" ? "neither tests the other's models" : "they count once more") +
          (parted ? ", and where cross-validation leaves out one, it learns from the other" : ""));
      break;
    }
}

Questions QuestionWriter::write(int folds) {
  if (world_.split)
    split_run();
  else if (world_.fit == "each")
    each();
  else
    together();
  if (folds > 0 && world_.fit != "each") {
    if (train_.size() > 1)
      folds_of_runs(folds);
    else
      folds_of_run(world_.split ? split_row() : train_.front().seen.time.size(), folds);
  }
  remark_repeated();
  return std::move(questions_);
}

}  // namespace

Questions questions(StudyWorld const& world, WorldData const& data, int repetition, int folds) {
  return QuestionWriter(world, data, repetition).write(folds);
}

bool read_alike(Question const& a, Question const& b) {
  auto const same = [](Batch const& x, Batch const& y) {
    return x.name == y.name && x.sensors == y.sensors && same_readings(x, y) && x.before.rows() == y.before.rows() &&
           x.before == y.before;
  };
  return a.columns == b.columns && a.parts == b.parts &&
         std::equal(a.training.begin(), a.training.end(), b.training.begin(), b.training.end(), same);
}

bool trained_alike(Question const& a, Question const& b) {
  return read_alike(a, b) && std::equal(a.training.begin(), a.training.end(), b.training.begin(),
                                        [](Batch const& x, Batch const& y) { return x.error == y.error; });
}

Batch rows_of(Batch const& batch, Index first, Index count) {
  Batch part = batch;
  part.before.resize(batch.before.rows() + first, batch.temperature_rise.cols());
  if (batch.before.rows() > 0) part.before.topRows(batch.before.rows()) = batch.before;
  part.before.bottomRows(first) = batch.temperature_rise.topRows(first);
  part.time = batch.time.segment(first, count);
  part.temperature_rise = batch.temperature_rise.middleRows(first, count);
  part.error = batch.error.segment(first, count);
  return part;
}

}  // namespace thermotwin::twin
