#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "thermal/network.h"

namespace thermotwin::twin {

class Machine;
struct MeasuredRun;

/// How far each part of a machine was from rest with its room when a run began: a second run on one day, a logger that
/// was switched on over lunch, a bed that is colder than the hall in the morning. What heat has left in a network is
/// smooth along what conducts:
///
///   θ ~ N(0, κ K⁻¹),   K = −C ∂(dT/dt)/∂T,
///
/// K the conductances between nodes and to the room [W/K], made symmetric. The sensors' first readings differ from what
/// they would be at rest by d = H θ, their offsets and a start that is warmer throughout,
///
///   d ~ N(0, σ_o² I + σ_s² 1 1ᵀ + κ H K⁻¹ Hᵀ),
///
/// and κ is the likeliest. With K⁻¹ = F Fᵀ, θ = √κ F b, b ~ N(0, I), of which E[b | d] = √κ (H F)ᵀ cov(d)⁻¹ d
/// (Rasmussen & Williams, Gaussian Processes for Machine Learning, 2006, 2.1).
///
/// Some machines stand cooler than their room, by a tank that evaporates or a foundation, or warmer. How far one had
/// come to that, t with nothing switched on, nobody recorded: θ is t b more, b ~ N(0, 1), and cov(d) H t (H t)ᵀ more.
struct WarmStart {
  std::vector<std::string> nodes;
  Eigen::MatrixXd fields;  ///< node × field, √κ F and t, the columns that are more than next to nothing [K]
  Eigen::VectorXd likely;  ///< E[b | d]
  std::string farthest;    ///< of d, for people: "T1 +6.4 K, T2 +6.3 K, T5 +6.0 K"

  /// The fields in a machine that has these nodes and perhaps more, as a mass that was left out: what else it has is as
  /// warm as what it conducts to.
  [[nodiscard]] Eigen::MatrixXd fields_in(thermal::Network const& network) const;
};

/// What a machine's sensors on bodies read where a run begins.
struct FirstReadings {
  std::vector<std::string> sensors;
  Eigen::MatrixXd weights;  ///< H, sensor × node: what they show of a field
  Eigen::VectorXd rise;     ///< d [K]
};

/// What is known where a run begins.
struct RunBegin {
  std::vector<double> rest;      ///< of every node, at rest with its room [K]
  std::vector<double> given;     ///< to the network [SI]
  std::vector<double> standing;  ///< of that, what a machine that stands is given: temperatures and the room
  FirstReadings first;
};

/// Nothing where the machine may have been at rest: unless t or some κ gains 11 of 2 ln of the likelihood over none,
/// whichever sensor is left out. Where `another_has_past`, another run of the machine that does not begin at rest, any
/// gain suffices, and of κ where this one has stood.
[[nodiscard]] std::optional<WarmStart> warm_start(Machine const& machine, RunBegin const& begin,
                                                  bool another_has_past = false);

/// The same of a run, which has its course and channels. Nothing where it has a past before its readings.
[[nodiscard]] std::optional<WarmStart> warm_start(Machine const& machine, MeasuredRun const& run,
                                                  bool another_has_past = false);

/// Of every node where the run begins, most likely [K].
[[nodiscard]] std::vector<double> start_of(Machine const& machine, MeasuredRun const& run);

}  // namespace thermotwin::twin
