#include "twin/study/verdict.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "models/error_model.h"
#include "models/selection.h"

namespace thermotwin::twin {
namespace {

using Rows = std::vector<Combination const*>;

/// Selection and model both stand in one of the five papers.
bool of_papers(Combination const& row) {
  auto const selection = named_selection(row.selection).name;
  if (selection == "all") return false;
  auto const models = named_models(row.model);
  return models.size() == 1 && !models.front().twin &&
         models::selection_method(selection).source.find("methods.md") != std::string_view::npos &&
         models::model_method(row.model).source.find("methods.md") != std::string_view::npos;
}

Combination const* best_of(Rows const& rows, std::string const& figure) {
  Combination const* best = nullptr;
  double least = INFINITY;
  for (auto const* row : rows)
    if (double const mean = interval(values_of(row->figures, figure)).mean; mean < least) {
      least = mean;
      best = row;
    }
  return best;
}

std::string figure_text(Combination const& row, std::string const& figure, std::string const& unit) {
  return fmt::format("{} {}", text_of(interval(values_of(row.figures, figure)), 3), unit);
}

std::vector<double> ratios(std::vector<double> const& a, std::vector<double> const& b) {
  std::vector<double> result;
  for (std::size_t r = 0; r < std::min(a.size(), b.size()); ++r) result.push_back(a[r] / b[r]);
  return result;
}

std::vector<std::string> sentences(Rows const& rows, std::string const& unit) {
  std::string const figure = "cross.rmse";
  auto const* best = best_of(rows, figure);
  if (!best) return {"nothing could be judged: every combination was refused"};
  std::vector<std::string> words = {
      fmt::format("least RMSE where no model had been: {}, {}", best->name(), figure_text(*best, figure, unit))};
  if (auto const* chosen = best_of(rows, "validation.rmse"))
    words.push_back(fmt::format("chosen by cross-validation within the training runs: {}, {}", chosen->name(),
                                figure_text(*chosen, figure, unit)));
  Rows papers;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(papers), [](auto const* row) { return of_papers(*row); });
  auto const* paper = best_of(papers, figure);
  if (paper && paper != best)
    words.push_back(
        fmt::format("best of the papers' selections and models: {}, {}; the ratio to it is {}", paper->name(),
                    figure_text(*paper, figure, unit),
                    text_of(interval(ratios(values_of(best->figures, figure), values_of(paper->figures, figure))), 3)));
  return words;
}

/// Whether the margin is above zero, or `equal_will_do` and it is zero in every repetition.
ClaimVerdict::Answer answer_of(Interval const& margin, bool equal_will_do) {
  if (margin.values == 0) return ClaimVerdict::Answer::refused;
  double const least = margin.mean - margin.half, most = margin.mean + margin.half;
  if (least > 0.0 || (equal_will_do && least == 0.0)) return ClaimVerdict::Answer::holds;
  if (most < 0.0 || (!equal_will_do && most == 0.0)) return ClaimVerdict::Answer::fails;
  return ClaimVerdict::Answer::undecided;
}

Combination const& row_of(StudyReport const& report, std::string const& world, std::string const& name) {
  return *std::find_if(report.rows.begin(), report.rows.end(),
                       [&](auto const& row) { return row.world == world && row.name() == name; });
}

ClaimVerdict judged_claim(StudyReport const& report, StudyClaim const& claim) {
  auto const world = claim.world.empty() ? report.description.worlds.front().name : claim.world;
  auto const& row = row_of(report, world, claim.combination);
  auto const values = values_of(row.figures, claim.figure);
  std::vector<double> margin;
  std::string words;
  if (claim.at_most) {
    for (double const x : values) margin.push_back(*claim.at_most - x);
    words = fmt::format("{} of {}: {}, against {:g}", claim.figure, claim.combination, text_of(interval(values), 3),
                        *claim.at_most);
  } else {
    auto const others = values_of(row_of(report, world, claim.than).figures, claim.figure);
    double const share = 0.01 * (claim.improvement.value_or(0.0) - claim.tolerance.value_or(0.0));
    double const whole = interval(others).mean;
    std::vector<double> less;
    for (std::size_t r = 0; r < std::min(values.size(), others.size()); ++r) {
      less.push_back(100.0 * (others[r] - values[r]) / whole);
      margin.push_back((1.0 - share) * others[r] - values[r]);
    }
    words =
        fmt::format("{} of {}: {}, of {}: {}; {} % less", claim.figure, claim.combination, text_of(interval(values), 3),
                    claim.than, text_of(interval(others), 3), text_of(interval(less), 1));
    if (claim.improvement) words += fmt::format(", against {:g} %", *claim.improvement);
    if (claim.tolerance) words += fmt::format(", against {:g} % more at most", *claim.tolerance);
  }
  if (margin.empty()) words = fmt::format("there is no '{}' of these combinations in '{}'", claim.figure, world);
  return {claim, answer_of(interval(margin), claim.at_most || claim.tolerance), words};
}

}  // namespace

void put_verdict(StudyReport& report) {
  for (std::size_t w = 0; w < report.units.size(); ++w) {
    Rows rows;
    auto const& world = report.description.worlds[w].name;
    for (auto const& row : report.rows)
      if (row.world == world && row.refused.empty()) rows.push_back(&row);
    for (auto const& sentence : sentences(rows, report.units[w])) report.verdict.push_back(world + ": " + sentence);
  }
  Rows means;
  for (auto const& row : report.means)
    if (row.refused.empty()) means.push_back(&row);
  if (!means.empty())
    for (auto const& sentence : sentences(means, report.units.front()))
      report.verdict.push_back("mean of worlds: " + sentence);
  for (auto const& claim : report.description.claims) report.claims.push_back(judged_claim(report, claim));
}

}  // namespace thermotwin::twin
