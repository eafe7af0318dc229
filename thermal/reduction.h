#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "thermal/linear_part.h"
#include "thermal/network.h"
#include "thermal/operating_point.h"
#include "thermal/reduced_network.h"

namespace thermotwin::thermal {

/// A run from which a reduction learns which states occur.
struct TrainingRun {
  Course const* course = nullptr;
  std::vector<double> initial_temperatures;
  double duration = 8 * 3600.0;  ///< [s]
};

/// A weighted sum of node temperatures that must come out right, to `tolerance` in its own unit.
struct WatchedSum {
  std::vector<std::pair<int, double>> weights;
  double tolerance = 0.01;
};

struct ReductionTask {
  std::vector<TrainingRun> training;
  std::vector<WatchedSum> watched;
  Eigen::MatrixXd initial_rises;  ///< nodes × k: what initial states are made of, besides 20 °C
  double share = 0.001;           ///< of each tolerance that the shapes may leave away in the training runs (rms)
  double cubature = 1e-3;         ///< how far the sampled elements may be from all, relative
};

/// A subspace, and the elements that are evaluated in it.
struct Subspace {
  Eigen::MatrixXd shapes;  ///< nodes × r
  std::vector<SampledElement> elements;
};

/// What is found once and kept: two subspaces, of which the coarse one has four fifths of the fine one's shapes.
struct Reduction {
  ReferencePoint reference;
  Subspace fine, coarse;
  /// Of every watched sum: largest difference in the training runs between the fine subspace and the larger one from
  /// which it was taken.
  std::vector<double> training_error;
};

/// Finds subspaces without a single run of the network itself:
///
/// 1. shapes: (K + σC)⁻¹ b for nine rates σ, from the steady state to 10 s, and every way b in which heat or an input
///    enters the linear part (moment matching at real points: Grimme 1997; Antoulas 2005, ch. 11);
/// 2. the training runs in these shapes, with all elements; what their rests look like over the nodes are further b;
/// 3. the training runs again; the principal shapes of their states, in a norm that weighs every watched sum by its
///    tolerance (Sirovich 1987);
/// 4. a sample of the elements with positive weights that gives the same generalised heat in all of these states.
///
/// Threads share the work; the result does not depend on how many there are.
[[nodiscard]] Reduction reduce(Network const& network, ReductionTask const& task);

}  // namespace thermotwin::thermal
