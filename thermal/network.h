#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <string>
#include <vector>

#include "thermal/grid_conduction.h"
#include "thermal/law.h"

namespace thermotwin::thermal {

/// A port of an element: a node, a boundary whose temperature is given, or a weighted average of nodes.
struct Port {
  enum class Kind { node, boundary, average } kind = Kind::node;
  int index = 0;
};

/// Nodes that belong together: one lump or all cells of a finite-difference body.
struct NodeRange {
  std::string name;
  int first = 0;
  int count = 0;
};

/// A boundary's temperature is a combination of input channels: T_b = offset + Σ weight · u[channel], for example the
/// room air at a height: u[ambient.temperature] + (z − z_ref) u[ambient.gradient].
struct Boundary {
  struct Term {
    int channel = 0;
    double weight = 1.0;
  };
  std::string name;
  double offset = 0.0;
  std::vector<Term> terms;
};

/// T̄ = Σ wᵢ Tᵢ with Σ wᵢ = 1; heat into the average is shared among the nodes by the same weights.
///
/// If `from_channel` ≥ 0 the average moves: a window of length `window`, whose centre is spread evenly over
/// [u[from_channel], u[to_channel]] (both equal: where it is now), is laid over the cells [edges[i], edges[i+1]]; the
/// weights are the exact mean overlaps (physics.md 2.10), computed anew at every evaluation.
struct Average {
  std::string name;
  std::vector<int> nodes;
  std::vector<double> weights;
  int from_channel = -1, to_channel = -1;
  double window = 0.0;
  std::vector<double> edges;
  std::vector<int> weight_channels;  ///< of a moving average: one channel of the operating point per weight
};

/// Mean length of overlap of [low, high] with a window of length `window` whose centre is spread evenly over [from,
/// to].
[[nodiscard]] double mean_overlap(double low, double high, double window, double from, double to);

/// All elements that follow one law.
struct ElementGroup {
  std::shared_ptr<Law const> law;
  std::vector<int> ports;
  std::vector<double> coefficients;
  std::vector<int> inputs;
  std::vector<int> parts;  ///< index of the part (of the machine file) that each element belongs to
  bool inside = false;     ///< constant conduction between nodes of one body; Network::conduction evaluates it

  [[nodiscard]] int count() const { return int(parts.size()); }
  [[nodiscard]] ElementBatch batch() const { return {count(), ports, coefficients, inputs}; }
};

/// A switch with hysteresis: 1 above `high`, 0 below `low`, where both are measured from the reference port; a channel
/// of the operating point carries its state. `minimum_off_time` keeps a compressor from restarting at once.
struct Relay {
  std::string name;
  int measured = 0;   ///< index in the temperature vector
  int reference = 0;  ///< index in the temperature vector
  double high = 0.0;  ///< [K]
  double low = 0.0;   ///< [K]
  double minimum_off_time = 0.0;
  int enable_channel = -1;  ///< the relay works while this channel is above ½; always, if negative
  int state_channel = 0;
};

/// An immutable thermal network: C_i dT_i/dt = Σ heat flows into node i (physics.md 0.1).
///
/// The temperature vector is [nodes | boundaries | averages]; the operating point is [external channels | relay
/// states]. Built by NetworkBuilder and never changed; threads share it, each with its own Evaluation.
///
/// The state is the *enthalpy temperature* y: with c = c₂₀(1 + s (T − T₂₀)), y − T₂₀ = (T − T₂₀) + ½ s (T − T₂₀)², so
/// that C dy/dt = heat and stored energy Σ C y is linear in the state: the energy balance of a run then closes to the
/// solver's round-off even where the specific heat depends on temperature. For constant c, y = T.
class Network {
 public:
  [[nodiscard]] int nodes() const { return int(capacity_.size()); }
  [[nodiscard]] int temperatures() const { return nodes() + int(boundaries_.size()) + int(averages_.size()); }
  [[nodiscard]] int channels() const { return int(channels_.size()); }
  [[nodiscard]] int external_channels() const { return external_channels_; }
  /// Those that a caller of Evaluation fills: without the weights.
  [[nodiscard]] int given_channels() const { return external_channels_ + int(relays_.size()); }

  /// Names of the operating point's channels: first those that a course must give, then the relays' states.
  [[nodiscard]] std::vector<std::string> const& channel_names() const { return channels_; }
  /// Of those, the ones between 0 and 1.
  [[nodiscard]] std::vector<std::string> const& shares() const { return shares_; }
  [[nodiscard]] std::vector<NodeRange> const& ranges() const { return ranges_; }
  [[nodiscard]] std::vector<Boundary> const& boundaries() const { return boundaries_; }
  [[nodiscard]] std::vector<Average> const& averages() const { return averages_; }
  [[nodiscard]] std::vector<ElementGroup> const& groups() const { return groups_; }
  [[nodiscard]] std::vector<Relay> const& relays() const { return relays_; }
  [[nodiscard]] std::vector<std::string> const& parts() const { return parts_; }
  [[nodiscard]] std::vector<double> const& capacity() const { return capacity_; }  ///< at 20 °C [J/K]
  [[nodiscard]] std::vector<double> const& capacity_slope() const { return capacity_slope_; }
  [[nodiscard]] std::vector<char> const& signals() const { return signal_; }  ///< 1: a controller's state, not a body

  /// "shaft[3]" for the fourth node of a range, "head" for a lump.
  [[nodiscard]] std::string node_name(int node) const;
  /// Index of the first node of a body; InputError with the nearest name if there is none.
  [[nodiscard]] NodeRange const& range(std::string const& name) const;
  /// Index in the temperature vector.
  [[nodiscard]] int index_of(Port port) const;

  [[nodiscard]] double temperature_of_state(int node, double y) const {
    return capacity_slope_[std::size_t(node)] == 0.0 ? y : temperature_of_warm_state(node, y);
  }
  [[nodiscard]] double state_of_temperature(int node, double temperature) const;

  /// Nonzero pattern of ∂(heat into a port)/∂(temperature of a port): square, one row per entry of the temperature
  /// vector. What an average couples is one row and one column here, however many nodes it has.
  [[nodiscard]] Eigen::SparseMatrix<double> const& port_pattern() const { return pattern_; }
  /// Of each range, as its links form it.
  [[nodiscard]] std::vector<Grid> const& grids() const { return grids_; }
  /// The elements of the group that lies inside bodies.
  [[nodiscard]] GridConduction const& conduction() const { return conduction_; }

 private:
  friend class NetworkBuilder;
  friend class Evaluation;
  Network() = default;
  [[nodiscard]] double temperature_of_warm_state(int node, double y) const;
  void build_pattern();
  void find_grids();

  std::vector<double> capacity_, capacity_slope_;
  std::vector<char> signal_;
  std::vector<NodeRange> ranges_;
  std::vector<Boundary> boundaries_;
  std::vector<Average> averages_;
  std::vector<ElementGroup> groups_;
  std::vector<Relay> relays_;
  std::vector<std::string> channels_, shares_, parts_;
  int external_channels_ = 0;
  Eigen::SparseMatrix<double> pattern_;
  std::vector<Grid> grids_;
  GridConduction conduction_;
  std::vector<std::vector<int>> slots_;  ///< per group: where ∂q_p/∂T_r of each element goes in the pattern's values
};

/// Collects bodies and elements, checks them by name, and makes the network. Short-lived; `build` empties it.
class NetworkBuilder {
 public:
  /// Adds nodes with heat capacities [J/K] at 20 °C and their relative slope [1/K]; returns the first node's port.
  Port add_body(std::string const& name, std::vector<double> const& capacities, double capacity_slope = 0.0);
  /// A controller's state: ds/dt = "heat flow" of the laws that write to it, no body, not in the energy balance.
  Port add_signal(std::string const& name);
  Port add_boundary(Boundary boundary);
  /// Raises a boundary that is there by an offset and further terms.
  void add_to_boundary(Port boundary, double offset, std::vector<Boundary::Term> const& terms);
  Port add_average(Average average);
  /// The channel that carries the weight of entry i of a moving average: the share of the moving part that is there.
  [[nodiscard]] int weight_channel(Port average, int entry) const;

  /// Index of an input channel, created when first named.
  int channel(std::string const& name);
  /// The same for one that is between 0 and 1: a course must give it without a unit.
  int share(std::string const& name);
  /// A relay's state is a channel of its own, named `<name>.state`; returns its index.
  int add_relay(std::string const& name, Port measured, Port reference, double high, double low,
                double minimum_off_time = 0.0, int enable_channel = -1);

  /// Index of the part that elements belong to; heat is reported by part.
  int part(std::string const& name);

  template <class Formula>
  void add(int part, std::vector<Port> const& ports, std::vector<double> const& coefficients,
           std::vector<int> const& channels = {}) {
    add(law_of<Formula>(), part, ports, coefficients, channels);
  }
  void add(std::shared_ptr<Law const> law, int part, std::vector<Port> const& ports,
           std::vector<double> const& coefficients, std::vector<int> const& channels);

  /// Adds conduction G [W/K] ≥ 0 between two ports.
  void connect(int part, Port a, Port b, double conductance);

  /// InputError for: a body without a path to any boundary, a capacity ≤ 0, a name twice, no node at all.
  [[nodiscard]] Network build();

  [[nodiscard]] int nodes() const { return int(network_.capacity_.size()); }
  [[nodiscard]] NodeRange const& range(std::string const& name) const { return network_.range(name); }
  [[nodiscard]] std::vector<NodeRange> const& ranges() const { return network_.ranges_; }

 private:
  void check_paths() const;

  struct PendingGroup {
    std::shared_ptr<Law const> law;
    bool inside;
    std::vector<Port> ports;
    std::vector<double> coefficients;
    std::vector<int> channels, parts;
  };
  [[nodiscard]] bool inside_one_body(std::vector<Port> const& ports) const;
  struct PendingRelay {
    Relay relay;
    Port measured, reference;
  };
  Network network_;
  std::vector<PendingGroup> groups_;
  std::vector<PendingRelay> relays_;
};

}  // namespace thermotwin::thermal
