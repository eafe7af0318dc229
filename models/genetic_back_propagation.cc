#include "models/genetic_back_propagation.h"

#include <fmt/format.h>

#include "models/back_propagation.h"
#include "models/genetic_search.h"
#include "models/network.h"

namespace thermotwin::models {

ErrorModel fit_genetic_back_propagation(std::span<Batch const> batches, FitOptions const& options) {
  NetworkSamples const samples(batches);
  auto loss = samples.loss();
  auto const fitness = [&](Eigen::VectorXd const& parameters) { return 1.0 / loss.rough(parameters); };
  auto const search = genetic_search(loss.parameters(), fitness, options.seed);
  auto const found = descend(loss, search.best.back(), {.epochs = network_epochs});
  return samples.model(
      "genetic_back_propagation", found.parameters,
      fmt::format("{} hidden nodes, {} generations, {} epochs", hidden_nodes(samples.set.regressors.cols()),
                  search.fitness.size() - 1, found.epochs));
}

}  // namespace thermotwin::models
