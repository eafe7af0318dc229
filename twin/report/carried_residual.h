#pragma once

#include <Eigen/Core>
#include <vector>

#include "thermal/geometry.h"
#include "twin/structural_loop.h"

namespace thermotwin::twin {

/// What sensors show, carried to all cells of the bodies that they see. Ordinary kriging with a linear variogram, which
/// in space is the biharmonic spline (Matheron 1973, Adv. Appl. Prob. 5, 439; Sandwell 1987, Geophys. Res. Lett. 14,
/// 139), body by body:
///
///   f(x) = a_b + Σⱼ cⱼ γⱼ(x),   γⱼ(x) = Σₖ wⱼₖ |x − xₖ|   over the cells k of the body b that x is in
///   Σⱼ cⱼ Σₖ∈b wⱼₖ = 0   for every body,   Σₖ wᵢₖ f(xₖ) = sᵢ   for every sensor
///
/// x centres of cells [m], sᵢ what sensor i shows, wᵢ the cells that it sees (Σₖ wᵢₖ = 1). Read through the sensors'
/// own weights the field gives back exactly what they show; one sensor makes a body constant, two make it straight
/// between them and constant beyond; there is no length to choose. Where sensors contradict one another (they see the
/// same cells) they are met in least squares; what they leave open stays as near to their mean as it can.
///
/// Bodies know of one another only through sensors that see several. One that none sees is NaN.
class ResidualCarrier {
 public:
  /// `sensors`: what each sees of the network's nodes; empty: it hangs in the air.
  ResidualCarrier(thermal::Geometry const& geometry, std::vector<NodeWeights> const& sensors);

  /// Per node, from the sensors' values in their order; NaN: a sensor that shows nothing.
  [[nodiscard]] Eigen::VectorXd operator()(Eigen::VectorXd const& shown) const;

 private:
  Eigen::VectorXi body_;  ///< of each node; −1: it has no place
  int n_bodies_ = 0;
  Eigen::MatrixXd variogram_;  ///< γⱼ at the nodes: node × sensor [m]
  Eigen::MatrixXd weights_;    ///< sensor × node
};

}  // namespace thermotwin::twin
