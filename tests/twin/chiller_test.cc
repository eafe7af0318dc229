#include <gtest/gtest.h>
#include <string>
#include <utility>

#include "scenarios/course.h"
#include "tests/thermal/function_course.h"
#include "thermal/coolant.h"
#include "thermal/integrate.h"
#include "twin/machine.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

/// A tank of 40 kJ/K under a constant load of 300 W, all but insulated.
std::string const tank = R"toml(
name = "tank"

[[lump]]
name = "tank"
heat_capacity = "40 kJ/K"

[[film]]
name = "leak"
on = "tank"
correlation = "constant"
coefficient = "1e-6 W/(m2 K)"
area = "1 m2"

[[heat]]
name = "load"
at = "tank"
power = "300 W"
while_on = "load.on"

[[chiller]]
name = "main"
cools = "tank"
power = "1000 W"
)toml";

struct Record {
  std::vector<double> time, temperature;
  thermal::IntegrationSummary summary;
};

using Inputs = std::function<double(std::string const&, double)>;

double all_on(std::string const& channel, double) {
  if (channel == "ambient.floor_temperature" || channel == "ambient.temperature") return 293.15;
  return channel == "chiller.offset" || channel == "ambient.gradient" ? 0.0 : 1.0;
}

Record run(std::string const& more, double duration, double interval, Inputs inputs = all_on,
           std::vector<double> jumps = {}) {
  Machine const machine = Machine::build(parse_toml(tank + more, "tank"));
  auto const& all = machine.network().channel_names();
  std::vector<std::string> const names(all.begin(), all.begin() + machine.network().external_channels());
  thermal::FunctionCourse const course(
      names,
      [&](double t, std::span<double> values) {
        for (std::size_t i = 0; i < names.size(); ++i) values[i] = inputs(names[i], t);
      },
      std::move(jumps));
  std::vector<double> times, start;
  for (double t = 0.0; t <= duration + 1e-9; t += interval) times.push_back(t);
  for (char const signal : machine.network().signals()) start.push_back(signal ? 0.0 : 293.15);
  Record record;
  record.summary = thermal::integrate(machine.network(), course, start, times, {}, [&](thermal::Sample const& sample) {
    record.time.push_back(sample.time);
    record.temperature.push_back(sample.temperatures[0]);
  });
  return record;
}

/// Times at which the temperature rises through a level; linear between samples, as the tank's is.
std::vector<double> rises(Record const& record, double level) {
  std::vector<double> times;
  for (std::size_t i = 1; i < record.time.size(); ++i) {
    double const before = record.temperature[i - 1], now = record.temperature[i];
    if (before < level && now >= level)
      times.push_back(record.time[i - 1] + (level - before) / (now - before) * (record.time[i] - record.time[i - 1]));
  }
  return times;
}

std::pair<double, double> extremes(Record const& record, double from) {
  double low = 1e9, high = 0.0;
  for (std::size_t i = 0; i < record.time.size(); ++i)
    if (record.time[i] >= from) {
      low = std::min(low, record.temperature[i]);
      high = std::max(high, record.temperature[i]);
    }
  return {low, high};
}

TEST(RelayChiller, CyclesWithThePeriodOfPhysics2_12) {  // V11: within 0.1 %
  auto const record = run(R"(temperature = "24 degC"
hysteresis = "1 K"
minimum_off_time = "0 s")",
                          7200.0, 1.0);
  auto const times = rises(record, 297.15);
  ASSERT_GE(times.size(), 10U);
  double const period = (times.back() - times[1]) / double(times.size() - 2);
  EXPECT_NEAR(period, thermal::relay_period<double>(40e3, 1.0, 300.0, 1000.0), 1e-3 * period);
  auto const [low, high] = extremes(record, 2000.0);
  EXPECT_NEAR(low, 296.65, 0.03);
  EXPECT_NEAR(high, 297.65, 0.03);
}

TEST(RelayChiller, WaitsBeforeItStartsAgain) {
  auto const record = run(R"(temperature = "24 degC"
hysteresis = "0.2 K"
minimum_off_time = "180 s")",
                          7200.0, 1.0);
  auto const [low, high] = extremes(record, 2000.0);
  EXPECT_NEAR(low, 297.05, 0.03);
  EXPECT_NEAR(high, 297.05 + 300.0 * 180.0 / 40e3, 0.03);
}

TEST(RelayChiller, DoesNothingWhileItIsOff) {
  auto const off = [](std::string const& channel, double t) {
    return channel == "chiller.on" ? 0.0 : all_on(channel, t);
  };
  auto const record = run("temperature = \"24 degC\"", 7200.0, 60.0, off);
  EXPECT_NEAR(record.temperature.back(), 293.15 + 300.0 * 7200.0 / 40e3, 1e-3);
  EXPECT_EQ(record.summary.relay_switches, 0);
}

TEST(RelayChiller, FollowsTheRoomAndTheOffset) {
  auto const warm = [](std::string const& channel, double t) {
    if (channel == "ambient.temperature") return 296.15;
    return channel == "chiller.offset" ? 1.5 : all_on(channel, t);
  };
  auto const record = run(R"(follows = "ambient.temperature"
offset = "-0.5 K"
hysteresis = "0.4 K"
minimum_off_time = "0 s")",
                          7200.0, 1.0, warm);
  auto const [low, high] = extremes(record, 2000.0);
  EXPECT_NEAR(0.5 * (low + high), 297.15, 0.02);
}

std::string const inverter = R"(
kind = "inverter"
temperature = "24 degC"
gain = "500 W/K"
integral_time = "100 s"
)";

TEST(InverterChiller, HoldsTheSetPointUnderAnyLoad) {
  auto const load = [](std::string const& channel, double t) {
    if (channel != "load.on") return all_on(channel, t);
    return t < 5000.0 ? 1.0 : 2.5;
  };
  auto const record = run(inverter, 9000.0, 10.0, load, {5000.0});
  EXPECT_NEAR(record.temperature[450], 297.15, 1e-3);
  EXPECT_NEAR(record.temperature.back(), 297.15, 1e-3);
  auto const [low, high] = extremes(record, 5000.0);
  EXPECT_GT(high, 297.25);  // the step of load is felt
  EXPECT_LT(high, 298.0);
}

TEST(InverterChiller, DoesNotWindUpWhileItCanDoNoMore) {
  auto const heavy = [](std::string const& channel, double t) {
    if (channel != "load.on") return all_on(channel, t);
    return t < 4000.0 ? 5.0 : 1.0;  // 1500 W, more than it has
  };
  auto const record = run(inverter, 8000.0, 10.0, heavy, {4000.0});
  auto const [low, high] = extremes(record, 4000.0);
  EXPECT_GT(high, 303.0);
  EXPECT_GT(low, 296.6);  // no long undershoot after the overload
  EXPECT_NEAR(record.temperature.back(), 297.15, 0.01);
}

TEST(InverterChiller, RestsBelowTheSetPointAndWhileItIsOff) {
  auto const idle = [](std::string const& channel, double t) {
    return channel == "load.on" ? 0.0 : all_on(channel, t);
  };
  auto const record = run(inverter, 3600.0, 60.0, idle);
  EXPECT_NEAR(record.temperature.back(), 293.15, 0.02);
  auto const off = [](std::string const& channel, double t) {
    return channel == "chiller.on" ? 0.0 : all_on(channel, t);
  };
  EXPECT_NEAR(run(inverter, 7200.0, 60.0, off).temperature.back(), 293.15 + 300.0 * 7200.0 / 40e3, 1e-3);
}

TEST(InverterChiller, StartsWithoutAPast) {
  Machine const machine = Machine::build(parse_toml(tank + inverter, "tank"));
  scenarios::Experiment experiment;
  experiment.duration = 60.0;
  scenarios::ExperimentCourse const course(experiment, machine.limits);
  auto const start = initial_temperatures(machine, experiment, course);
  EXPECT_EQ(start, (std::vector<double>{293.15, 0.0}));
}

TEST(Chiller, NeedsASetPoint) { EXPECT_THROW((void)run("", 60.0, 60.0), FileError); }

}  // namespace
}  // namespace thermotwin::twin
