#include "twin/instruments/displacement_probe.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using Eigen::VectorXd;

VectorXd every(double interval, double duration) {
  auto const count = static_cast<Eigen::Index>(std::round(duration / interval));
  return VectorXd::LinSpaced(count + 1, 0.0, static_cast<double>(count) * interval);
}

DisplacementProbe ideal() {
  DisplacementProbe probe;
  probe.scale_error = probe.temperature_coefficient = probe.drift = probe.noise = 0.0;
  probe.fixture_length = probe.runout = probe.averaging_window = 0.0;
  return probe;
}

/// Displacement going from 0 to `growth` while the air warms by `warming`.
DisplacementCourse course(double growth, double warming, double duration) {
  VectorXd const time = every(duration, duration);
  VectorXd displacement(2), air(2);
  displacement << 0.0, growth;
  air << 293.15, 293.15 + warming;
  return {time, displacement, air, {}};
}

double deviation(VectorXd const& values) { return std::sqrt((values.array() - values.mean()).square().mean()); }

TEST(DisplacementProbe, IdealShowsTheDisplacementInMicrometres) {
  Readings const readings = read(ideal(), {"Z"}, course(40e-6, 2.0, 3600.0), every(60.0, 3600.0));
  for (Eigen::Index k = 0; k < 61; ++k) {
    EXPECT_NEAR(readings.values[k], 40.0 * double(k) / 60.0, 1e-10);
    EXPECT_NEAR(readings.truth[k], 40.0 * double(k) / 60.0, 1e-10);
  }
}

TEST(DisplacementProbe, ScaleErrorIsProportional) {
  DisplacementProbe probe = ideal();
  probe.scale_error = 0.02;
  EXPECT_NEAR(read(probe, {"Z"}, course(50e-6, 0.0, 600.0), every(60.0, 600.0)).values[10], 51.0, 1e-10);
}

TEST(DisplacementProbe, DriftsWithTimeAndWithTheAirWhileTheTargetStands) {
  DisplacementProbe probe = ideal();
  probe.drift = 0.2e-6 / 3600.0;
  EXPECT_NEAR(read(probe, {"Z"}, course(0.0, 0.0, 7200.0), every(60.0, 7200.0)).values[120], 0.4, 1e-10);
  probe.drift = 0.0;
  probe.temperature_coefficient = 0.15e-6;
  EXPECT_NEAR(read(probe, {"Z"}, course(0.0, 3.0, 7200.0), every(60.0, 7200.0)).values[120], 0.45, 1e-10);
}

TEST(DisplacementProbe, FixtureGrowsAfterTheAirWithItsLag) {
  DisplacementProbe probe = ideal();
  probe.fixture_length = 0.1;
  probe.fixture_lag = 600.0;
  double const t = 3600.0, rate = 3.0 / t;
  double const expected = 11e-6 * 0.1 * rate * (t - 600.0 * (1.0 - std::exp(-t / 600.0))) * 1e6;
  EXPECT_NEAR(read(probe, {"Z"}, course(0.0, 3.0, t), every(10.0, t)).values[360], expected, 1e-10);
}

TEST(DisplacementProbe, AveragesItsNoise) {
  DisplacementProbe probe = ideal();
  probe.noise = 0.05e-6;
  for (int const count : {1, 16}) {
    probe.averaging_window = 0.1 * count;
    VectorXd const values = read(probe, {"Z"}, course(0.0, 0.0, 1e5), every(10.0, 1e5)).values;
    EXPECT_NEAR(deviation(values) * std::sqrt(count) / 0.05, 1.0, 4.0 / std::sqrt(2.0 * 10000)) << count;
  }
}

TEST(DisplacementProbe, ResolutionAndFullScaleBoundTheNumbers) {
  DisplacementProbe probe = ideal();
  probe.resolution = 0.1e-6;
  probe.full_scale = 60e-6;
  VectorXd const values = read(probe, {"Z"}, course(50e-6, 0.0, 6000.0), every(13.0, 6000.0)).values;
  for (double const v : values) EXPECT_EQ(v, std::round(10.0 * v) / 10.0);
  EXPECT_NEAR(values.maxCoeff(), 30.0, 1e-9);
}

DisplacementCourse rotating(double speed, double duration) {
  DisplacementCourse result = course(0.0, 0.0, duration);
  result.spindle_speed = VectorXd::Constant(2, speed);
  return result;
}

TEST(DisplacementProbe, FullRevolutionsCancelTheRunout) {
  DisplacementProbe probe = ideal();
  probe.runout = 5e-6;
  probe.zeroed = false;
  probe.averaging_window = 0.77;
  VectorXd const whole = read(probe, {"Z"}, rotating(30.0, 600.0), every(1.7, 600.0)).values;
  EXPECT_LT(whole.cwiseAbs().maxCoeff(), 1e-9);
  probe.full_revolutions = false;
  VectorXd const cut = read(probe, {"Z"}, rotating(30.0, 600.0), every(1.7, 600.0)).values;
  double const turned = 0.77 * 30.0;
  EXPECT_LE(cut.cwiseAbs().maxCoeff(), 5.0 * std::abs(std::sin(turned / 2) / (turned / 2)) + 1e-9);
  EXPECT_GT(cut.cwiseAbs().maxCoeff(), 0.1);
}

TEST(DisplacementProbe, StandingSpindleShowsTheSameRunoutOnlyIfItIsOriented) {
  DisplacementProbe probe = ideal();
  probe.runout = 5e-6;
  VectorXd const time = every(1.0, 2000.0);
  VectorXd speed(time.size());
  for (Eigen::Index i = 0; i < time.size(); ++i) speed[i] = i % 100 < 50 ? 0.0 : 100.3;  // stops every 100 s
  DisplacementCourse const stops{time, VectorXd::Zero(time.size()), VectorXd::Constant(time.size(), 293.15), speed};
  VectorXd const at_stops = every(100.0, 1900.0).array() + 30.0;
  EXPECT_LT(read(probe, {"Z"}, stops, at_stops).values.cwiseAbs().maxCoeff(), 1e-9);
  probe.oriented_stop = false;
  EXPECT_GT(deviation(read(probe, {"Z"}, stops, at_stops).values), 1.0);
}

TEST(DisplacementProbe, MeanSineIsTheIntegralAndItsLimit) {
  EXPECT_NEAR(mean_sine(0.3, 2.1), (std::cos(0.3) - std::cos(2.1)) / 1.8, 1e-14);
  EXPECT_NEAR(mean_sine(1.0, 1.0), std::sin(1.0), 1e-15);
  EXPECT_NEAR(mean_sine(1.0, 1.0 + 1e-7), std::sin(1.0 + 0.5e-7), 1e-14);
  EXPECT_NEAR(mean_sine(0.7, 0.7 + 2.0 * std::numbers::pi), 0.0, 1e-15);
}

TEST(DisplacementProbe, DrawsWhatTheFileLeavesOpen) {
  DisplacementProbe probe;
  int capacitive_better = 0;
  for (int i = 0; i < 400; ++i) {
    InstrumentChannel const channel{"P" + std::to_string(i), 3};
    probe.kind = "eddy_current";
    auto const eddy = read(probe, channel, course(0.0, 0.0, 60.0), every(60.0, 60.0)).drawn;
    EXPECT_LE(std::abs(eddy.at("scale_error")), 0.01);
    EXPECT_GE(eddy.at("temperature_coefficient"), 0.1e-6);
    EXPECT_LE(eddy.at("temperature_coefficient"), 0.25e-6);
    EXPECT_GE(eddy.at("noise"), 0.02e-6);
    EXPECT_LE(eddy.at("noise"), 0.1e-6);
    probe.kind = "capacitive";
    auto const capacitive = read(probe, channel, course(0.0, 0.0, 60.0), every(60.0, 60.0)).drawn;
    capacitive_better += capacitive.at("temperature_coefficient") < eddy.at("temperature_coefficient") ? 1 : 0;
  }
  EXPECT_EQ(capacitive_better, 400);
}

TEST(DisplacementProbe, RefusesUnknownKindsAndCoursesThatDoNotFit) {
  DisplacementProbe probe;
  probe.kind = "inductive";
  EXPECT_THROW(read(probe, {"Z"}, course(0.0, 0.0, 60.0), every(60.0, 60.0)), thermal::InputError);
  DisplacementCourse broken = course(0.0, 0.0, 60.0);
  broken.spindle_speed = VectorXd::Zero(3);
  EXPECT_THROW(read(DisplacementProbe{}, {"Z"}, broken, every(60.0, 60.0)), thermal::InputError);
}

}  // namespace
}  // namespace thermotwin::twin
