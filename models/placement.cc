#include "models/placement.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "models/subsets.h"

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Set = std::vector<Index>;

constexpr Index most_starts = 200, fewest_starts = 40, most_polished = 24, fewest_polished = 2;
constexpr Index most_sites_for_pairs = 300;
constexpr double least_progress = 1e-10;  // of an exchange, relative
constexpr double intact_share = 1e-3;     // of the intact set's V in a robust objective: settles ties

Set without(Set const& set, Set const& positions) {
  Set rest;
  for (std::size_t i = 0; i < set.size(); ++i)
    if (std::find(positions.begin(), positions.end(), Index(i)) == positions.end()) rest.push_back(set[i]);
  return rest;
}

double cost_of(PlacementProblem const& problem, Set const& set) {
  return std::accumulate(set.begin(), set.end(), 0.0,
                         [&](double sum, Index site) { return sum + problem.cost_of(site); });
}

RemainingVariance state_of(PlacementProblem const& problem, Set const& set, Index room = 0) {
  RemainingVariance state(problem, std::max(room, Index(set.size())));
  for (auto const site : set) state.add(site);
  return state;
}

/// The objective and how it changes with one site more.
class Search {
 public:
  Search(PlacementProblem const& problem, Index count, Index dead) : problem_(problem), count_(count), dead_(dead) {}

  /// Greedy, given the first sites.
  [[nodiscard]] Set grown(Set set, bool per_cost) const;
  /// Improved by exchanges.
  [[nodiscard]] Set exchanged(Set set) const;
  /// Improved by exchanges of two sensors at once as well; of an intact set.
  [[nodiscard]] Set polished(Set set) const;
  [[nodiscard]] double objective(Set const& set) const;

 private:
  struct Choice {
    Index site;
    double objective;
  };
  /// The best site to join a set, among those that the budget allows.
  [[nodiscard]] std::optional<Choice> best_partner(Set const& set) const;
  /// The best two to join a set, if that is better than `value`.
  [[nodiscard]] std::optional<std::pair<Set, double>> best_pair(Set const& set, double value) const;
  /// The objective with each site joined.
  [[nodiscard]] Eigen::VectorXd objectives(Set const& set) const;

  PlacementProblem const& problem_;
  Index count_, dead_;
};

double Search::objective(Set const& set) const {
  double const intact = remaining_variance(problem_, set);
  return dead_ == 0 ? intact : worst_variance(problem_, set, dead_) + intact_share * intact;
}

/// A failure either spares the site that joins, or takes it.
Eigen::VectorXd Search::objectives(Set const& set) const {
  auto const after_joining = [](RemainingVariance const& state) {
    return Eigen::VectorXd(state.value() - state.gains().array());
  };
  Eigen::VectorXd const intact = after_joining(state_of(problem_, set));
  auto const size = Index(set.size());
  if (dead_ == 0) return intact;
  Eigen::VectorXd worst = Eigen::VectorXd::Zero(problem_.sites());
  if (size >= dead_)
    for_each_subset(size, dead_, [&](Set const& lost) {
      worst = worst.cwiseMax(after_joining(state_of(problem_, without(set, lost))));
    });
  for_each_subset(size, std::min(size, dead_ - 1),
                  [&](Set const& lost) { worst = worst.cwiseMax(remaining_variance(problem_, without(set, lost))); });
  return worst + intact_share * intact;
}

std::optional<Search::Choice> Search::best_partner(Set const& set) const {
  Eigen::VectorXd const values = objectives(set);
  double const left = problem_.budget - cost_of(problem_, set);
  std::optional<Choice> best;
  for (Index i = 0; i < values.size(); ++i)
    if (problem_.cost_of(i) <= left && std::find(set.begin(), set.end(), i) == set.end() &&
        (!best || values[i] < best->objective))
      best = {i, values[i]};
  return best;
}

Set Search::grown(Set set, bool per_cost) const {
  auto state = RemainingVariance(problem_, count_);
  for (auto const site : set) state.add(site);
  double left = problem_.budget - cost_of(problem_, set);
  while (Index(set.size()) < count_) {
    Index best = -1;
    double most = -1.0;
    for (Index i = 0; i < problem_.sites(); ++i) {
      double const gain = state.gains()[i] / (per_cost ? problem_.cost_of(i) : 1.0);
      if (state.gains()[i] >= 0.0 && problem_.cost_of(i) <= left && gain > most) best = i, most = gain;
    }
    if (best < 0) break;
    state.add(best);
    set.push_back(best);
    left -= problem_.cost_of(best);
  }
  return set;
}

Set Search::exchanged(Set set) const {
  double value = objective(set);
  for (bool better = true; better;) {
    better = false;
    for (std::size_t k = 0; k < set.size(); ++k) {
      Set rest = set;
      rest.erase(rest.begin() + std::ptrdiff_t(k));
      auto const choice = best_partner(rest);
      if (!choice || choice->objective >= value * (1.0 - least_progress)) continue;
      set[k] = choice->site;
      value = choice->objective;
      better = true;
    }
    if (Index(set.size()) == count_) continue;
    if (auto const choice = best_partner(set); choice && choice->objective < value * (1.0 - least_progress)) {
      set.push_back(choice->site);
      value = choice->objective;
      better = true;
    }
  }
  return set;
}

std::optional<std::pair<Set, double>> Search::best_pair(Set const& set, double value) const {
  auto const base = state_of(problem_, set, count_);
  double const left = problem_.budget - cost_of(problem_, set);
  std::optional<std::pair<Set, double>> best;
  for (Index i = 0; i < problem_.sites(); ++i) {
    if (base.gains()[i] < 0.0 || problem_.cost_of(i) > left) continue;
    auto state = base;
    state.add(i);
    for (Index j = i + 1; j < problem_.sites(); ++j) {
      double const with_both = state.value() - state.gains()[j];
      if (state.gains()[j] < 0.0 || problem_.cost_of(i) + problem_.cost_of(j) > left || with_both >= value) continue;
      value = with_both;
      best = {{i, j}, value};
    }
  }
  return best;
}

Set Search::polished(Set set) const {
  double value = objective(set);
  for (bool better = true; better;) {
    better = false;
    for_each_subset(Index(set.size()), std::min<Index>(2, Index(set.size())), [&](Set const& pair) {
      if (pair.size() < 2) return;
      auto const choice = best_pair(without(set, pair), value * (1.0 - least_progress));
      if (!choice) return;
      for (std::size_t k = 0; k < 2; ++k) set[std::size_t(pair[k])] = choice->first[k];
      value = choice->second;
      better = true;
    });
    set = exchanged(set);
    value = objective(set);
  }
  return set;
}

/// Every world makes each step as much dearer.
Index effort(PlacementProblem const& problem, Index fewest, Index most) {
  return std::max(fewest, most / Index(problem.worlds.size()));
}

/// What greedy starts from: single sites, then pairs while there is room, those that tell most first.
std::vector<Set> starts_of(PlacementProblem const& problem, Index count) {
  RemainingVariance const none(problem, 1);
  Index const most = effort(problem, fewest_starts, most_starts);
  std::vector<std::pair<double, Set>> single, pairs;
  for (Index i = 0; i < problem.sites(); ++i)
    if (problem.cost_of(i) <= problem.budget) single.push_back({-none.gains()[i], {i}});
  if (count > 1 && Index(single.size()) < most)
    for (auto const& [gain, site] : single) {
      auto state = none;
      state.add(site[0]);
      for (Index j = site[0] + 1; j < problem.sites(); ++j)
        if (problem.cost_of(site[0]) + problem.cost_of(j) <= problem.budget)
          pairs.push_back({gain - state.gains()[j], {site[0], j}});
    }
  std::vector<Set> starts;
  for (auto* kind : {&single, &pairs}) {
    std::sort(kind->begin(), kind->end());
    for (auto& [gain, set] : *kind)
      if (Index(starts.size()) < most) starts.push_back(std::move(set));
  }
  return starts;
}

void check(PlacementProblem const& problem, Index count, Index dead) {
  check(problem);
  if (count < 1) throw std::invalid_argument(fmt::format("{} sensors; at least one is due", count));
  if (count > problem.sites())
    throw std::invalid_argument(fmt::format("{} sensors, but only {} sites for them", count, problem.sites()));
  if (dead < 0 || dead >= count)
    throw std::invalid_argument(fmt::format("{} of {} sensors dead; at least one must be left", dead, count));
  if (starts_of(problem, 1).empty())
    throw std::invalid_argument(fmt::format("the budget of {} buys no sensor at all", problem.budget));
}

Placement finished(PlacementProblem const& problem, Set const& set) {
  return {by_information(problem, set), remaining_variance(problem, set)};
}

/// Leaves the sets of smallest objective, each once, the best first.
void keep_best(std::vector<Set>& sets, Search const& search, Index most) {
  for (auto& set : sets) std::sort(set.begin(), set.end());
  std::sort(sets.begin(), sets.end());
  sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
  std::vector<std::pair<double, Set>> valued;
  for (auto& set : sets) valued.emplace_back(search.objective(set), std::move(set));
  std::sort(valued.begin(), valued.end());
  sets.clear();
  for (auto& [value, set] : valued)
    if (Index(sets.size()) < most) sets.push_back(std::move(set));
}

/// All sets of so many sites, and of fewer where a budget may end first; depth first.
class Enumeration {
 public:
  Enumeration(PlacementProblem const& problem, Index count) : problem_(problem), count_(count) {}

  Set operator()() {
    descend(RemainingVariance(problem_, count_), 0, problem_.budget);
    return best_;
  }

 private:
  void keep(double value) {
    if (value < value_) value_ = value, best_ = set_;
  }
  void descend(RemainingVariance const& state, Index from, double budget) {
    bool const last = Index(set_.size()) + 1 == count_;
    Index const wanting = count_ - Index(set_.size()) - 1;  // beside the next one
    Index const end = std::isfinite(problem_.budget) ? problem_.sites() : problem_.sites() - wanting;
    for (Index i = from; i < end; ++i) {
      if (problem_.cost_of(i) > budget) continue;
      set_.push_back(i);
      keep(state.value() - state.gains()[i]);
      if (!last) {
        RemainingVariance next = state;
        next.add(i);
        descend(next, i + 1, budget - problem_.cost_of(i));
      }
      set_.pop_back();
    }
  }

  PlacementProblem const& problem_;
  Index count_;
  Set set_, best_;
  double value_ = std::numeric_limits<double>::infinity();
};

}  // namespace

double worst_variance(PlacementProblem const& problem, std::span<Index const> sensors, Index dead) {
  Set const set(sensors.begin(), sensors.end());
  double worst = 0.0;
  for_each_subset(Index(set.size()), std::min(dead, Index(set.size())),
                  [&](Set const& lost) { worst = std::max(worst, remaining_variance(problem, without(set, lost))); });
  return worst;
}

std::vector<Index> by_information(PlacementProblem const& problem, std::span<Index const> sensors) {
  RemainingVariance state(problem, Index(sensors.size()));
  Set left(sensors.begin(), sensors.end()), ordered;
  std::sort(left.begin(), left.end());
  while (!left.empty()) {
    auto const next = std::max_element(left.begin(), left.end(),
                                       [&](Index a, Index b) { return state.gains()[a] < state.gains()[b]; });
    ordered.push_back(*next);
    state.add(*next);
    left.erase(next);
  }
  return ordered;
}

double number_of_sets(Index sites, Index count) {
  double number = 1.0;
  for (Index k = 0; k < count; ++k) number *= double(sites - k) / double(k + 1);
  return number;
}

Placement place(PlacementProblem const& problem, Index count, Index dead) {
  check(problem, count, dead);
  auto const starts = starts_of(problem, count);
  bool const priced = std::isfinite(problem.budget);
  Search const intact(problem, count, 0), robust(problem, count, dead);
  std::vector<Set> grown(starts.size() * (priced ? 2 : 1)), sets(grown.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t s = 0; s < sets.size(); ++s) {
    grown[s] = intact.grown(starts[s % starts.size()], s >= starts.size());
    sets[s] = intact.exchanged(grown[s]);
  }
  auto const most = effort(problem, fewest_polished, most_polished);
  keep_best(sets, intact, most);
  if (problem.sites() <= most_sites_for_pairs) {
#pragma omp parallel for schedule(dynamic)
    for (auto& set : sets) set = intact.polished(set);
  }
  if (dead > 0) {
    keep_best(grown, robust, most);
    sets.insert(sets.end(), grown.begin(), grown.end());
#pragma omp parallel for schedule(dynamic)
    for (auto& set : sets) set = robust.exchanged(set);
  }
  keep_best(sets, robust, 1);
  return finished(problem, sets.front());
}

Placement exhaustive_placement(PlacementProblem const& problem, Index count) {
  check(problem, count, 0);
  return finished(problem, Enumeration(problem, count)());
}

}  // namespace thermotwin::models
