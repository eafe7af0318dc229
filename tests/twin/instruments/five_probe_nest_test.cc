#include "twin/instruments/five_probe_nest.h"

#include <cmath>
#include <gtest/gtest.h>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using Eigen::VectorXd;

FiveColumns some_errors(Eigen::Index rows) {
  FiveColumns errors(rows, 5);
  for (Eigen::Index i = 0; i < rows; ++i)
    errors.row(i) << 12e-6 * std::sin(double(i)), -30e-6 * std::cos(double(i)), 55e-6 * double(i) / double(rows),
        20e-6 * std::cos(0.3 * double(i)), -35e-6 * std::sin(0.7 * double(i));
  return errors;
}

DisplacementProbe silent() {
  DisplacementProbe probe;
  probe.scale_error = probe.temperature_coefficient = probe.drift = probe.noise = 0.0;
  probe.fixture_length = probe.runout = 0.0;
  probe.averaging_window = 0.0;
  probe.zeroed = false;
  return probe;
}

TEST(FiveProbeNest, ReturnsExactlyWhatWentIn) {
  for (std::string const direction : {"+z", "-z"}) {
    FiveProbeNest nest;
    nest.bar_points_to = direction;
    FiveColumns const errors = some_errors(40);
    FiveColumns const back = spindle_errors(nest, probe_displacements(nest, errors));
    EXPECT_LT((back - errors).cwiseAbs().maxCoeff(), 1e-19) << direction;
  }
}

// physics.md (3.4), and the geometry behind it: a rotation B about Y moves a point at height z by B z along X.
TEST(FiveProbeNest, TiltIsTheDifferenceOverTheDistance) {
  FiveProbeNest nest;
  FiveColumns seen(1, 5);
  seen << 4e-6, 5e-6, 1e-6, 3e-6, 7e-6;
  FiveColumns const errors = spindle_errors(nest, seen);
  EXPECT_NEAR(errors(0, 4), (4e-6 - 1e-6) / 0.1, 1e-18);
  EXPECT_NEAR(errors(0, 3), -(5e-6 - 3e-6) / 0.1, 1e-18);
  EXPECT_NEAR(errors(0, 0), 1e-6 - 0.05 * 30e-6, 1e-18);
  EXPECT_NEAR(errors(0, 2), 7e-6, 1e-18);
  nest.bar_points_to = "-z";
  FiveColumns const tilted = (FiveColumns(1, 5) << 0.0, 0.0, 0.0, 0.0, 10e-6).finished();
  EXPECT_NEAR(probe_displacements(nest, tilted)(0, 0), -0.15 * 10e-6, 1e-18);
}

TEST(FiveProbeNest, ReadingsWithoutNoiseReturnTheErrors) {
  FiveProbeNest nest;
  nest.radial = nest.axial = silent();
  VectorXd const time = VectorXd::LinSpaced(40, 0.0, 39.0 * 60.0);
  NestReadings const readings = read(nest, {"nest"}, {time, some_errors(40), VectorXd::Constant(40, 293.15), {}}, time);
  EXPECT_LT((readings.errors - 1e6 * some_errors(40)).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((readings.truth_probes - readings.probes).cwiseAbs().maxCoeff(), 1e-10);
}

// physics.md §3.3: 0.1 µm of noise over 0.1 m make 1.4 µrad.
TEST(FiveProbeNest, ResolvesTiltAsItsNoiseAllows) {
  FiveProbeNest nest;
  nest.radial = nest.axial = silent();
  nest.radial.noise = 0.1e-6;
  VectorXd const time = VectorXd::LinSpaced(20001, 0.0, 20000.0);
  NestReadings const readings =
      read(nest, {"nest"}, {time, FiveColumns::Zero(20001, 5), VectorXd::Constant(20001, 293.15), {}}, time);
  for (int const column : {3, 4}) {
    VectorXd const tilt = readings.errors.col(column);
    EXPECT_NEAR(std::sqrt(tilt.squaredNorm() / 20001.0), std::sqrt(2.0) * 0.1 / 0.1, 0.03) << column;
  }
}

TEST(FiveProbeNest, WarmFixtureLooksLikeDisplacementButNotLikeTilt) {
  FiveProbeNest nest;
  nest.radial = nest.axial = silent();
  nest.radial.fixture_length = nest.axial.fixture_length = 0.1;
  nest.radial.fixture_lag = nest.axial.fixture_lag = 0.0;
  VectorXd const time = VectorXd::LinSpaced(2, 0.0, 3600.0);
  VectorXd air(2);
  air << 293.15, 295.15;
  NestReadings const readings = read(nest, {"nest"}, {time, FiveColumns::Zero(2, 5), air, {}}, time);
  EXPECT_NEAR(readings.errors(1, 0), 11e-6 * 0.1 * 2.0 * 1e6, 1e-9);
  EXPECT_NEAR(readings.errors(1, 2), 2.2, 1e-9);
  EXPECT_NEAR(readings.errors(1, 3), 0.0, 1e-9);
  EXPECT_NEAR(readings.errors(1, 4), 0.0, 1e-9);
}

TEST(FiveProbeNest, ProbesAreChannelsOfTheirOwn) {
  FiveProbeNest const nest;
  VectorXd const time = VectorXd::LinSpaced(2, 0.0, 60.0);
  auto const drawn =
      read(nest, {"nest"}, {time, FiveColumns::Zero(2, 5), VectorXd::Constant(2, 293.15), {}}, time).drawn;
  EXPECT_EQ(drawn.size(), 20U);
  EXPECT_NE(drawn.at("X1.scale_error"), drawn.at("X2.scale_error"));
}

TEST(FiveProbeNest, NeedsTwoPlaces) {
  FiveProbeNest nest;
  nest.near_distance = nest.far_distance;
  EXPECT_THROW(spindle_errors(nest, FiveColumns::Zero(1, 5)), thermal::InputError);
}

}  // namespace
}  // namespace thermotwin::twin
