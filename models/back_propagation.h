#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "models/error_model.h"
#include "models/network.h"

namespace thermotwin::models {

/// Gradient descent with momentum on E/N over all samples at once,
///
///     Δ ← μ Δ − η ∂(E/N)/∂w,   w ← w + Δ,
///
/// whose rate η grows by 5 % after a step that lowers E, and is cut by 30 %, the step withdrawn and Δ forgotten, after
/// one that raises it by more than 4 % (Vogl et al., Biol. Cybern. 59 (1988) 257). Paper 003 states none of these.
struct DescentOptions {
  double rate = 0.05;     ///< η at the start
  double momentum = 0.9;  ///< μ
  int epochs = 2000;      ///< at most (methods.md §6.3)
  double goal = 1e-6;     ///< stop below this E/N of a target between −1 and 1
};

struct Descent {
  Eigen::VectorXd parameters;  ///< the best seen
  double loss = 0;             ///< their E
  int epochs = 0;
};

Descent descend(NetworkLoss& loss, Eigen::VectorXd const& start, DescentOptions const& options = {});

/// What a network's descent may cost, whatever it starts from: only so do starts compare.
constexpr int network_epochs = 5'000;

/// Even in [−1, 1).
Eigen::VectorXd random_parameters(Eigen::Index count, std::uint64_t seed);

/// The network M-(2M+1)-1 by back-propagation from one random start, for `network_epochs` (paper 003; methods.md §6.2).
ErrorModel fit_back_propagation(std::span<Batch const> batches, FitOptions const& options);

}  // namespace thermotwin::models
