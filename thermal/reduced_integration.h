#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "thermal/operating_point.h"
#include "thermal/reduced_network.h"

namespace thermotwin::thermal {

/// What the observer of a reduced run sees at each output time; valid during the call.
struct ReducedSample {
  double time = 0.0;             ///< [s]
  Eigen::VectorXd const& state;  ///< ξ
  std::vector<double> const& input;
};
using ReducedObserver = std::function<void(ReducedSample const&)>;

struct ReducedSummary {
  long steps = 0, rejected = 0, rate_evaluations = 0;
};

/// Integrates a reduced network from `initial` with exponential steps; `tolerance` [K] bounds the estimated error of
/// one step in every temperature that a law sees. Stops at every jump of the course; output times in between are
/// interpolated. InputError when the course lacks a channel; IntegrationError when the step runs to nothing, or more
/// are tried than `most_steps`.
ReducedSummary integrate(ReducedNetwork const& network, Course const& course, Eigen::VectorXd const& initial,
                         std::span<double const> output_times, double tolerance, ReducedObserver const& observe,
                         long most_steps = std::numeric_limits<long>::max());

}  // namespace thermotwin::thermal
