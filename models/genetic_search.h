#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

namespace thermotwin::models {

/// A binary string: 16 bits for each gene.
using Chromosome = std::vector<std::uint16_t>;

/// Genetic search with tournament selection, single-point crossover and elitism (Goldberg 1989). Population 100 is
/// paper 003's; the rest is not stated there (methods.md §6.3).
struct GeneticOptions {
  int population = 100;
  int generations = 200;
  double crossover = 0.7;     ///< probability that two parents mix; the point may lie within a gene
  double mutation = 0.01;     ///< probability that a gene has one of its bits turned
  int elite = 2;              ///< best ones that live on unchanged
  int tournament = 3;         ///< how many compete to become a parent
  double low = -1, high = 1;  ///< range of each number
};

/// w = low + (high − low) gene/(2¹⁶ − 1), and the nearest gene of a number; numbers beyond the range go to its ends.
Eigen::VectorXd decode(Chromosome const& chromosome, GeneticOptions const& options = {});
Chromosome encode(Eigen::VectorXd const& numbers, GeneticOptions const& options = {});

/// The course of a search: its fittest one in each generation, the first included.
struct GeneticSearch {
  std::vector<Eigen::VectorXd> best;
  std::vector<double> fitness;  ///< never falls
};

/// Looks for the vector of `numbers` numbers with the largest fitness.
GeneticSearch genetic_search(Eigen::Index numbers, std::function<double(Eigen::VectorXd const&)> const& fitness,
                             std::uint64_t seed, GeneticOptions const& options = {});

}  // namespace thermotwin::models
