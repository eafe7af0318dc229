#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "thermal/evaluation.h"
#include "thermal/network.h"
#include "thermal/operating_point.h"

namespace thermotwin::thermal {

/// How the Newton systems (I − γJ)x = b are solved; `automatic` chooses by size and structure (see choose_solver).
enum class LinearSolver { automatic, dense, sparse_direct, preconditioned_krylov, multigrid };

[[nodiscard]] std::string_view name_of(LinearSolver solver);

/// The choice that `automatic` makes, as measured by tests/benchmarks/linear_solver.cc.
[[nodiscard]] LinearSolver choose_solver(Network const& network);

struct IntegrationOptions {
  double relative_tolerance = 1e-6;
  double absolute_tolerance = 1e-6;  ///< [K]
  LinearSolver solver = LinearSolver::automatic;
  /// Of a run in modes, with those that were rejected.
  long most_steps = std::numeric_limits<long>::max();
  /// Parameters whose forward sensitivities are integrated with the run.
  std::vector<NetworkDerivative> parameters;

  /// Of one step [K]. Temperatures are kelvin, of which only the rise matters: the tolerance is absolute, scaled by a
  /// rise of 10 K.
  [[nodiscard]] double tolerance() const { return absolute_tolerance + 10.0 * relative_tolerance; }
};

/// What the observer sees at each output time; the spans are valid during the call.
struct Sample {
  double time = 0.0;                               ///< [s]
  std::span<double const> state;                   ///< enthalpy temperatures of the nodes
  std::span<double const> temperatures;            ///< [nodes | boundaries | averages] [K]
  std::span<double const> input;                   ///< operating point, relay states included
  Energy energy;                                   ///< since the start [J]
  NodeByParameter const* sensitivities = nullptr;  ///< dT/dθ, if parameters were given
};
using Observer = std::function<void(Sample const&)>;

/// What the run did.
struct IntegrationSummary {
  LinearSolver solver = LinearSolver::automatic;
  long steps = 0, rate_evaluations = 0, jacobian_evaluations = 0, nonlinear_iterations = 0, error_test_failures = 0;
  int restarts = 0;        ///< at jumps of the input
  int relay_switches = 0;  ///< found by root finding
  Energy energy;           ///< over the whole run [J]
  double stored = 0.0;     ///< [J]
  double wall_time = 0.0;  ///< [s]

  /// Heat that moved: all that came in, from sources and boundaries, or all that went out, whichever is more [J].
  [[nodiscard]] double moved() const;
  /// |stored + lost + withdrawn − supplied| over the heat that moved.
  [[nodiscard]] double energy_imbalance() const;
};

/// Where a run stands: all that it carries over an instant at which the integrator starts anew, so that a run that is
/// cut there and taken up later, by another process, goes on bit for bit as if it had not been.
struct IntegrationState {
  double time = 0.0;                ///< [s]
  std::vector<double> state;        ///< enthalpy temperatures of the nodes [K], then the energies in the solver's unit
  std::vector<double> start;        ///< enthalpy temperatures at the start of the run [K]
  std::vector<double> relays;       ///< 1 or 0
  std::vector<double> next_switch;  ///< earliest time at which each relay may switch on again [s]
  IntegrationSummary summary;       ///< of the run so far
};

/// Before anything happened.
[[nodiscard]] IntegrationState start_of_run(Network const& network, std::span<double const> temperatures, double time);

/// One stretch of a run: from `state` through the output times (increasing; the first may be the state's own) with a
/// new integrator, which leaves behind the state at the last of them. Forward sensitivities start anew, too: they are
/// for runs of one stretch.
void integrate(Network const& network, Course const& course, IntegrationState& state,
               std::span<double const> output_times, IntegrationOptions const& options, Observer const& observe);

/// A whole run. Integrates C dy/dt = heat with CVODES (BDF, Newton, analytic Jacobian): stops at every jump of the
/// course, finds the switching of relays as roots, and carries the energy balance in the state, where it closes to
/// round-off. Calls `observe` at every output time (increasing; the first is the start). SUNDIALS: Hindmarsh et al.,
/// ACM TOMS 31 (2005) 363.
///
/// Throws InputError when the course lacks a channel that the network needs; IntegrationError, which names the worst
/// nodes and the inputs at that time, when the integrator gives up. What `observe` throws comes out unchanged.
IntegrationSummary integrate(Network const& network, Course const& course, std::span<double const> initial_temperatures,
                             std::span<double const> output_times, IntegrationOptions const& options,
                             Observer const& observe);

/// Steady temperatures [K] of all nodes at a constant operating point: Newton's method in steps of 20 K at most, and
/// pseudo transient continuation where it fails. IntegrationError when neither settles.
[[nodiscard]] std::vector<double> steady_state(Network const& network, std::span<double const> input,
                                               std::span<double const> guess);

}  // namespace thermotwin::thermal
