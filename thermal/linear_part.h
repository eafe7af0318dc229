#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "thermal/network.h"

namespace thermotwin::thermal {

/// Temperatures and inputs about which a network is split.
struct ReferencePoint {
  std::vector<double> temperatures;  ///< [nodes | boundaries | averages] [K]
  std::vector<double> input;         ///< of all channels
};

/// A network as a linear, symmetric conduction network and a rest:
///
///   heat into the nodes = −K (y − T₂₀) + G_b (T_b − T₂₀) + Σ rest_e,   rest_e = q_e(T, u) − g_e (y₁ − y₀),
///
/// with K = Σ g_e (p₀ − p₁)(p₀ − p₁)ᵀ, p the nodes' shares in a port, and y the enthalpy temperatures. g_e is the
/// conductance itself where an element conducts at constant conductance between nodes whose capacity is constant: then
/// its rest is nothing. For any other conservative element with two ports it is −∂q₀/∂T₀ at the reference, so that the
/// rest is small near it; for all others it is 0 and the rest is the whole law.
struct LinearPart {
  LinearPart(Network const& network, ReferencePoint const& at);

  Eigen::SparseMatrix<double> conductance;       ///< K [W/K]: nodes × nodes, symmetric, without negative eigenvalues
  Eigen::SparseMatrix<double> boundary;          ///< G_b [W/K]: nodes × boundaries
  std::vector<std::vector<double>> secant;       ///< g_e [W/K], per group and element
  std::vector<std::vector<char>> is_all_linear;  ///< 1: element without rest
};

/// An element of a network that a reduced network evaluates, and how many of its kind it stands for.
struct SampledElement {
  int group = 0, element = 0;
  double weight = 1.0;
};

/// All elements that have a rest, each for itself.
[[nodiscard]] std::vector<SampledElement> nonlinear_elements(Network const& network, LinearPart const& linear);

/// The nodes' shares in a port of the temperature vector: none for a boundary.
[[nodiscard]] std::vector<std::pair<int, double>> node_shares(Network const& network, int port);

}  // namespace thermotwin::thermal
