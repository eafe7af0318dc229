#include "thermal/exponential_step.h"

#include <cmath>
#include <gtest/gtest.h>

namespace thermotwin::thermal {
namespace {

using Eigen::VectorXd;

TEST(ExponentialStep, FactorsMeetTheirDefinitionAcrossTheSeries) {
  VectorXd const rate = (VectorXd(7) << 0.0, 1e-6, 0.049999, 0.050001, 0.3, 4.0, 1e3).finished();
  ExponentialFactors factors;
  factors.set(rate, 1.0);
  for (Eigen::Index r = 0; r < rate.size(); ++r) {
    double const x = rate[r];
    // φ_k(−x) = ∫₀¹ e^{−x(1−s)} s^{k−1}/(k−1)! ds, by the midpoint rule.
    double phi[3] = {0.0, 0.0, 0.0};
    int const n = 200000;
    for (int i = 0; i < n; ++i) {
      double const s = (i + 0.5) / n, e = std::exp(-x * (1.0 - s)) / n;
      phi[0] += e;
      phi[1] += e * s;
      phi[2] += e * s * s / 2.0;
    }
    EXPECT_NEAR(factors.decay[r], std::exp(-x), 1e-14);
    EXPECT_NEAR(factors.phi1[r], phi[0], 1e-8);
    EXPECT_NEAR(factors.phi2[r], phi[1], 1e-8);
    EXPECT_NEAR(factors.phi3[r], phi[2], 1e-8);
  }
}

TEST(ExponentialStep, ConstantHeatIsExactHoweverStiff) {
  VectorXd const rate = (VectorXd(3) << 0.0, 1e-3, 50.0).finished();
  VectorXd const heat = (VectorXd(3) << 1.0, 2.0, 300.0).finished();
  ExponentialStep step(rate, [&](double, VectorXd const&, VectorXd& result) { result = heat; });
  step.restart(0.0, VectorXd::Ones(3));
  step.attempt(700.0);
  step.accept();
  EXPECT_NEAR(step.state()[0], 1.0 + 700.0, 1e-9);
  EXPECT_NEAR(step.state()[1], 2000.0 + (1.0 - 2000.0) * std::exp(-0.7), 1e-9);
  EXPECT_NEAR(step.state()[2], 6.0, 1e-9);
}

/// y' = −λ y − y² + λ: a Riccati equation; z = y − a with a² + λ a − λ = 0 gives z' = −(λ + 2a) z − z².
double riccati(double lambda, double start, double t) {
  double const a = 0.5 * (-lambda + std::sqrt(lambda * lambda + 4.0 * lambda)), k = lambda + 2.0 * a, z = start - a;
  return a + k * z * std::exp(-k * t) / (k + z * (1.0 - std::exp(-k * t)));
}

double error_with(int steps, double& halfway) {
  VectorXd const rate = VectorXd::Constant(1, 2.0);
  ExponentialStep step(
      rate, [](double, VectorXd const& y, VectorXd& result) { result = VectorXd::Constant(1, 2.0 - y[0] * y[0]); });
  step.restart(0.0, VectorXd::Constant(1, 2.0));
  halfway = 0.0;
  for (int i = 0; i < steps; ++i) {
    step.attempt(1.0 / steps);
    VectorXd seen;
    step.interpolate(0.5 / steps, seen);
    halfway = std::max(halfway, std::abs(seen[0] - riccati(2.0, 2.0, (i + 0.5) / steps)));
    step.accept();
  }
  return std::abs(step.state()[0] - riccati(2.0, 2.0, 1.0));
}

TEST(ExponentialStep, IsOfFourthOrderAndItsInterpolantOfThird) {
  double coarse_between = 0.0, fine_between = 0.0;
  double const coarse = error_with(10, coarse_between), fine = error_with(20, fine_between);
  EXPECT_GT(std::log2(coarse / fine), 3.7);
  EXPECT_GT(std::log2(coarse_between / fine_between), 2.7);
}

}  // namespace
}  // namespace thermotwin::thermal
