#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

namespace thermotwin::twin {

/// Unknowns b on which residuals depend linearly, at their best for whatever the others are (variable projection: Golub
/// & Pereyra, SIAM J. Numer. Anal. 10 (1973) 413, with a constant S):
///
///   min over b of |r − S b|² + |(b − m)/d|²,   (SᵀS + 1/d²) b = Sᵀr + m/d².
class Elimination {
 public:
  /// S: residual × unknown; m and d: of the prior of each, d > 0. `first_rows`: where blocks of rows begin, ascending,
  /// the first at 0: the offset of a channel acts in one of many, and products leave out where an unknown does nothing.
  Elimination(Eigen::MatrixXd columns, Eigen::VectorXd mean, Eigen::VectorXd const& deviation,
              std::vector<Eigen::Index> const& first_rows);

  [[nodiscard]] Eigen::MatrixXd const& columns() const { return columns_; }
  /// SᵀS + 1/d².
  [[nodiscard]] Eigen::MatrixXd const& information() const { return information_; }
  /// b.
  [[nodiscard]] Eigen::VectorXd best(Eigen::VectorXd const& residual) const;
  /// S b.
  [[nodiscard]] Eigen::VectorXd effect_of(Eigen::VectorXd const& b) const;
  /// |(b − m)/d|².
  [[nodiscard]] double prior_cost(Eigen::VectorXd const& b) const;
  /// SᵀJ, J: in the rows from there on, whole blocks of them.
  [[nodiscard]] Eigen::MatrixXd shared(Eigen::MatrixXd const& J, Eigen::Index first_row = 0) const;
  /// What is left of JᵀJ, J: derivative of the residual by others, when b follows: JᵀJ − JᵀS (SᵀS + 1/d²)⁻¹ SᵀJ.
  /// `own` is JᵀJ.
  [[nodiscard]] Eigen::MatrixXd curvature(Eigen::MatrixXd const& own, Eigen::MatrixXd const& shared) const;

 private:
  struct Block {
    Eigen::Index first = 0;
    std::vector<Eigen::Index> acting;  ///< unknowns
    Eigen::MatrixXd columns;           ///< theirs
  };
  Eigen::MatrixXd columns_;
  std::vector<Block> blocks_;         ///< those in which any unknown acts
  Eigen::VectorXd mean_, precision_;  ///< m, 1/d²
  Eigen::MatrixXd information_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace thermotwin::twin
