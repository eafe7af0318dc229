#include "models/distinguishing.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Set = std::vector<Index>;

constexpr std::size_t starts = 12;
constexpr double least_gain = 1e-9, least_sine_squared = 1e-9;

/// sin² of the angle of every pair under a Gram matrix.
Eigen::ArrayXd sines_squared(Signatures const& signatures, MatrixXd const& gram) {
  Eigen::ArrayXd sines(Index(signatures.pairs.size()));
  for (std::size_t p = 0; p < signatures.pairs.size(); ++p) {
    auto const [a, b] = signatures.pairs[p];
    double const sizes = gram(a, a) * gram(b, b);
    sines[Index(p)] = sizes > 0.0 ? std::clamp(1.0 - gram(a, b) * gram(a, b) / sizes, 0.0, 1.0) : 0.0;
  }
  return sines;
}

MatrixXd gram_of(Signatures const& signatures, std::span<Index const> sensors) {
  MatrixXd sum = MatrixXd::Zero(signatures.gram.front().rows(), signatures.gram.front().cols());
  for (auto const site : sensors) sum += signatures.gram[std::size_t(site)];
  return sum;
}

double smallest(Signatures const& signatures, MatrixXd const& gram) {
  return sines_squared(signatures, gram).minCoeff();
}

double crowding(Signatures const& signatures, MatrixXd const& gram) {
  return (sines_squared(signatures, gram) + least_sine_squared).inverse().sum();
}

/// The site that makes `value` of the enlarged Gram matrix largest, among those that the budget allows; −1: none.
template <class Value>
std::pair<Index, double> best_partner(Signatures const& signatures, Prices const& prices, Set const& set,
                                      Value const& value) {
  MatrixXd const gram = gram_of(signatures, set);
  double left = prices.budget;
  for (auto const site : set) left -= prices.cost_of(site);
  std::pair<Index, double> best{-1, 0.0};
  for (Index i = 0; i < Index(signatures.gram.size()); ++i) {
    if (prices.cost_of(i) > left || std::find(set.begin(), set.end(), i) != set.end()) continue;
    double const with = value(signatures, gram + signatures.gram[std::size_t(i)]);
    if (best.first < 0 || with > best.second) best = {i, with};
  }
  return best;
}

/// Greedy from a first site.
Set grown(Signatures const& signatures, Prices const& prices, Index first, Index count) {
  auto const apart = [](Signatures const& all, MatrixXd const& gram) { return -crowding(all, gram); };
  Set set = {first};
  while (Index(set.size()) < count) {
    auto const site = best_partner(signatures, prices, set, apart).first;
    if (site < 0) break;
    set.push_back(site);
  }
  return set;
}

/// Improved by exchanges, and by one more site where a cheaper one leaves room for it.
Set exchanged(Signatures const& signatures, Prices const& prices, Set set, Index count) {
  double value = smallest(signatures, gram_of(signatures, set));
  for (bool better = true; better;) {
    better = false;
    for (std::size_t k = 0; k < set.size(); ++k) {
      Set rest = set;
      rest.erase(rest.begin() + std::ptrdiff_t(k));
      auto const [site, with] = best_partner(signatures, prices, rest, smallest);
      if (with <= value * (1.0 + least_gain)) continue;
      set[k] = site;
      value = with;
      better = true;
    }
    if (Index(set.size()) == count) continue;
    auto const [site, with] = best_partner(signatures, prices, set, smallest);
    if (with <= value * (1.0 + least_gain)) continue;
    set.push_back(site);
    value = with;
    better = true;
  }
  return set;
}

}  // namespace

Eigen::VectorXd angles(Signatures const& signatures, std::span<Index const> sensors) {
  return sines_squared(signatures, gram_of(signatures, sensors)).sqrt().asin();
}

Closest closest_pair(Signatures const& signatures, std::span<Index const> sensors) {
  if (signatures.pairs.empty()) throw std::invalid_argument("there are no two effects to tell apart");
  Index pair = 0;
  double const angle = angles(signatures, sensors).minCoeff(&pair);
  return {angle, std::size_t(pair)};
}

Set place_to_distinguish(Signatures const& signatures, Index count, Prices const& prices) {
  auto const sites = Index(signatures.gram.size());
  if (count < 1 || count > sites) throw std::invalid_argument(fmt::format("{} sensors for {} sites", count, sites));
  if (signatures.pairs.empty()) throw std::invalid_argument("there are no two effects to tell apart");
  std::vector<std::pair<double, Index>> first;
  for (Index i = 0; i < sites; ++i)
    if (prices.cost_of(i) <= prices.budget)
      first.emplace_back(prices.cost_of(i) * crowding(signatures, signatures.gram[std::size_t(i)]), i);
  if (first.empty()) throw std::invalid_argument(fmt::format("the budget of {} buys no sensor at all", prices.budget));
  std::sort(first.begin(), first.end());
  first.resize(std::min(first.size(), starts));
  std::vector<Set> sets(first.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t s = 0; s < sets.size(); ++s)
    sets[s] = exchanged(signatures, prices, grown(signatures, prices, first[s].second, count), count);
  return *std::max_element(sets.begin(), sets.end(), [&](Set const& a, Set const& b) {
    return smallest(signatures, gram_of(signatures, a)) < smallest(signatures, gram_of(signatures, b));
  });
}

}  // namespace thermotwin::models
