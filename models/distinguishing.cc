#include "models/distinguishing.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

#include "models/placement.h"

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Set = std::vector<Index>;

constexpr std::size_t starts = 12;
constexpr double least_gain = 1e-9, least_sine_squared = 1e-9;

/// sin² of the angle between two signatures, from their squares and their inner product.
double sine_squared_of(double first, double second, double shared) {
  double const sizes = first * second;
  return sizes > 0.0 ? std::clamp(1.0 - shared * shared / sizes, 0.0, 1.0) : 0.0;
}

/// Of every pair under a Gram matrix.
Eigen::ArrayXd sines_squared(Signatures const& signatures, MatrixXd const& gram) {
  Eigen::ArrayXd sines(Index(signatures.pairs.size()));
  for (std::size_t p = 0; p < signatures.pairs.size(); ++p) {
    auto const [a, b] = signatures.pairs[p];
    sines[Index(p)] = sine_squared_of(gram(a, a), gram(b, b), gram(a, b));
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

/// Looks at sets one by one, each only until a pair is as close as in the best set so far; pairs that have ruled out
/// others come first.
class WidestSet {
 public:
  WidestSet(Signatures const& signatures, Prices const& prices, Index count, Set first)
      : signatures_(signatures),
        prices_(prices),
        count_(count),
        order_(signatures.pairs),
        best_(std::move(first)),
        widest_(smallest(signatures, gram_of(signatures, best_))) {}

  [[nodiscard]] Set operator()() {
    extend(0, prices_.budget);
    return best_;
  }

 private:
  /// By every set of sites from `next` on that what is left of the budget buys.
  void extend(Index next, double left);
  void look_at_set();
  [[nodiscard]] double sine_squared(std::pair<Index, Index> const& pair) const;

  Signatures const& signatures_;
  Prices const& prices_;
  Index count_;
  std::vector<std::pair<Index, Index>> order_;
  Set set_, best_;
  double widest_;  ///< sin² of its smallest angle
};

void WidestSet::extend(Index next, double left) {
  bool const fewer_will_do = std::isfinite(prices_.budget), full = Index(set_.size()) == count_;
  if (full || (fewer_will_do && !set_.empty())) look_at_set();
  if (full) return;
  Index const sites = Index(signatures_.gram.size()), due = count_ - Index(set_.size());
  for (Index site = next; site < sites && (fewer_will_do || sites - site >= due); ++site) {
    if (prices_.cost_of(site) > left) continue;
    set_.push_back(site);
    extend(site + 1, left - prices_.cost_of(site));
    set_.pop_back();
  }
}

void WidestSet::look_at_set() {
  double least = 1.0;
  for (std::size_t p = 0; p < order_.size(); ++p) {
    least = std::min(least, sine_squared(order_[p]));
    if (least > widest_) continue;
    std::swap(order_[p], order_[p / 2]);
    return;
  }
  best_ = set_;
  widest_ = least;
}

double WidestSet::sine_squared(std::pair<Index, Index> const& pair) const {
  auto const [a, b] = pair;
  double first = 0.0, second = 0.0, shared = 0.0;
  for (auto const site : set_) {
    auto const& gram = signatures_.gram[std::size_t(site)];
    first += gram(a, a);
    second += gram(b, b);
    shared += gram(a, b);
  }
  return sine_squared_of(first, second, shared);
}

void check(Signatures const& signatures, Index count) {
  auto const sites = Index(signatures.gram.size());
  if (count < 1 || count > sites) throw std::invalid_argument(fmt::format("{} sensors for {} sites", count, sites));
  if (signatures.pairs.empty()) throw std::invalid_argument("there are no two effects to tell apart");
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
  check(signatures, count);
  std::vector<std::pair<double, Index>> first;
  for (Index i = 0; i < Index(signatures.gram.size()); ++i)
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

Set widest_of_all_sets(Signatures const& signatures, Index count, Prices const& prices) {
  return WidestSet(signatures, prices, count, place_to_distinguish(signatures, count, prices))();
}

double number_of_sets(Index sites, Index count, Prices const& prices) {
  double number = number_of_sets(sites, count);
  for (Index fewer = 1; fewer < count && std::isfinite(prices.budget); ++fewer) number += number_of_sets(sites, fewer);
  return number;
}

}  // namespace thermotwin::models
