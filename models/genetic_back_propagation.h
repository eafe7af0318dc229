#pragma once

#include <span>

#include "models/error_model.h"

namespace thermotwin::models {

/// The network M-(2M+1)-1 whose back-propagation starts from a genetic search over its weights and thresholds with
/// fitness 1/E (paper 003; methods.md §6.3): 5-11-1 and 78 genes for five inputs. Its fittest descends for as many
/// epochs as a random start does (`network_epochs`), and comes lower than most of these where genes reach from −3 to 3;
/// from a search between −1 and 1, where random starts are drawn, it does not.
ErrorModel fit_genetic_back_propagation(std::span<Batch const> batches, FitOptions const& options);

}  // namespace thermotwin::models
