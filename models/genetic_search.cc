#include "models/genetic_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "models/uniform_draw.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int bits = 16;
constexpr double largest_gene = std::numeric_limits<std::uint16_t>::max();

struct Individual {
  Chromosome chromosome;
  double fitness = 0;
};

bool fitter(Individual const& a, Individual const& b) { return a.fitness > b.fitness; }

class Population {
 public:
  Population(Index numbers, std::function<double(VectorXd const&)> const& fitness, std::uint64_t seed,
             GeneticOptions const& options)
      : fitness_(fitness), random_(seed), options_(options) {
    for (int i = 0; i < options.population; ++i) {
      Chromosome chromosome(static_cast<std::size_t>(numbers));
      for (auto& gene : chromosome) gene = static_cast<std::uint16_t>(random_() >> (64U - bits));
      members_.push_back(judged(std::move(chromosome)));
    }
    std::stable_sort(members_.begin(), members_.end(), fitter);
  }

  [[nodiscard]] Individual const& best() const { return members_.front(); }

  void breed() {
    std::vector<Individual> next(members_.begin(), members_.begin() + options_.elite);
    while (next.size() < members_.size()) {
      Chromosome a = parent().chromosome, b = parent().chromosome;
      if (uniform_draw(random_) < options_.crossover) cross(a, b);
      for (auto* child : {&a, &b}) {
        if (next.size() == members_.size()) break;
        mutate(*child);
        next.push_back(judged(std::move(*child)));
      }
    }
    std::stable_sort(next.begin(), next.end(), fitter);
    members_ = std::move(next);
  }

 private:
  /// Children are often what was there before: neither mixed nor mutated, or of like parents.
  Individual judged(Chromosome chromosome) {
    auto const [known, fresh] = judged_.try_emplace(chromosome, 0.0);
    if (fresh) known->second = fitness_(decode(chromosome, options_));
    return {std::move(chromosome), known->second};
  }

  /// Members are sorted: the smallest of some drawn numbers is the fittest.
  Individual const& parent() {
    std::size_t winner = members_.size();
    for (int i = 0; i < options_.tournament; ++i) winner = std::min(winner, index_draw(random_, members_.size()));
    return members_[winner];
  }

  void cross(Chromosome& a, Chromosome& b) {
    auto const point = 1 + index_draw(random_, a.size() * bits - 1);
    auto const gene = point / bits;
    auto const tail = static_cast<std::uint16_t>((1U << (bits - point % bits)) - 1U);
    auto const swapped = static_cast<std::uint16_t>((a[gene] ^ b[gene]) & tail);
    a[gene] ^= swapped;
    b[gene] ^= swapped;
    std::swap_ranges(a.begin() + static_cast<std::ptrdiff_t>(gene) + 1, a.end(),
                     b.begin() + static_cast<std::ptrdiff_t>(gene) + 1);
  }

  void mutate(Chromosome& chromosome) {
    for (auto& gene : chromosome)
      if (uniform_draw(random_) < options_.mutation)
        gene = static_cast<std::uint16_t>(gene ^ (1U << index_draw(random_, bits)));
  }

  std::function<double(VectorXd const&)> const& fitness_;
  std::mt19937_64 random_;
  GeneticOptions options_;
  std::vector<Individual> members_;  ///< fittest first
  std::map<Chromosome, double> judged_;
};

}  // namespace

VectorXd decode(Chromosome const& chromosome, GeneticOptions const& options) {
  return VectorXd::NullaryExpr(static_cast<Index>(chromosome.size()), [&](Index i) {
    return options.low + (options.high - options.low) * chromosome[static_cast<std::size_t>(i)] / largest_gene;
  });
}

Chromosome encode(VectorXd const& numbers, GeneticOptions const& options) {
  Chromosome chromosome;
  for (double const number : numbers) {
    double const gene = std::round((number - options.low) / (options.high - options.low) * largest_gene);
    chromosome.push_back(static_cast<std::uint16_t>(std::clamp(gene, 0.0, largest_gene)));
  }
  return chromosome;
}

GeneticSearch genetic_search(Index numbers, std::function<double(VectorXd const&)> const& fitness, std::uint64_t seed,
                             GeneticOptions const& options) {
  Population population(numbers, fitness, seed, options);
  GeneticSearch search;
  for (int generation = 0; generation <= options.generations; ++generation) {
    if (generation > 0) population.breed();
    search.best.push_back(decode(population.best().chromosome, options));
    search.fitness.push_back(population.best().fitness);
  }
  return search;
}

}  // namespace thermotwin::models
