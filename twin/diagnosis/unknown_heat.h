#pragma once

#include <Eigen/Core>
#include <vector>

#include "twin/diagnosis/residual_model.h"

namespace thermotwin::twin {

/// Heat into one node whose course nobody knows: a random walk, dq = √S_q dβ.
struct HeatSource {
  Eigen::Index node = 0;
  double intensity = 0.03;  ///< √S_q [W/√s]; 0: constant
};

/// q(t), one value per row of the data.
struct HeatCourse {
  Eigen::VectorXd heat;            ///< [W]
  Eigen::VectorXd standard_error;  ///< [W]
};

struct HeatEstimate {
  HeatCourse filtered;          ///< from the rows up to each: what was to be known by then
  HeatCourse smoothed;          ///< from all rows
  double log_likelihood = 0.0;  ///< ln L = −½ Σ (eᵀ S⁻¹ e + ln |2π S|) of the innovations e ~ N(0, S)
  double nis = 0.0;             ///< Σ eᵀ S⁻¹ e over the number of samples: 1 if the model is right
};

/// q(t) into one node: Kalman filter with Joseph's update on (δy, q), then the fixed-interval smoother.
///
/// The smoother is that of Rauch, Tung and Striebel in the form of Bryson and Frazier (Bierman, Automatica 9 (1973)
/// 503): the same estimate and error from the adjoint λ and its covariance Λ,
///
///   λ ← Fᵀ (λ − Hᵀ Kᵀ λ − Hᵀ S⁻¹ e),   q̂ = q_k − p·λ,   var q̂ = P_qq − pᵀ Λ p,   p: column of P that belongs to q.
///
/// It inverts S, which has the size of the channels, and never P, which is singular where nothing disturbs a node.
/// Särkkä, Bayesian Filtering and Smoothing (2013), algorithms 4.2 and 8.2. Missing samples are left out one by one.
[[nodiscard]] HeatEstimate estimate_heat(ResidualModel const& model, Eigen::MatrixXd const& residuals,
                                         HeatSource const& source);

/// A node as the place of the unknown heat, with the intensity that fits best.
struct RankedSource {
  HeatSource source;
  double gain = 0.0;    ///< ln L − ln L of "no source"
  double weight = 0.0;  ///< posterior probability among all nodes of the scan and "no source", equal before the data
  double nis = 0.0;
};

struct HeatScan {
  std::vector<RankedSource> ranking;  ///< best first
  double weight_without = 0.0;        ///< posterior probability of "no source"
  double nis_without = 0.0;
};

/// Tries every node with every intensity [W/√s] and ranks the nodes by the gain in log-likelihood.
[[nodiscard]] HeatScan scan_for_heat(ResidualModel const& model, Eigen::MatrixXd const& residuals,
                                     std::vector<Eigen::Index> const& nodes,
                                     std::vector<double> const& intensities = {0.003, 0.03, 0.3});

/// The same for several sets of residuals with the same gaps, whose covariances are then computed once: thresholds
/// from many healthy runs, several runs of one spectrum.
[[nodiscard]] std::vector<HeatScan> scan_for_heat(ResidualModel const& model,
                                                  std::vector<Eigen::MatrixXd> const& residuals,
                                                  std::vector<Eigen::Index> const& nodes,
                                                  std::vector<double> const& intensities = {0.003, 0.03, 0.3});

}  // namespace thermotwin::twin
