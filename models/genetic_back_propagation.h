#pragma once

#include <span>

#include "models/error_model.h"

namespace thermotwin::models {

/// The network M-(2M+1)-1 whose back-propagation starts from a genetic search over its weights and thresholds with
/// fitness 1/E (paper 003; methods.md §6.3): 5-11-1 and 78 genes for five inputs. The best of every fiftieth of a
/// hundred generations descends for 500 epochs, and the two that are lowest then go on to `network_epochs`; the lower
/// end is taken. A later generation is fitter, but not always nearer to a low valley, and which valley is low shows
/// late: a single descent is often above the median of random starts. (Paper 003 does not say how its search and its
/// descent share the work.)
ErrorModel fit_genetic_back_propagation(std::span<Batch const> batches, FitOptions const& options);

}  // namespace thermotwin::models
