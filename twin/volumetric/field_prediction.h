#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "twin/volumetric/error_field.h"
#include "twin/volumetric/nine_functions.h"

namespace thermotwin::twin {

/// Nine functions between and instead of their measured points.
struct FieldPrediction {
  std::string method;
  NineFunctions functions;     ///< at many points
  double training_time = 0.0;  ///< of all nine, processor time of one thread [s]
  std::string remark;          ///< what the fit found out
};

/// A way of predicting the error field: nine models of one coordinate each, from −1 to 1 along the
/// axis: the wider of the two ranges in which methods.md §5.6 finds that the paper's σ² makes sense.
struct PredictionMethod {
  std::string_view name;
  std::string_view meaning;
  FieldPrediction (*predict)(NineFunctions const& measured, std::uint64_t seed);
};

/// | name          | what it does                                                                                   |
/// |---------------|------------------------------------------------------------------------------------------------|
/// | interpolation | straight lines through the points: copies their noise                                          |
/// | ls_svm        | LS-SVM with Gaussian kernel, γ = 56.2, σ² = 0.2 (paper 002)                                    |
/// | ls_svm_chosen | the same, γ = 1, 10 … 10⁵, σ² = 0.2, 0.4 … 1.6, by the least squared error of the points left |
/// |               | out one at a time, over all nine functions together                                           |
/// | network       | 1-3-1 by back-propagation (paper 003's method) from a random start                             |
[[nodiscard]] std::span<PredictionMethod const> prediction_methods();
/// InputError that names the nearest for any other.
[[nodiscard]] PredictionMethod const& prediction_method(std::string_view name);

/// How far a prediction is from the truth on a grid, both without the rigid motion of the whole.
struct PredictionScore {
  double rms = 0.0;      ///< of the vectors' lengths [m]
  double largest = 0.0;  ///< [m]
  double mape = 0.0;     ///< of components that are at least 1 µm [%]; NaN without any
};

[[nodiscard]] PredictionScore score(FieldPrediction const& prediction, ErrorFunction const& truth,
                                    VolumeGrid const& grid);

}  // namespace thermotwin::twin
