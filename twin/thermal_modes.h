#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "scenarios/experiment.h"
#include "thermal/operating_point.h"
#include "thermal/physical_constant.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// A state about which a machine is linearised.
struct OperatingState {
  std::vector<double> temperatures;  ///< of the nodes [K]
  std::vector<double> input;         ///< of the network's channels, relays last
};

/// The mean of every input over the experiment (at its sample times; relays half on), and the steady state of the
/// machine there. thermal::InputError when the experiment lacks an input that the machine needs.
[[nodiscard]] OperatingState mean_state(Machine const& machine, scenarios::Experiment const& experiment);
/// The same of a course, measured or not, over these times [s]; the search for the steady state begins `near` [K].
[[nodiscard]] OperatingState mean_state(Machine const& machine, thermal::Course const& course,
                                        std::span<double const> times, double near = thermal::reference_temperature);

/// How a machine forgets a disturbance: K φ = λ C φ, with K the conductances of the network linearised at a state and C
/// the heat capacities there, so that without further heat (Yang, Yuan & Ni, IJMTM 39 (1999) 1367; methods.md §6.1)
///
///   T(t) = Σ φ_i θ_i(0) exp(−t/τ_i),   τ_i = 1/λ_i,   displacement = Σ g_i θ_i.
///
/// K is symmetric where only conduction and films act. Flows that carry heat along (coolant from node to node) and
/// frictions that depend on temperature make it unsymmetric; then these are the right eigenvectors of K itself, not of
/// its symmetric part, so that every shape still decays with its own τ, but shapes are no longer orthogonal in C. A
/// complex pair is given as the two real shapes that span it, with the τ of its decay.
struct ThermalModes {
  Eigen::VectorXd time_constant;  ///< τ [s], slowest first
  Eigen::MatrixXd nodes;          ///< φ: nodes × modes, the largest value of each is 1; 0 at controllers' states
  Eigen::MatrixXd sensors;        ///< what each sensor of the machine sees of it; 0 for one in the air
  Eigen::MatrixXd displacements;  ///< g: channels of displacement × modes [m/K, rad/K]
  double asymmetry = 0.0;         ///< ‖A − Aᵀ‖/‖A‖, A = C^−½ K C^−½
  int complex_pairs = 0;          ///< among the modes
  std::string remark;             ///< what its user should know of the last two, or empty
};

/// Dense, and therefore for up to `largest_modal_network` nodes: thermal::InputError above, and for a count that is not
/// between 1 and the number of nodes.
inline constexpr int largest_modal_network = 2000;
[[nodiscard]] ThermalModes thermal_modes(Machine const& machine, OperatingState const& at, int count);

}  // namespace thermotwin::twin
