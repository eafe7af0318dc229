#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "thermal/evaluation.h"

namespace thermotwin::thermal {

/// A derivative of a network that has become longer by parts appended to it, which do not depend on the parameter; of
/// an empty one, that of a number which does nothing.
[[nodiscard]] NetworkDerivative lengthened(NetworkDerivative derivative, Network const& network);

/// ∂f/∂θ_k of many parameters at one state, f = dy/dt: the forcing of the tangent-linear system ds/dt = A s + ∂f/∂θ.
/// Only the elements whose coefficients change with a parameter are evaluated, so that hundreds of parameters, each of
/// one part, cost about as much as one evaluation of f.
class ParameterColumns {
 public:
  /// Whether a parameter has a column: not one of an average's weights or of a capacity's slope, a place that moves.
  [[nodiscard]] static bool has(NetworkDerivative const& parameter);
  /// InputError for a parameter without.
  ParameterColumns(Network const& network, std::vector<NetworkDerivative const*> const& parameters);

  [[nodiscard]] int count() const { return count_; }

  /// node × parameter [K/s per unit of θ].
  void evaluate(Evaluation& evaluation, double const* state, double const* input, NodeByParameter& forcing) const;
  /// The same where the evaluation has just made this linearisation.
  void evaluate(Evaluation& evaluation, Linearisation const& at, double const* state, double const* input,
                NodeByParameter& forcing) const;

 private:
  /// The elements of one law that change, each with its own copy of what it reads; ports are numbered anew.
  struct Group {
    std::shared_ptr<Law const> law;
    std::vector<int> ports, own_ports, inputs, columns;
    std::vector<double> coefficients, rates;
  };
  struct Capacity {
    int node, column;
    double relative;  ///< dC/C per unit of θ
  };
  struct BoundaryChange {
    int boundary, column;
    double offset;
    std::vector<double> weights;
  };

  void add_group(ElementGroup const& group, std::size_t index, std::vector<NetworkDerivative const*> const& parameters);
  void add_heat(Evaluation const& evaluation, int port, int column, double heat, NodeByParameter& forcing) const;

  Network const* network_;
  int count_ = 0;
  std::vector<Group> groups_;
  std::vector<Capacity> capacities_;
  std::vector<BoundaryChange> boundaries_;
};

}  // namespace thermotwin::thermal
