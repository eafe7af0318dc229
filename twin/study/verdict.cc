#include "twin/study/verdict.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "thermal/nearest_name.h"
#include "twin/study/combinations.h"

namespace thermotwin::twin {
namespace {

using Rows = std::vector<Combination const*>;

Rows papers_of(Rows const& rows) {
  Rows papers;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(papers), [](auto const* row) {
    return NamedCombination{row->selection, row->model}.of_papers();
  });
  return papers;
}

Combination const* best_of(Rows const& rows, std::string const& figure) {
  Combination const* best = nullptr;
  double const sign = more_is_better(figure) ? -1.0 : 1.0;
  double least = INFINITY;
  for (auto const* row : rows)
    if (double const mean = sign * interval(values_of(row->figures, figure)).mean; mean < least) {
      least = mean;
      best = row;
    }
  return best;
}

std::string figure_text(Combination const& row, std::string const& figure, std::string const& unit) {
  return fmt::format("{} {}", text_of(interval(values_of(row.figures, figure)), 3), unit);
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
  auto const* paper = best_of(papers_of(rows), figure);
  if (paper && paper != best)
    words.push_back(fmt::format(
        "best of the papers' selections and models: {}, {}; the ratio to it is {}", paper->name(),
        figure_text(*paper, figure, unit),
        text_of(interval(ratio_of_means(values_of(best->figures, figure), values_of(paper->figures, figure))), 3)));
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

Rows rows_in(std::vector<Combination> const& rows, std::string_view world) {
  Rows found;
  for (auto const& row : rows)
    if (row.world == world && row.refused.empty()) found.push_back(&row);
  return found;
}

/// The row that a claim names, or none: it is refused.
Combination const* named_row(Rows const& rows, std::string const& name, std::string const& figure) {
  if (name == chosen_by_validation) return best_of(rows, "validation.rmse");
  if (name == best_of_papers) return best_of(papers_of(rows), figure);
  auto const it = std::find_if(rows.begin(), rows.end(), [&](auto const* row) { return row->name() == name; });
  return it == rows.end() ? nullptr : *it;
}

/// The values of a claim's figure in both rows, repetition by repetition.
struct Compared {
  std::string name, than;
  std::vector<double> values, others;
};

/// How far a claim is on the right side, in every repetition, and in words.
struct Margin {
  std::vector<double> values;
  std::string words;
};

Margin below(double limit, Compared const& compared) {
  Margin margin{{}, fmt::format(", against {:g}", limit)};
  for (double const x : compared.values) margin.values.push_back(limit - x);
  return margin;
}

std::string other_text(Compared const& compared) {
  return fmt::format(", of {}: {}; ", compared.than, text_of(interval(compared.others), 3));
}

Margin within_share(double share, Compared const& compared) {
  auto const own = ratio_of_means(compared.values, compared.others);
  Margin margin{{}, other_text(compared) + fmt::format("{} of it, against {:g}", text_of(interval(own), 3), share)};
  for (double const ratio : own) margin.values.push_back(share - ratio);
  return margin;
}

/// Better by `improvement`, or worse by `tolerance` at most [%]; better is less, where more is not.
Margin better_than(StudyClaim const& claim, Compared const& compared) {
  bool const more = more_is_better(claim.figure);
  double const sign = more ? -1.0 : 1.0;
  double const share = 0.01 * (claim.improvement.value_or(0.0) - claim.tolerance.value_or(0.0));
  double const whole = std::abs(interval(compared.others).mean);
  Margin margin;
  std::vector<double> gains;
  for (std::size_t r = 0; r < std::min(compared.values.size(), compared.others.size()); ++r) {
    double const gain = sign * (compared.others[r] - compared.values[r]);
    gains.push_back(100.0 * gain / whole);
    margin.values.push_back(gain - share * std::abs(compared.others[r]));
  }
  margin.words = fmt::format("{}{} % {}", other_text(compared), text_of(interval(gains), 1), more ? "more" : "less");
  if (claim.improvement) margin.words += fmt::format(", against {:g} %", *claim.improvement);
  if (claim.tolerance)
    margin.words += fmt::format(", against {:g} % {} at most", *claim.tolerance, more ? "less" : "more");
  return margin;
}

/// "; did you mean 'cross.rmse'?", of a combination that has others.
std::string nearest_figure(std::string const& figure, Figures const& known) {
  std::vector<std::string> names;
  for (auto const& [name, values] : known) names.push_back(name);
  return names.empty() || known.contains(figure) ? "" : "; " + thermal::did_you_mean(figure, names);
}

ClaimVerdict judged_claim(StudyReport const& report, StudyClaim const& claim) {
  auto const world = claim.world.empty() ? report.description.worlds.front().name : claim.world;
  auto const rows = rows_in(world == mean_of_worlds ? report.means : report.rows, world);
  auto const* row = named_row(rows, claim.combination, claim.figure);
  auto const* other = claim.than.empty() ? nullptr : named_row(rows, claim.than, claim.figure);
  Compared compared;
  Figures known;
  if (row) {
    known = figures_of(report, *row);
    compared = {row->name(), "", values_of(known, claim.figure), {}};
  }
  if (other) {
    compared.than = claim.than == best_of_papers ? fmt::format("{} ({})", other->name(), claim.than) : other->name();
    compared.others = values_of(figures_of(report, *other), claim.figure);
  }
  auto const margin = claim.at_most ? below(*claim.at_most, compared)
                      : claim.share ? within_share(*claim.share, compared)
                                    : better_than(claim, compared);
  if (margin.values.empty())
    return {claim, world, ClaimVerdict::Answer::refused,
            fmt::format("there is no '{}' of these combinations in '{}'{}", claim.figure, world,
                        nearest_figure(claim.figure, known))};
  auto const of = interval(margin.values);
  return {claim, world, answer_of(of, claim.at_most || claim.tolerance || claim.share),
          fmt::format("{} of {}: {}{}{}", claim.figure, compared.name, text_of(interval(compared.values), 3),
                      margin.words, of.values == 1 ? " (one repetition, no interval)" : "")};
}

}  // namespace

void put_verdict(StudyReport& report) {
  for (std::size_t w = 0; w < report.units.size(); ++w) {
    auto const& world = report.description.worlds[w].name;
    for (auto const& sentence : sentences(rows_in(report.rows, world), report.units[w]))
      report.verdict.push_back(world + ": " + sentence);
  }
  if (auto const means = rows_in(report.means, mean_of_worlds); !means.empty())
    for (auto const& sentence : sentences(means, report.units.front()))
      report.verdict.push_back(fmt::format("{}: {}", mean_of_worlds, sentence));
  for (auto const& claim : report.description.claims) report.claims.push_back(judged_claim(report, claim));
}

}  // namespace thermotwin::twin
