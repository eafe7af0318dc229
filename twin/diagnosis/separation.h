#pragma once

#include <Eigen/Core>
#include <vector>

#include "twin/diagnosis/estimation.h"

namespace thermotwin::twin {

/// By which an effect counts as seen, and two as told apart, in units of the noise (physics.md 8.9).
inline constexpr double wanted_distance = 6.0;
/// At which it should be seen, of its largest plausible amplitude.
inline constexpr double usual_amplitude = 0.5;
/// Cosine of two signatures beyond which they are taken for each other (physics.md 8.9).
inline constexpr double confusable_cosine = 0.6;

/// Which of an estimation's blocks of rows are used: some of its runs, some of its channels.
struct Blocks {
  std::vector<bool> runs;      ///< by number of the run
  std::vector<bool> channels;  ///< by number of the estimation's channel
};

/// How far the signatures of effects lie apart once all that calibration can imitate is taken away (physics.md 8.9):
///
///   d_i = |s⊥_i| |ψ_i|,   d_ij = d_i √(1 − cos²(s⊥_i, s⊥_j)),   s⊥ = s − J (JᵀJ)⁻¹ Jᵀ s
///
/// in units of the noise: d_i, how clearly effect i of amplitude ψ_i is seen; d_ij, how clearly it is not effect j, of
/// whatever amplitude. Each run and channel is a block, so that one linearisation answers for every
/// choice among them.
class Separation {
 public:
  /// J of a fit and signatures, both whitened; rows as the estimation has them.
  Separation(Estimation const& estimation, Fit const& fit, Eigen::MatrixXd const& signatures);

  /// s⊥ᵢᵀ s⊥ⱼ with these blocks.
  [[nodiscard]] Eigen::MatrixXd products(Blocks const& blocks) const;

 private:
  struct Block {
    std::size_t run, channel;
    Eigen::MatrixXd nuisance, shared, own;  ///< JᵀJ, Jᵀs, sᵀs
  };
  std::vector<Block> blocks_;
  Eigen::MatrixXd prior_;
};

/// d_i, and d_ij, from `products`.
[[nodiscard]] double seen(Eigen::MatrixXd const& products, Eigen::Index i, double amplitude);
[[nodiscard]] double cosine(Eigen::MatrixXd const& products, Eigen::Index i, Eigen::Index j);
[[nodiscard]] double apart(Eigen::MatrixXd const& products, Eigen::Index i, Eigen::Index j, double amplitude);

}  // namespace thermotwin::twin
