#include "twin/study/combination_row.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "twin/study/judgement.h"

namespace thermotwin::twin {
namespace {

class CombinationJudge {
 public:
  CombinationJudge(StudiedWorld const& world, Combinations const& combinations, Combinations::One const& one,
                   int unclaimed)
      : world_(world), combinations_(combinations), one_(one), unclaimed_(unclaimed) {}
  Combination row() const;

 private:
  [[nodiscard]] std::string answers_of(Repetition const& repetition, std::vector<Answer>& fits,
                                       std::vector<Answer>& validations) const;
  [[nodiscard]] std::string judge(Repetition const& repetition, Combination& row) const;
  [[nodiscard]] bool judges_instants(std::vector<Answer> const& fits) const;

  StudiedWorld const& world_;
  Combinations const& combinations_;
  Combinations::One const& one_;
  int unclaimed_;
};

/// The models of all questions; or why there are none.
std::string CombinationJudge::answers_of(Repetition const& repetition, std::vector<Answer>& fits,
                                         std::vector<Answer>& validations) const {
  for (auto const& trial : repetition.trials) {
    auto const& choice = trial.choices[one_.selection];
    auto const prefix = repetition.trials.size() > 1 ? trial.question.name + ": " : std::string();
    if (!choice.refused.empty()) return prefix + choice.refused;
    Answer answer;
    for (auto const m : one_.models) {
      auto const& fit = trial.fits[m].at(choice.columns);
      if (!fit.refused.empty()) return prefix + fit.refused;
      answer.parts.push_back(
          {&trial.asked(combinations_.models[m]), &fit.model, fit.observed.empty() ? nullptr : &fit.observed});
    }
    (fits.size() < repetition.fits ? fits : validations).push_back(std::move(answer));
  }
  return {};
}

bool CombinationJudge::judges_instants(std::vector<Answer> const& fits) const {
  bool const of_readings = one_.models.size() == 1 && !combinations_.models[one_.models.front()].twin;
  return !world_.description.instants.empty() && fits.size() == 1 && of_readings;
}

/// Adds a repetition's figures to the row; or says why it has none.
std::string CombinationJudge::judge(Repetition const& repetition, Combination& row) const {
  std::vector<Answer> fits, validations;
  if (auto why = answers_of(repetition, fits, validations); !why.empty()) return why;
  bool const first = repetition.number == 0;
  try {
    auto const judgement = judged(fits, validations, world_.description.train.size(), unclaimed_);
    auto figures = judgement.figures;
    if (first) row.deviations = judgement.deviations;
    if (judges_instants(fits))
      figures.merge(
          judged_instants(world_.description, world_.data, repetition.number, *fits.front().parts.front().model));
    for (auto const& [name, value] : figures) row.figures[name].push_back(value);
  } catch (std::invalid_argument const& error) {
    return error.what();
  }
  if (!first) return {};
  auto const& parts = fits.front().parts;
  row.sensors = parts.front().model->inputs;
  std::vector<std::string> remarks;
  for (auto const& part : parts)
    if (!part.model->remark.empty()) remarks.push_back(part.model->remark);
  row.remark = fmt::format("{}", fmt::join(remarks, "; "));
  return {};
}

Combination CombinationJudge::row() const {
  Combination row{world_.description.name, one_.named.selection, one_.named.model, {}, {}, {}, {}, {}};
  std::size_t refusals = 0;
  for (auto const& repetition : world_.repetitions)
    if (auto const why = judge(repetition, row); !why.empty() && refusals++ == 0) row.refused = why;
  if (refusals > 0) {
    row.refused = world_.in_some(row.refused, refusals);
    row.figures.clear();
  }
  return row;
}

}  // namespace

Combination judged_combination(StudiedWorld const& world, Combinations const& combinations,
                               Combinations::One const& one, int unclaimed) {
  return CombinationJudge(world, combinations, one, unclaimed).row();
}

void put_improvements(StudyReport& report) {
  auto const figure = "cross." + report.description.metric;
  for (auto& row : report.rows) {
    auto const reference = std::find_if(report.rows.begin(), report.rows.end(), [&](auto const& other) {
      return other.world == row.world && other.name() == report.description.reference;
    });
    auto const before = values_of(reference->figures, figure), after = values_of(row.figures, figure);
    double const whole = interval(before).mean;
    for (std::size_t r = 0; r < std::min(before.size(), after.size()); ++r)
      row.figures["improvement"].push_back(100.0 * (before[r] - after[r]) / whole);
  }
}

void put_means(StudyReport& report) {
  std::size_t const worlds = report.units.size();
  for (std::size_t w = 1; w < worlds; ++w)
    if (report.units[w] != report.units.front() || report.repetitions[w] != report.repetitions.front()) return;
  if (worlds < 2) return;
  std::size_t const per_world = report.rows.size() / worlds;
  for (std::size_t i = 0; i < per_world; ++i) {
    Combination mean{std::string(mean_of_worlds), report.rows[i].selection, report.rows[i].model, {}, {}, {}, {}, {}};
    for (auto const* figure : {"self.rmse", "cross.rmse", "validation.rmse"}) {
      std::vector<double> sum(std::size_t(report.repetitions.front()), 0.0);
      bool everywhere = true;
      for (std::size_t w = 0; w < worlds; ++w) {
        auto const& row = report.rows[w * per_world + i];
        auto const values = values_of(row.figures, figure);
        everywhere = everywhere && values.size() == sum.size();
        if (!row.refused.empty()) mean.refused = row.world + ": " + row.refused;
        for (std::size_t r = 0; everywhere && r < sum.size(); ++r) sum[r] += values[r] / double(worlds);
      }
      if (everywhere) mean.figures[figure] = sum;
    }
    report.means.push_back(std::move(mean));
  }
}

}  // namespace thermotwin::twin
