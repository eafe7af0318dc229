#include "models/genetic_back_propagation.h"

#include <algorithm>
#include <fmt/format.h>

#include "models/back_propagation.h"
#include "models/genetic_search.h"
#include "models/network.h"

namespace thermotwin::models {

namespace {

constexpr int generations = 100;
constexpr std::size_t generations_between_starts = 50;
constexpr int trial_epochs = 500;
constexpr std::size_t followed = 2;  ///< of the trials, to their end: which is lower then is not seen before

bool is_lower(Descent const& a, Descent const& b) { return a.loss < b.loss; }

Descent lowest_descent(NetworkLoss& loss, GeneticSearch const& search) {
  std::vector<Descent> trials;
  for (std::size_t generation = 0; generation < search.best.size(); generation += generations_between_starts)
    trials.push_back(descend(loss, search.best[generation], {.epochs = trial_epochs}));
  std::stable_sort(trials.begin(), trials.end(), is_lower);
  trials.resize(followed);
  for (auto& trial : trials) trial = descend(loss, trial.parameters, {.epochs = network_epochs - trial.epochs});
  return *std::min_element(trials.begin(), trials.end(), is_lower);
}

}  // namespace

ErrorModel fit_genetic_back_propagation(std::span<Batch const> batches, FitOptions const& options) {
  NetworkSamples const samples(batches);
  auto loss = samples.loss();
  auto const fitness = [&](Eigen::VectorXd const& parameters) { return 1.0 / loss.rough(parameters); };
  auto const search = genetic_search(loss.parameters(), fitness, options.seed, {.generations = generations});
  auto const found = lowest_descent(loss, search);
  return samples.model("genetic_back_propagation", found.parameters,
                       fmt::format("{} hidden nodes, {} generations, {} descents of {} epochs",
                                   hidden_nodes(samples.set.regressors.cols()), generations, followed, network_epochs));
}

}  // namespace thermotwin::models
