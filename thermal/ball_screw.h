#pragma once

#include <span>
#include <vector>

namespace thermotwin::thermal {

/// Error of position of a semi-closed loop along a ball screw (physics.md 3.8). x runs from the fixed bearing.
///
///   E(x) = ΔN/k₁ + ∫₀ˣ α θ dx' + ΔN x/(EA),  ΔN: change of the axial force, tension positive
///
/// * free or floating far end: ΔN = 0, E = ∫ αθ dx;
/// * fixed at both ends: the warm screw takes the pretension off, ΔN = −k_eff (Δ_th − Δ_seat), Δ_th = ∫₀ᴸ αθ dx,
///   1/k_eff = L/(EA) + 1/k₁ + 1/k₂. The start of the screw moves by ΔN/k₁.
/// * unilateral supports: once N = N₀ + ΔN would turn to pressure, the far support is left with the share
///   `released_stiffness` of its stiffness, and E(x) goes on with the slope of the free screw.
struct BallScrew {
  enum class Support { fixed_free, fixed_supported, fixed_fixed };

  Support support = Support::fixed_supported;
  double expansion = 11.8e-6;        ///< α [1/K]
  double section_area = 0.0;         ///< A [m²]
  double youngs_modulus = 2.06e11;   ///< E [Pa]
  double stiffness_fixed = 0.9e9;    ///< k₁ of the bearing at x = 0 and its seat [N/m]
  double stiffness_far = 0.9e9;      ///< k₂ of the bearing at x = L and its seat [N/m]
  double preload_temperature = 3.0;  ///< warming that relieves the pretension: δ₀ = α L ΔT_pre [K]
  bool unilateral = true;
  double released_stiffness = 0.0;  ///< share of k₂ that is left under pressure, 0…1
  std::vector<double> edges;        ///< of the cells along the screw, from 0 to L [m]

  [[nodiscard]] double length() const { return edges.back(); }

  /// ∫₀ˣ α θ dx' [m], θ [K] piecewise constant over the cells.
  [[nodiscard]] double free_growth(double x, std::span<double const> rise) const;

  /// Pretension N₀ [N].
  [[nodiscard]] double pretension() const;

  /// ΔN [N] for a free growth Δ_th [m], less the seats' relative movement [m].
  [[nodiscard]] double force_change(double growth) const;

  /// E(x) [m]; seat_growth: by how much the seats have moved apart [m].
  [[nodiscard]] double position_error(double x, std::span<double const> rise, double seat_growth = 0.0) const;
};

}  // namespace thermotwin::thermal
