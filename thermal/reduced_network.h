#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "thermal/linear_part.h"
#include "thermal/network.h"

namespace thermotwin::thermal {

/// A network seen through few shapes V of its enthalpy temperatures, y = y₀ + V ξ, VᵀCV = I (Galerkin, with the heat
/// capacities as inner product: what is stored and what is symmetric stay so, no mode can grow that did not):
///
///   dξ/dt = −Λ ξ + f₀ + F u + Vᵀ Σ w_e rest_e(V ξ, u),   Λ = Vᵀ K V, made diagonal.
///
/// The linear part is projected exactly. The laws that are not linear stay as they are and see the temperatures of
/// their own ports: all of them (w = 1), or, where one law sits on thousands of cells, a sample of them with weights
/// that give the same generalised heat (Farhat et al., Int. J. Numer. Meth. Eng. 102 (2015) 1077). With as many shapes
/// as nodes and all elements this is the network itself.
///
/// Immutable; threads share it, each with its own ReducedEvaluation. Machines with relays or moving averages are
/// refused (InputError).
class ReducedNetwork {
 public:
  /// `shapes`: nodes × r, of any scale, independent of each other.
  ReducedNetwork(Network const& network, LinearPart const& linear, Eigen::MatrixXd const& shapes,
                 std::vector<SampledElement> const& elements);

  [[nodiscard]] Network const& network() const { return *network_; }
  [[nodiscard]] int size() const { return int(decay_.size()); }
  [[nodiscard]] Eigen::VectorXd const& decay() const { return decay_; }  ///< Λ ≥ 0 [1/s]
  [[nodiscard]] Eigen::MatrixXd const& shapes() const { return shapes_; }
  [[nodiscard]] std::vector<SampledElement> const& elements() const { return elements_; }

  /// ξ = Vᵀ C (y − y₀): the nearest state in the norm of the heat capacities.
  [[nodiscard]] Eigen::VectorXd state_of(std::span<double const> node_temperatures) const;
  /// Temperatures of all nodes [K].
  void temperatures_of(Eigen::VectorXd const& state, std::span<double> node_temperatures) const;

  /// What a weighted sum of node temperatures is at a state: offset + row · ξ. Where the capacity of one of the nodes
  /// depends on its temperature this holds to first order about 20 °C.
  struct Functional {
    double offset = 0.0;
    Eigen::RowVectorXd row;
  };
  [[nodiscard]] Functional functional(std::vector<std::pair<int, double>> const& weights) const;

  /// The elements of one law, their ports counted in the compact temperature vector [rows | composed | boundaries].
  struct Group {
    std::shared_ptr<Law const> law;
    std::vector<int> ports;
    std::vector<double> coefficients;
    std::vector<int> inputs;
    std::vector<double> secant, weight;

    [[nodiscard]] int count() const { return int(weight.size()); }
    [[nodiscard]] ElementBatch batch() const { return {count(), ports, coefficients, inputs}; }
  };
  [[nodiscard]] std::vector<Group> const& groups() const { return groups_; }
  /// Generalised heat of one watt into a port of the compact vector; nothing for a boundary.
  [[nodiscard]] Eigen::VectorXd shape_of_port(int port) const;

 private:
  friend class ReducedEvaluation;
  void project(LinearPart const& linear, Eigen::MatrixXd const& shapes);
  void add_elements(LinearPart const& linear);
  int compact_port(int port, std::vector<int>& known);
  int add_row(std::vector<std::pair<int, double>> const& shares);

  Network const* network_;
  Eigen::MatrixXd shapes_;
  Eigen::VectorXd decay_, constant_;
  Eigen::MatrixXd input_gain_;  ///< r × external channels
  std::vector<SampledElement> elements_;
  std::vector<Group> groups_;

  Eigen::VectorXd start_;                          ///< y₀ of the nodes: 20 °C, 0 for a controller's state
  std::vector<std::vector<double>> pending_rows_;  ///< while it is built
  Eigen::MatrixXd rows_;                           ///< port × r
  Eigen::VectorXd row_offset_;
  std::vector<std::pair<int, int>> sloped_;  ///< (row, node): T is not y
  struct Composed {
    std::vector<std::pair<int, double>> shares;  ///< of rows
  };
  std::vector<Composed> composed_;  ///< averages over nodes of which some are sloped
};

/// Why no constant shapes can stand for the network: it has relays, or a part that moves along a track. Empty: they
/// can.
[[nodiscard]] std::string why_irreducible(Network const& network);
/// The same as an InputError.
void check_reducible(Network const& network);

/// Evaluates one reduced network; holds the scratch memory, so one per thread.
class ReducedEvaluation {
 public:
  explicit ReducedEvaluation(ReducedNetwork const& network);

  /// All of dξ/dt but −Λ ξ.
  void rest(Eigen::VectorXd const& state, double const* input, Eigen::VectorXd& result);
  /// What each element adds to the linear part at the last evaluation, unweighted [W]: per group, as Law::heat_flows.
  [[nodiscard]] std::vector<std::vector<double>> const& rest_flows() const { return flows_; }
  /// Largest change [K] of a temperature that a law sees, for a change of the state.
  [[nodiscard]] double port_change(Eigen::VectorXd const& change);

 private:
  void find_temperatures(Eigen::VectorXd const& state, double const* input);

  ReducedNetwork const* network_;
  Eigen::VectorXd linear_, temperature_, heat_, change_;
  std::vector<std::vector<double>> flows_;
};

}  // namespace thermotwin::thermal
