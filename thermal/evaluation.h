#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "thermal/network.h"

namespace thermotwin::thermal {

/// How a network changes with one named parameter θ: the difference of two networks of the same structure, built with
/// θ + h and θ − h, divided by 2h. Any number of a machine file is such a parameter; no law knows of it.
struct NetworkDerivative {
  std::string name;
  double scale = 1.0;  ///< typical size of θ, for the error control of the sensitivities
  std::vector<double> capacity, capacity_slope;
  std::vector<std::vector<double>> coefficients;  ///< per group; empty where nothing changes
  std::vector<double> boundary_offset;
  std::vector<std::vector<double>> boundary_weights;
  std::vector<std::vector<double>> average_weights;
  std::vector<double> initial_temperature;  ///< per node; empty: does not change
};

/// One column per parameter, the numbers of a node side by side.
using NodeByParameter = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// InputError if the two networks do not have the same structure, or differ in when a relay switches or where a moving
/// average is: switching times and tracks carry no derivative (physics.md §0).
[[nodiscard]] NetworkDerivative difference(Network const& plus, Network const& minus, double step);

/// Energy that has crossed the network's border.
struct Energy {
  double supplied = 0.0;   ///< by parts that make heat, ≥ 0 [J or W]
  double withdrawn = 0.0;  ///< by parts that take heat (evaporation, chiller), ≥ 0
  double lost = 0.0;       ///< into boundaries (room air, coolant leaving), either sign
  double exchanged = 0.0;  ///< with boundaries, both ways added up, ≥ 0
};

/// A network's right-hand side linearised at one state and operating point, kept sparse: with S the matrix that makes
/// the port temperatures of the node temperatures (one for a node, weights for an average, nothing for a boundary),
///
///   ∂(dy/dt)/∂y = C⁻¹ Sᵀ G S dT/dy,   ∂(power)/∂y = P S dT/dy.
struct Linearisation {
  Eigen::SparseMatrix<double> coupling;            ///< G = ∂(heat into port)/∂(temperature of port) [W/K]
  Eigen::Matrix<double, 4, Eigen::Dynamic> power;  ///< P = ∂(supplied, withdrawn, lost, exchanged)/∂(port) [W/K]
  Eigen::VectorXd slope;                           ///< dT/dy of the nodes
  Eigen::VectorXd rate;                            ///< dy/dt there [K/s]
  std::vector<std::vector<double>> weights;        ///< of the averages
};

/// Evaluates one network; holds the scratch memory, so one per thread.
class Evaluation {
 public:
  explicit Evaluation(Network const& network);

  [[nodiscard]] Network const& network() const { return *network_; }

  /// [nodes | boundaries | averages] from the state and the operating point.
  std::span<double const> temperatures(double const* state, double const* input);

  /// Weights of the averages, and the operating point completed by them, at the last evaluation.
  [[nodiscard]] std::vector<std::vector<double>> const& average_weights() const { return weights_; }
  [[nodiscard]] std::vector<double> const& inputs() const { return input_; }

  /// dy/dt [K/s].
  void rate(double const* state, double const* input, double* state_rate);

  /// dy/dt [K/s], and the powers [W] at this instant.
  Energy rate_and_power(double const* state, double const* input, double* state_rate);

  /// Exact, term by term: Σ Cᵢ ∂(dyᵢ/dt)/∂y = ∂(supplied − withdrawn − lost)/∂y at every point.
  void linearise(double const* state, double const* input, Linearisation& result);
  /// ∂(dy/dt)/∂y [1/s], condensed on the nodes: dense where averages are.
  [[nodiscard]] Eigen::SparseMatrix<double> jacobian(double const* state, double const* input);

  /// d(dy/dt)/dθ = (∂f/∂y) dy/dθ + ∂f/∂θ.
  void rate_derivative(double const* state, double const* state_derivative, NetworkDerivative const& derivative,
                       double const* input, double* result);

  /// Powers at this instant.
  Energy power(double const* state, double const* input);

  /// Heat that each part gives to the bodies [W]: sources positive, losses negative, joints between bodies zero.
  void heat_of_parts(double const* state, double const* input, std::span<double> watts);
  /// Heat that sources put into each node [W], for the fields.
  void source_of_nodes(double const* state, double const* input, std::span<double> watts);

 private:
  void weigh_moving_averages(double const* input);
  /// dT/dθ of every entry of the temperature vector.
  std::span<double const> temperature_derivatives(double const* state, double const* state_derivative,
                                                  NetworkDerivative const& derivative, double const* input);
  void share_averages(std::vector<double>& heat) const;
  double heat_made(ElementGroup const& group, int element, double const* flows) const;
  void add_made_gradient(ElementGroup const& group, Linearisation& result);
  void add_coupling(std::size_t group, double* values);

  Network const* network_;
  std::vector<double> input_;  ///< the operating point, completed by the weights of moving averages
  std::vector<double> temperature_, heat_, temperature_rate_, heat_rate_, flows_, blocks_;
  std::vector<double> linear_coupling_;       ///< by the laws that are linear; empty until it is asked for
  bool constant_capacity_;                    ///< of all nodes
  std::vector<std::vector<double>> weights_;  ///< of the averages, at the present operating point
};

}  // namespace thermotwin::thermal
