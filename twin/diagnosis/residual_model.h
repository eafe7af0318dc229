#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "thermal/network.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// The twin linearised about its course, from a row of the data on: d(δy)/dt = A δy + …, r = H δy + v.
struct Regime {
  Eigen::Index first_row = 0;
  Eigen::MatrixXd dynamics;     ///< A = ∂f/∂y [1/s]
  Eigen::MatrixXd observation;  ///< H, one row per channel, one column per node [unit of the channel/K]
};

/// What residuals, measured minus twin, have to say about heat q that the twin does not know (physics.md 8.3):
///
///   d(δy)/dt = A δy + q e_i/C_i + w,   r = H δy + v,   v ~ N(0, diag σ²),
///
/// δy [K]: deviation of the nodes' enthalpy temperatures; i: the node that q [W] flows into; w: white. A is constant
/// in each regime: one per speed finds the node, several along a warm-up keep the course of q straight. What is not
/// linear remains: 25 W at the pulley of v450, which warm a bearing by some kelvin, come out as 25.3 W.
/// Dense: for networks of up to some hundred nodes.
struct ResidualModel {
  double interval = 60.0;           ///< between two rows [s]
  std::vector<Regime> regimes;      ///< in order of time, the first from row 0
  Eigen::VectorXd capacity;         ///< C of the nodes [J/K]
  Eigen::VectorXd noise;            ///< σ of each channel [its unit] > 0
  double disturbance = 1e-6;        ///< intensity of w at every node [K/√s]: what else the twin does not know
  double initial_deviation = 1e-3;  ///< s.d. of δy at the start [K]
  double prior_heat = 50.0;         ///< s.d. of q at the start, before any data [W]
};

/// A and H at one state and operating point of a run, as thermal::Sample gives them. A channel is a sum over nodes:
/// Sensor::weights, Displacement::weights, in SI; one without nodes sees nothing.
[[nodiscard]] Regime linearise(thermal::Network const& network, std::span<double const> state,
                               std::span<double const> input, std::vector<NodeWeights> const& channels);

/// InputError unless the model fits together, and the residuals (row: time, column: channel, NaN: missing) fit it.
void check(ResidualModel const& model, Eigen::MatrixXd const& residuals);

}  // namespace thermotwin::twin
