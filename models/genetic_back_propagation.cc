#include "models/genetic_back_propagation.h"

#include <fmt/format.h>

#include "models/back_propagation.h"
#include "models/genetic_search.h"
#include "models/network.h"

namespace thermotwin::models {

namespace {

constexpr std::size_t generations_between_starts = 50;
constexpr int trial_epochs = 500;

/// Its epochs are those of all descents.
Descent lowest_descent(NetworkLoss& loss, GeneticSearch const& search) {
  Descent lowest;
  int epochs = 0;
  for (std::size_t generation = 0; generation < search.best.size(); generation += generations_between_starts) {
    auto found = descend(loss, search.best[generation], {.epochs = trial_epochs});
    epochs += found.epochs;
    if (generation == 0 || found.loss < lowest.loss) lowest = std::move(found);
  }
  lowest = descend(loss, lowest.parameters, {.epochs = network_epochs - epochs});
  lowest.epochs += epochs;
  return lowest;
}

}  // namespace

ErrorModel fit_genetic_back_propagation(std::span<Batch const> batches, FitOptions const& options) {
  NetworkSamples const samples(batches);
  auto loss = samples.loss();
  auto const fitness = [&](Eigen::VectorXd const& parameters) { return 1.0 / loss.rough(parameters); };
  auto const search = genetic_search(loss.parameters(), fitness, options.seed);
  auto const found = lowest_descent(loss, search);
  return samples.model(
      "genetic_back_propagation", found.parameters,
      fmt::format("{} hidden nodes, {} generations, {} epochs", hidden_nodes(samples.set.regressors.cols()),
                  search.fitness.size() - 1, found.epochs));
}

}  // namespace thermotwin::models
