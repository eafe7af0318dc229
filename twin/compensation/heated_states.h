#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "twin/diagnosis/warm_start.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// How warm a machine's own work makes it: states of the twin during histories that it may have had, twelve runs of
/// loads drawn at random (challenge_runs), every five minutes. What first readings d say of a machine that is warm, its
/// inputs u being known: the states x_s at which inputs and readings were alike weigh
///
///   ω_s ∝ exp(−½ Σ_c ((u_c − u_cs)/(0.1 r_c))² − |d − H x_s|²/(k (2 K)²)),
///
/// r_c the range of an input that heats, k the number of sensors; where fewer than 40 states are alike, both widths
/// grow. With their mean m and covariance Σ, and the fields F of warm_start.h for what else may have warmed it,
///
///   θ ~ N(m, Σ + κ F Fᵀ),   d = H θ + offsets,
///
/// κ the likeliest of those of which the sensors show 0.5 to 40 K rms; E[θ | d] and its covariance are those of
/// Gaussian variables (Rasmussen & Williams, Gaussian Processes for Machine Learning, 2006, A.2). So a part without a
/// sensor, a shaft, is as warm as it was in the twin when the parts with sensors were as they are now. One sensor may
/// be wrong by 10 K, where that gains 11 of 2 ln of the likelihood. Readings count twice, in ω and in d; histories
/// differ by more than either tells apart, and the deviations come out larger than the errors.
class HeatedStates {
 public:
  explicit HeatedStates(Machine const& machine);

  struct Likely {
    Eigen::VectorXd rise;        ///< E[θ | d], of every node over the air at its height [K]
    Eigen::MatrixXd covariance;  ///< [K²]
    std::string contradicted;    ///< the sensor that is wrong; empty: none
  };

  /// `otherwise`: what the same readings, four or more, say of a machine that anything may have warmed; it counts alone
  /// where the histories cannot be run, as those of a machine that needs an input beyond an experiment's.
  [[nodiscard]] Likely likely(RunBegin const& begin, WarmStart const& otherwise) const;

 private:
  /// θ = mean + root b, b ~ N(0, I), by the machine's own heat alone; nothing without states.
  struct Own {
    Eigen::VectorXd mean;
    Eigen::MatrixXd root;
  };
  [[nodiscard]] Own own(RunBegin const& begin) const;
  [[nodiscard]] Eigen::VectorXd weights(RunBegin const& begin) const;

  std::vector<std::size_t> heating_;  ///< channels of the network
  Eigen::VectorXd range_;             ///< of these, over all states
  Eigen::MatrixXd rise_;              ///< node × state [K]
  Eigen::MatrixXd inputs_;            ///< heating channel × state
};

}  // namespace thermotwin::twin
