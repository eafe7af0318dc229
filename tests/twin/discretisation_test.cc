#include "twin/diagnosis/discretisation.h"

#include <cmath>
#include <gtest/gtest.h>

namespace thermotwin::twin {
namespace {

/// d(position)/dt = speed, speed a random walk: F = [1 t; 0 1], Q = W [t³/3 t²/2; t²/2 t].
TEST(Discretisation, OfADoubleIntegrator) {
  double const t = 60.0, intensity = 0.3;
  Eigen::Matrix2d dynamics;
  dynamics << 0.0, 1.0, 0.0, 0.0;
  auto const result = discretise(dynamics, Eigen::Vector2d(0.0, intensity), t);
  Eigen::Matrix2d transition, noise;
  transition << 1.0, t, 0.0, 1.0;
  noise << t * t * t / 3.0, t * t / 2.0, t * t / 2.0, t;
  noise *= intensity * intensity;
  EXPECT_TRUE(result.transition.isApprox(transition, 1e-12)) << result.transition;
  EXPECT_TRUE(result.noise.isApprox(noise, 1e-12)) << result.noise;
}

/// dx = −a x dt + w dβ: F = exp(−a t), Q = w²/2a (1 − exp(−2 a t)), from slow to a thousand times faster than sampled.
TEST(Discretisation, OfADecayWhateverItsRate) {
  for (double rate : {1e-6, 1e-3, 0.1, 1.0, 20.0}) {
    auto const result = discretise(Eigen::MatrixXd::Constant(1, 1, -rate), Eigen::VectorXd::Constant(1, 2.0), 60.0);
    double const decay = std::exp(-60.0 * rate);
    EXPECT_NEAR(result.transition(0, 0), decay, 1e-10 * decay) << rate;
    double const noise = -2.0 / rate * std::expm1(-120.0 * rate);
    EXPECT_NEAR(result.noise(0, 0), noise, 1e-10 * noise) << rate;
  }
}

/// Two half steps make one: F(2t) = F², Q(2t) = Q + F Q Fᵀ; fast and slow nodes side by side.
TEST(Discretisation, OfTwoHalvesIsThatOfTheWhole) {
  Eigen::Matrix3d dynamics;
  dynamics << -8.0, 8.0, 0.0, 0.02, -0.03, 0.01, 0.0, 1e-4, -1e-4;
  Eigen::Vector3d const intensity(0.1, 0.0, 0.3);
  auto const half = discretise(dynamics, intensity, 30.0), whole = discretise(dynamics, intensity, 60.0);
  Eigen::Matrix3d const transition = half.transition * half.transition;
  Eigen::Matrix3d const noise = half.noise + half.transition * half.noise * half.transition.transpose();
  EXPECT_TRUE(whole.transition.isApprox(transition, 1e-11));
  EXPECT_TRUE(whole.noise.isApprox(noise, 1e-11));
}

}  // namespace
}  // namespace thermotwin::twin
