#include "twin/instruments/temperature_sensor.h"

#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "thermal/error.h"
#include "thermal/physical_constant.h"

namespace thermotwin::twin {
namespace {

using Eigen::VectorXd;
using thermal::zero_celsius;

VectorXd every(double interval, double duration) {
  auto const count = static_cast<Eigen::Index>(std::round(duration / interval));
  return VectorXd::LinSpaced(count + 1, 0.0, static_cast<double>(count) * interval);
}

TemperatureCourse steady(double body_degc, double air_degc) {
  VectorXd const time = every(3600.0, 3600.0);
  return {time, VectorXd::Constant(2, body_degc + zero_celsius), VectorXd::Constant(2, air_degc + zero_celsius)};
}

TemperatureCourse ramp(double from_degc, double rate, double duration) {
  VectorXd const time = every(duration, duration);
  VectorXd const body = VectorXd::Constant(2, from_degc + zero_celsius) + rate * time;
  return {time, body, body};
}

/// Without any error; each test adds the one that it is about.
TemperatureSensor ideal() {
  TemperatureSensor sensor;
  sensor.kind = "ideal";
  return sensor;
}

double deviation(VectorXd const& values) { return std::sqrt((values.array() - values.mean()).square().mean()); }

bool same_bytes(VectorXd const& a, VectorXd const& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), sizeof(double) * std::size_t(a.size())) == 0;
}

TEST(TemperatureSensor, IdealShowsTheBodyInCelsiusAndSoDoesTheTruth) {
  Readings const readings = read(ideal(), {"T1"}, ramp(20.0, 1e-3, 6000.0), every(60.0, 6000.0));
  VectorXd const expected = VectorXd::Constant(101, 20.0) + 1e-3 * every(60.0, 6000.0);
  EXPECT_LT((readings.values - expected).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_TRUE(same_bytes(readings.values, readings.truth));
}

// V12 of physics.md §9.
TEST(TemperatureSensor, LagsARampByItsClosedForm) {
  TemperatureSensor sensor = ideal();
  sensor.lag = 120.0;
  double const rate = 0.004;
  VectorXd const times = every(30.0, 1200.0);
  Readings const readings = read(sensor, {"T1"}, ramp(20.0, rate, 1200.0), times);
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    double const t = times[k];
    EXPECT_NEAR(readings.values[k], 20.0 + rate * (t - 120.0 * (1.0 - std::exp(-t / 120.0))), 1e-12);
    EXPECT_NEAR(readings.truth[k], 20.0 + rate * t, 1e-12);
  }
}

TEST(TemperatureSensor, ReadsBetweenBodyAndAirByItsStemLoss) {
  TemperatureSensor sensor = ideal();
  sensor.stem_loss = 0.1;
  sensor.self_heating = 0.15;
  Readings const readings = read(sensor, {"T1"}, steady(40.0, 20.0), every(60.0, 600.0));
  EXPECT_NEAR(readings.values[5], 40.0 - 0.1 * 20.0 + 0.15, 1e-12);
}

TEST(TemperatureSensor, StartsSettled) {
  TemperatureSensor sensor = ideal();
  sensor.lag = 900.0;
  sensor.stem_loss = 0.2;
  Readings const readings = read(sensor, {"T1"}, steady(30.0, 20.0), every(60.0, 3600.0));
  EXPECT_LT(deviation(readings.values), 1e-12);
}

TEST(TemperatureSensor, AddsOffsetGainAndDrift) {
  TemperatureSensor sensor = ideal();
  sensor.offset = 0.3;
  sensor.gain = -0.01;
  sensor.drift = 0.5 / 86400.0;
  Readings const readings = read(sensor, {"T1"}, steady(50.0, 20.0), every(21600.0, 86400.0));
  EXPECT_NEAR(readings.values[0], 0.99 * 50.0 + 0.3, 1e-12);
  EXPECT_NEAR(readings.values[4] - readings.values[0], 0.5, 1e-12);
  EXPECT_EQ(readings.drawn.at("offset"), 0.3);
}

TEST(TemperatureSensor, ClockThatIsLateShowsThePast) {
  TemperatureSensor sensor = ideal();
  sensor.clock_offset = 45.0;
  Readings const readings = read(sensor, {"T1"}, ramp(20.0, 0.01, 600.0), every(60.0, 600.0));
  EXPECT_NEAR(readings.values[0], 20.0, 1e-12);
  EXPECT_NEAR(readings.values[5], 20.0 + 0.01 * (300.0 - 45.0), 1e-12);
}

TEST(TemperatureSensor, TwoWiresReadTheirOwnResistance) {
  TemperatureSensor sensor = ideal();
  sensor.kind = "pt100";
  sensor.offset = sensor.gain = sensor.drift = sensor.self_heating = sensor.stem_loss = sensor.noise = 0.0;
  sensor.resolution = 0.0;
  sensor.lead_resistance = 1.0;
  double const shown = read(sensor, {"T1"}, steady(30.0, 30.0), every(60.0, 60.0)).values[0];
  EXPECT_NEAR(shown - 30.0, 1.0 / (0.39083 - 2 * 5.775e-5 * 30.0), 1e-3);
}

TEST(TemperatureSensor, ThermistorWithAnotherBetaIsRightAt25DegreesOnly) {
  TemperatureSensor sensor;
  sensor.kind = "thermistor";
  sensor.offset = sensor.drift = sensor.self_heating = sensor.stem_loss = sensor.noise = sensor.resolution = 0.0;
  sensor.beta_error = 0.005;
  EXPECT_NEAR(read(sensor, {"T1"}, steady(25.0, 25.0), every(60.0, 60.0)).values[0], 25.0, 1e-10);
  double const shown = read(sensor, {"T1"}, steady(60.0, 60.0), every(60.0, 60.0)).values[0];
  double const expected = 1.0 / (1 / 298.15 + 1.005 * (1 / 333.15 - 1 / 298.15)) - zero_celsius;
  EXPECT_NEAR(shown, expected, 1e-10);
  EXPECT_GT(shown, 60.15);
}

TEST(Ds18b20, ShowsMultiplesOfItsStep) {
  TemperatureSensor sensor;
  sensor.kind = "ds18b20";
  for (auto const& [bits, step] : {std::pair{12, 1.0 / 16}, {11, 1.0 / 8}, {10, 1.0 / 4}, {9, 1.0 / 2}}) {
    sensor.bits = bits;
    Readings const readings = read(sensor, {"T1"}, ramp(18.0, 1e-3, 7200.0), every(10.0, 7200.0));
    for (double const value : readings.values) EXPECT_EQ(value / step, std::round(value / step));
    EXPECT_GT(readings.values.maxCoeff(), readings.values.minCoeff() + 6.0);
  }
}

TEST(TemperatureSensor, ShowsNoDigitsBelowItsResolution) {
  TemperatureSensor sensor = ideal();
  sensor.resolution = 0.01;
  Readings const readings = read(sensor, {"T1"}, ramp(20.0, 1e-3, 3600.0), every(10.0, 3600.0));
  for (double const value : readings.values) EXPECT_EQ(value, std::round(100.0 * value) / 100.0);
}

TEST(Ds18b20, QuantisationErrorOfAMovingSignalIsTheStepOverRootTwelve) {
  TemperatureSensor sensor = ideal();
  sensor.resolution = 0.0625;
  Readings const readings = read(sensor, {"T1"}, ramp(20.0, 1e-3, 36000.0), every(7.0, 35000.0));
  VectorXd const error = readings.values - readings.truth;
  EXPECT_NEAR(deviation(error), 0.0625 / std::sqrt(12.0), 0.0002);
  EXPECT_LE(error.cwiseAbs().maxCoeff(), 0.0625 / 2 + 1e-12);
}

TEST(Ds18b20, IsBlindWithinItsStepWithoutNoise) {
  TemperatureSensor sensor = ideal();
  sensor.resolution = 0.0625;
  Readings const readings = read(sensor, {"T1"}, ramp(20.0, 0.03 / 3600.0, 3600.0), every(60.0, 3600.0));
  EXPECT_EQ(deviation(readings.values), 0.0);
}

TEST(Ds18b20, EndsAtItsRange) {
  TemperatureSensor sensor;
  sensor.kind = "ds18b20";
  EXPECT_EQ(read(sensor, {"T1"}, steady(180.0, 180.0), every(60.0, 60.0)).values[0], 125.0);
  EXPECT_EQ(read(sensor, {"T1"}, steady(-80.0, -80.0), every(60.0, 60.0)).values[0], -55.0);
}

TEST(TemperatureSensor, AveragingLowersWhiteNoiseByTheRootOfTheCount) {
  TemperatureSensor sensor = ideal();
  sensor.noise = 0.02;
  sensor.conversion_interval = 1.0;
  for (int const count : {1, 4, 25}) {
    sensor.averaging_window = count;
    Readings const readings = read(sensor, {"T1"}, steady(30.0, 30.0), every(60.0, 600000.0));
    EXPECT_NEAR(deviation(readings.values) * std::sqrt(count) / 0.02, 1.0, 4.0 / std::sqrt(2.0 * 10000)) << count;
  }
}

TEST(TemperatureSensor, AveragingWindowShowsItsMiddle) {
  TemperatureSensor sensor = ideal();
  sensor.conversion_interval = 1.0;
  sensor.averaging_window = 31.0;
  Readings const readings = read(sensor, {"T1"}, ramp(20.0, 0.01, 600.0), every(60.0, 600.0));
  EXPECT_NEAR(readings.values[4], 20.0 + 0.01 * (240.0 - 15.0), 1e-12);
}

/// A jump has gone in by a tenth after one of ten minutes, though rows are one minute apart.
TEST(TemperatureSensor, AveragesOverAWindowLongerThanTheTimeBetweenItsRows) {
  TemperatureSensor sensor = ideal();
  sensor.conversion_interval = 1.0;
  sensor.averaging_window = 600.0;
  TemperatureCourse const jump{VectorXd{{0.0, 3600.0, 3600.001, 7200.0}}, VectorXd{{293.15, 293.15, 303.15, 303.15}},
                               VectorXd{{293.15, 293.15, 303.15, 303.15}}};
  VectorXd const values = read(sensor, {"T1"}, jump, every(60.0, 7200.0)).values;
  EXPECT_NEAR(values[0], 20.0, 1e-12);
  EXPECT_NEAR(values[60], 20.0, 1e-12);
  for (int minute = 1; minute <= 10; ++minute) EXPECT_NEAR(values[60 + minute], 20.0 + minute, 1e-9) << minute;
  EXPECT_NEAR(values[75], 30.0, 1e-9);
}

TEST(TemperatureSensor, CorrelatedNoiseDecaysExponentially) {
  TemperatureSensor sensor = ideal();
  sensor.correlated_noise = 0.05;
  sensor.correlation_time = 300.0;
  VectorXd const v = read(sensor, {"T1"}, steady(30.0, 30.0), every(60.0, 6e6)).values.array() - 30.0;
  double const variance = v.squaredNorm() / double(v.size());
  EXPECT_NEAR(std::sqrt(variance), 0.05, 0.002);
  for (int const lag : {1, 5, 10}) {
    double const covariance = v.head(v.size() - lag).dot(v.tail(v.size() - lag)) / double(v.size() - lag);
    EXPECT_NEAR(covariance / variance, std::exp(-lag * 60.0 / 300.0), 0.03) << lag;
  }
}

TEST(TemperatureSensor, DropsOutAtTheGivenRateWithoutChangingTheOthers) {
  TemperatureSensor sensor = ideal();
  sensor.noise = 0.01;
  VectorXd const times = every(1.0, 40000.0);
  VectorXd const whole = read(sensor, {"T1"}, steady(30.0, 30.0), times).values;
  sensor.dropout = 0.03;
  VectorXd const holed = read(sensor, {"T1"}, steady(30.0, 30.0), times).values;
  int missing = 0;
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    missing += std::isnan(holed[k]) ? 1 : 0;
    EXPECT_TRUE(std::isnan(holed[k]) || holed[k] == whole[k]);
  }
  EXPECT_NEAR(missing / 40000.0, 0.03, 4.0 * std::sqrt(0.03 * 0.97 / 40000.0));
}

TEST(TemperatureSensor, DiesAndSamplesByItsOwnClock) {
  TemperatureSensor sensor = ideal();
  sensor.dead_from = 500.0;
  sensor.sampling_interval = 120.0;
  VectorXd const values = read(sensor, {"T1"}, steady(30.0, 30.0), every(60.0, 600.0)).values;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    bool const present = k % 2 == 0 && double(k) * 60.0 < 500.0;
    EXPECT_EQ(!std::isnan(values[k]), present) << k;
  }
}

TEST(TemperatureSensor, SameSeedGivesTheSameBytesAndAnotherSeedOthers) {
  TemperatureSensor const sensor;
  auto const course = ramp(20.0, 1e-3, 3600.0);
  VectorXd const times = every(10.0, 3600.0);
  VectorXd const once = read(sensor, {"T1", 5}, course, times).values;
  EXPECT_TRUE(same_bytes(once, read(sensor, {"T1", 5}, course, times).values));
  EXPECT_FALSE(same_bytes(once, read(sensor, {"T1", 6}, course, times).values));
  EXPECT_FALSE(same_bytes(once, read(sensor, {"T2", 5}, course, times).values));
}

TEST(TemperatureSensor, ReadingsDoNotDependOnWhichOtherChannelsWereReadBefore) {
  TemperatureSensor const sensor;
  auto const course = steady(30.0, 20.0);
  VectorXd const times = every(60.0, 3600.0);
  std::vector<VectorXd> forwards, backwards;
  for (int i = 0; i < 4; ++i) forwards.push_back(read(sensor, {"T" + std::to_string(i)}, course, times).values);
  for (int i = 3; i >= 0; --i) backwards.push_back(read(sensor, {"T" + std::to_string(i)}, course, times).values);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(same_bytes(forwards[i], backwards[3 - i]));
}

TEST(TemperatureSensor, FixingOnePropertyLeavesTheOthersDrawnAsBefore) {
  TemperatureSensor sensor;
  auto const course = steady(30.0, 20.0);
  VectorXd const times = every(60.0, 36000.0);
  sensor.resolution = 0.0;
  Readings const before = read(sensor, {"T1"}, course, times);
  sensor.offset = before.drawn.at("offset") + 0.25;
  Readings const after = read(sensor, {"T1"}, course, times);
  for (auto const& [name, value] : before.drawn) {
    if (name != "offset") {
      EXPECT_EQ(value, after.drawn.at(name)) << name;
    }
  }
  EXPECT_LT(((after.values - before.values).array() - 0.25).abs().maxCoeff(), 1e-12);
}

TEST(Thermocouple, ChannelsOfOneLoggerShareTheirColdJunction) {
  TemperatureSensor sensor = ideal();
  sensor.kind = "thermocouple";
  sensor.offset = sensor.noise = sensor.lag = sensor.stem_loss = sensor.resolution = 0.0;
  sensor.logger = "left";
  auto const course = steady(30.0, 30.0);
  VectorXd const times = every(60.0, 86400.0);
  VectorXd const one = read(sensor, {"T1"}, course, times).values;
  VectorXd const two = read(sensor, {"T2"}, course, times).values;
  sensor.logger = "right";
  VectorXd const other = read(sensor, {"T3"}, course, times).values;
  EXPECT_TRUE(same_bytes(one, two));
  EXPECT_GT(deviation(one), 0.05);
  EXPECT_GT(deviation(one - other), 0.05);
}

TEST(Thermocouple, ColdJunctionDoesNotDependOnTheSamplingOfAChannel) {
  VectorXd const fine = cold_junction_drift("left", 1, every(10.0, 7200.0));
  VectorXd const coarse = cold_junction_drift("left", 1, every(120.0, 3600.0));
  for (Eigen::Index k = 0; k < coarse.size(); ++k) EXPECT_DOUBLE_EQ(coarse[k], fine[12 * k]);
}

TEST(Thermocouple, ColdJunctionDriftHasUnitVariance) {
  VectorXd const drift = cold_junction_drift("left", 1, every(600.0, 7200.0 * 4000));
  EXPECT_NEAR(drift.squaredNorm() / double(drift.size()), 1.0, 0.08);
}

TEST(TemperatureSensor, RefusesCoursesThatDoNotFit) {
  TemperatureCourse course = steady(30.0, 20.0);
  course.air.resize(1);
  EXPECT_THROW(read(TemperatureSensor{}, {"T1"}, course, every(60.0, 60.0)), thermal::InputError);
  course = steady(30.0, 20.0);
  course.body[1] = std::nan("");
  EXPECT_THROW(read(TemperatureSensor{}, {"T1"}, course, every(60.0, 60.0)), thermal::InputError);
}

}  // namespace
}  // namespace thermotwin::twin
