#pragma once

#include <Eigen/Core>
#include <vector>

namespace thermotwin::twin {

/// amplitude · sin(2π (q − from)/period + phase)
struct Harmonic {
  double amplitude = 0.0;  ///< [m] or [rad]
  double period = 0.1;     ///< along the axis [m]
  double phase = 0.0;      ///< [rad]
};

/// A measured or computed course: linear between its points, held beyond the ends.
struct ErrorTable {
  Eigen::VectorXd positions;  ///< ascending [m]
  Eigen::VectorXd values;     ///< [m] or [rad]

  [[nodiscard]] double operator()(double q) const;
};

/// One error element of a linear axis along its travel: the sum of what is given.
///
///   e(q) = Σ_k c_k uᵏ + Σ_h A_h sin(2π (q − from)/λ_h + φ_h) + Σ_t table_t(q),   u = (q − from)/(to − from)
///
/// q command of the axis [m]; e in m (translations) or rad (rotations). The coefficients c_k have the unit of e.
struct ErrorCourse {
  double from = 0.0, to = 1.0;  ///< travel [m]
  std::vector<double> polynomial;
  std::vector<Harmonic> harmonics;
  std::vector<ErrorTable> tables;

  [[nodiscard]] double operator()(double q) const;
};

}  // namespace thermotwin::twin
