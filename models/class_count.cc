#include "models/class_count.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numeric>

namespace thermotwin::models {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

double bend(VectorXd const& loss, int k) { return loss(k - 2) - 2 * loss(k - 1) + loss(k); }

bool significant(ClassCountTrial const& trial, ImprovedRule const& rule) {
  return trial.obstacle.empty() && trial.regression.p_F < rule.significance &&
         trial.regression.p.maxCoeff() < rule.significance;
}

bool improves(LinearRegression const& more, LinearRegression const& fewer, ImprovedRule const& rule) {
  double const still = 1 - rule.residual_fall;
  return more.r_squared - fewer.r_squared > rule.r_squared_rise &&
         more.residual_deviation < still * fewer.residual_deviation &&
         more.largest_residual < still * fewer.largest_residual;
}

std::string figures(ClassCountTrial const& trial) {
  if (!trial.obstacle.empty()) return fmt::format("k = {}: {}", trial.k, trial.obstacle);
  auto const& fit = trial.regression;
  return fmt::format(
      "k = {}: p_F {:.2g}, R2 {:.5f}, deviation {:.3g} um, largest {:.3g} um, largest p_t {:.2g} (HAC {:.2g})", trial.k,
      fit.p_F, fit.r_squared, fit.residual_deviation, fit.largest_residual, fit.p.maxCoeff(), fit.hac_p.maxCoeff());
}

std::string all_figures(std::vector<ClassCountTrial> const& trials) {
  std::vector<std::string> lines;
  for (auto const& trial : trials) lines.push_back(figures(trial));
  return fmt::format("{}", fmt::join(lines, "; "));
}

/// From the first eligible trial to the next whenever that improves.
template <typename Eligible>
std::optional<std::size_t> walk(std::vector<ClassCountTrial> const& trials, ImprovedRule const& rule,
                                Eligible const& eligible) {
  std::optional<std::size_t> reached;
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (eligible(trials[i]) && (!reached || improves(trials[i].regression, trials[*reached].regression, rule)))
      reached = i;
  return reached;
}

}  // namespace

VectorXd loss_ratios(VectorXd const& loss) {
  VectorXd ratios(loss.size() - 1);
  for (Index i = 0; i < ratios.size(); ++i) ratios(i) = loss(i) > 0 ? loss(i) / loss(i + 1) : 1.0;
  return ratios;
}

VectorXd loss_slopes(VectorXd const& loss) { return loss.head(loss.size() - 1) - loss.tail(loss.size() - 1); }

std::vector<int> bends(VectorXd const& loss, double threshold, int most) {
  auto const objects = static_cast<int>(loss.size());
  if (objects <= 2) return {objects};
  std::vector<int> candidates(static_cast<std::size_t>(objects - 2));
  std::iota(candidates.begin(), candidates.end(), 2);
  std::stable_sort(candidates.begin(), candidates.end(), [&](int a, int b) { return bend(loss, a) > bend(loss, b); });
  auto const weak = std::find_if(candidates.begin() + 1, candidates.end(),
                                 [&](int k) { return !(bend(loss, k) > threshold * loss(0)); });
  candidates.erase(weak, candidates.end());
  candidates.resize(std::min(candidates.size(), static_cast<std::size_t>(most)));
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

int count_by_slope(VectorXd const& loss, std::vector<int> const& candidates) {
  VectorXd const slopes = loss_slopes(loss);
  auto const slope = [&](int k) { return k < 2 ? 0.0 : slopes(k - 2); };
  return *std::max_element(candidates.begin(), candidates.end(), [&](int a, int b) { return slope(a) < slope(b); });
}

std::vector<int> counts_by_ratio(VectorXd const& loss, std::vector<int> const& candidates) {
  VectorXd const ratios = loss_ratios(loss);
  auto const help = [&](int k) { return k < 2 ? 0.0 : ratios(k - 2); };
  std::vector<int> order = candidates;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return help(a) > help(b); });
  return order;
}

Evidence evidence_of(ClassCountTrial const& trial) {
  Evidence evidence{fmt::format("k = {}", trial.k), {}};
  if (!trial.obstacle.empty()) return evidence;
  auto const& fit = trial.regression;
  evidence.figures = {{"p_F", fit.p_F},
                      {"p_t", fit.p.maxCoeff()},
                      {"p_t_autocorrelated", fit.hac_p.maxCoeff()},
                      {"r_squared", fit.r_squared},
                      {"residual_deviation", fit.residual_deviation},
                      {"largest_residual", fit.largest_residual}};
  return evidence;
}

ClassCountVerdict count_by_regression(std::vector<ClassCountTrial> const& trials, ImprovedRule const& rule) {
  auto const passes = [&](ClassCountTrial const& trial) { return significant(trial, rule); };
  auto const has_regression = [](ClassCountTrial const& trial) { return trial.obstacle.empty(); };
  auto const reached = walk(trials, rule, passes);
  if (reached) return {reached, true, all_figures(trials)};
  return {walk(trials, rule, has_regression), false, all_figures(trials)};
}

}  // namespace thermotwin::models
