#include "twin/instruments/temperature_specimen.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "thermal/error.h"
#include "twin/file/schema.h"
#include "twin/instruments/resistance_law.h"

namespace thermotwin::twin {
namespace {

std::vector<double> sorted(TemperatureSensor const& sensor,
                           std::function<double(TemperatureSpecimen const&)> const& pick) {
  std::vector<double> values;
  for (int i = 0; i < 4000; ++i) values.push_back(pick(draw_specimen(sensor, {"T" + std::to_string(i), 11})));
  std::sort(values.begin(), values.end());
  return values;
}

double rms(std::vector<double> const& values) {
  double sum = 0.0;
  for (double const v : values) sum += v * v;
  return std::sqrt(sum / double(values.size()));
}

TEST(TemperatureSpecimen, Pt100KeepsWithinItsClassAtEveryTemperature) {
  for (std::string const name : {"AA", "A", "B"}) {
    TemperatureSensor sensor;
    sensor.tolerance_class = name;
    ToleranceClass const limit = pt100_tolerance(name);
    for (double const t : {-40.0, 0.0, 20.0, 90.0}) {
      auto const errors = sorted(sensor, [&](auto const& s) { return s.offset + s.gain * t; });
      double const allowed = limit.constant + limit.slope * std::abs(t);
      EXPECT_GE(errors.front(), -allowed);
      EXPECT_LE(errors.back(), allowed);
      if (t < 0.0) continue;
      EXPECT_GT(errors.back(), 0.95 * allowed);
      // Normal with deviation 1/2 of the limit, cut at the limit: 0.5 √0.7737.
      EXPECT_NEAR(rms(errors), 0.4398 * allowed, 0.015 * allowed);
    }
  }
}

TEST(TemperatureSpecimen, Ds18b20KeepsWithinHalfAKelvin) {
  TemperatureSensor sensor;
  sensor.kind = "ds18b20";
  auto const offsets = sorted(sensor, [](auto const& s) { return s.offset; });
  EXPECT_GE(offsets.front(), -0.5);
  EXPECT_LE(offsets.back(), 0.5);
  EXPECT_NEAR(rms(offsets), 0.19, 0.01);  // 0.2 K cut at 2.5 deviations
  EXPECT_NEAR(offsets[2000], 0.0, 0.015);
}

TEST(TemperatureSpecimen, Ds18b20ConvertsFasterWithFewerBits) {
  TemperatureSensor sensor;
  sensor.kind = "ds18b20";
  EXPECT_EQ(draw_specimen(sensor, {"T1"}).conversion_interval, 0.75);
  sensor.bits = 9;
  EXPECT_EQ(draw_specimen(sensor, {"T1"}).conversion_interval, 0.09375);
  EXPECT_EQ(draw_specimen(sensor, {"T1"}).resolution, 0.5);
}

TEST(TemperatureSpecimen, MountingSetsLagAndStemLoss) {
  struct Expected {
    std::string mounting;
    double lag_low, lag_high, loss_low, loss_high;
  };
  for (auto const& e : {Expected{"screwed", 5, 15, 0.01, 0.03}, Expected{"magnet", 20, 60, 0.03, 0.08},
                        Expected{"taped", 60, 300, 0.05, 0.2}, Expected{"immersed", 5, 15, 0, 0}}) {
    TemperatureSensor sensor;
    sensor.mounting = e.mounting;
    auto const lags = sorted(sensor, [](auto const& s) { return s.lag; });
    auto const losses = sorted(sensor, [](auto const& s) { return s.stem_loss; });
    EXPECT_GE(lags.front(), e.lag_low);
    EXPECT_LE(lags.back(), e.lag_high);
    EXPECT_NEAR(lags[2000], std::sqrt(e.lag_low * e.lag_high), 0.05 * e.lag_high) << e.mounting;
    EXPECT_GE(losses.front(), e.loss_low);
    EXPECT_LE(losses.back(), e.loss_high);
    EXPECT_NEAR(losses[2000], 0.5 * (e.loss_low + e.loss_high), 0.03 * e.loss_high) << e.mounting;
  }
}

TEST(TemperatureSpecimen, CaseOfADs18b20LagsEvenWhenScrewed) {
  TemperatureSensor sensor;
  sensor.kind = "ds18b20";
  EXPECT_GE(sorted(sensor, [](auto const& s) { return s.lag; }).front(), 10.0);
}

TEST(TemperatureSpecimen, WhatTheFileGivesHolds) {
  TemperatureSensor sensor;
  sensor.offset = 0.1;
  sensor.gain = 0.002;
  sensor.drift = 1e-6;
  sensor.lag = 33.0;
  sensor.stem_loss = 0.07;
  sensor.self_heating = 0.01;
  sensor.noise = 0.003;
  auto const drawn = chance_properties(draw_specimen(sensor, {"T1"}));
  std::map<std::string, double> const expected{{"offset", 0.1},        {"gain", 0.002}, {"drift", 1e-6},
                                               {"beta_error", 0.0},    {"lag", 33.0},   {"stem_loss", 0.07},
                                               {"self_heating", 0.01}, {"noise", 0.003}};
  EXPECT_EQ(drawn, expected);
}

std::string complaint(TemperatureSensor const& sensor) {
  try {
    draw_specimen(sensor, {"T7"});
  } catch (thermal::InputError const& error) {
    return error.what();
  }
  return "none";
}

TEST(TemperatureSpecimen, ComplaintsNameTheSensorTheValueAndTheNearest) {
  TemperatureSensor sensor;
  sensor.kind = "ds18b2O";
  EXPECT_EQ(complaint(sensor), "sensor 'T7': kind 'ds18b2O' is unknown; did you mean 'ds18b20'?");
  sensor = {};
  sensor.mounting = "screwd";
  EXPECT_EQ(complaint(sensor), "sensor 'T7': mounting 'screwd' is unknown; did you mean 'screwed'?");
  sensor = {};
  sensor.bits = 16;
  EXPECT_EQ(complaint(sensor), "sensor 'T7': bits is 16; allowed is 9 to 12");
  sensor = {};
  sensor.lowest = 400.0;
  sensor.highest = 300.0;
  EXPECT_EQ(complaint(sensor), "sensor 'T7': lowest is 126.85 degC, highest 26.85 degC; they must rise");
  EXPECT_THROW(check_sensor(sensor, "T7"), thermal::InputError);
  sensor = {};
  sensor.conversion_interval = 0.0;
  EXPECT_EQ(complaint(sensor), "sensor 'T7': conversion_interval is 0 s; it must be positive");
  EXPECT_THROW(check_sensor(sensor, "T7"), thermal::InputError);
  EXPECT_NO_THROW(check_sensor({}, "T7"));
}

TEST(TemperatureSensor, ListsItsFieldsWithTheirDefaults) {
  auto const records = list_fields<TemperatureSensor>();
  auto const find = [&](std::string const& key) {
    return *std::find_if(records.begin(), records.end(), [&](auto const& r) { return r.key == key; });
  };
  EXPECT_EQ(find("correlation_time").initial, "10 min");
  EXPECT_THAT(find("lag").range, testing::HasSubstr("15 min"));
}

}  // namespace
}  // namespace thermotwin::twin
