#pragma once

#include <span>

#include "models/batch.h"
#include "models/selection.h"

namespace thermotwin::models {

/// Temperature points by ordered clustering (paper 000; methods.md §3): the sensors that the pre-screen keeps, ordered
/// by their mean rise over all batches, normalised as the options say, parted into k contiguous classes of least loss;
/// of each class the sensor of most information. Candidates for k are the bends of the loss; the three differ in how
/// they choose among them. With a count k is the count; where the pre-screen keeps fewer, all sensors are clustered.
///
/// Throws std::invalid_argument where the samples are too few for a regression on the fewest sensors.

/// The improved rule: F, t, R² and residuals of the regression on the chosen sensors. Where no candidate has a
/// regression (sensors that are combinations of others), the one sensor of most information.
Selection select_by_ordered_clustering_improved(std::span<Batch const> batches, SelectionOptions const& options);

/// The ratio rule: where one more class helped most, and the regression's F is significant.
Selection select_by_ordered_clustering_ratio(std::span<Batch const> batches, SelectionOptions const& options);

/// The slope rule: where the last class lowered the loss most.
Selection select_by_ordered_clustering_slope(std::span<Batch const> batches, SelectionOptions const& options);

}  // namespace thermotwin::models
