#pragma once

#include <span>

#include "models/error_model.h"

namespace thermotwin::models {

/// The network M-(2M+1)-1 whose back-propagation starts from a genetic search over its weights and thresholds with
/// fitness 1/E (paper 003; methods.md §6.3): 5-11-1 and 78 genes for five inputs. The best of every fiftieth generation
/// descends for 500 epochs, and the one that is lowest then goes on with what is left of `network_epochs`: a later
/// generation is fitter, but not always nearer to a low valley. (Paper 003 does not say how its search and its descent
/// share the work.) At equal epochs a start from the search leads over random ones for some hundred, and
/// no more after two thousand.
ErrorModel fit_genetic_back_propagation(std::span<Batch const> batches, FitOptions const& options);

}  // namespace thermotwin::models
