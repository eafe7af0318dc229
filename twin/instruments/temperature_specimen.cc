#include "twin/instruments/temperature_specimen.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <vector>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "thermal/physical_constant.h"
#include "twin/instruments/random_stream.h"
#include "twin/instruments/resistance_law.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;
using thermal::zero_celsius;

constexpr double year = 365.25 * 86400.0;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

struct Kind {
  double offset = 0.0;  // standard deviation
  double offset_limit = 0.0;
  double drift = 0.0;  // standard deviation
  Interval self_heating;
  Interval noise;
  double resolution = 0.0;
  Interval range_degc;
  Interval case_lag;  // not faster than this, however well it is mounted
};

std::map<std::string, Kind> const kinds{
    {"pt100", {0.0, 0.0, 0.010 / year, {0.05, 0.2}, {0.005, 0.020}, 0.01, {-50, 200}, {}}},
    {"ds18b20", {0.2, 0.5, 0.020 / year, {0.0, 0.02}, {0.005, 0.020}, 0.0, {-55, 125}, {10, 40}}},
    {"thermistor", {0.1, 0.2, 0.015 / year, {0.005, 0.05}, {0.002, 0.010}, 0.001, {-40, 150}, {}}},
    {"thermocouple", {0.5, 1.5, 0.0, {}, {0.020, 0.050}, 0.01, {-200, 1000}, {}}},
    {"ideal", {0.0, 0.0, 0.0, {}, {}, 0.0, {-infinity, infinity}, {}}}};

struct Mounting {
  Interval lag;
  Interval stem_loss;
};

std::map<std::string, Mounting> const mountings{{"screwed", {{5, 15}, {0.01, 0.03}}},
                                                {"magnet", {{20, 60}, {0.03, 0.08}}},
                                                {"taped", {{60, 300}, {0.05, 0.2}}},
                                                {"immersed", {{5, 15}, {0.0, 0.0}}}};

template <class Entry>
Entry const& find(std::map<std::string, Entry> const& table, std::string const& what, std::string const& name,
                  std::string const& channel) {
  if (auto const found = table.find(name); found != table.end()) return found->second;
  std::vector<std::string> names;
  for (auto const& entry : table) names.push_back(entry.first);
  throw InputError(
      fmt::format("sensor '{}': {} '{}' is unknown; {}", channel, what, name, thermal::did_you_mean(name, names)));
}

class Draw {
 public:
  Draw(TemperatureSensor const& sensor, InstrumentChannel const& channel)
      : sensor_(sensor),
        channel_(channel),
        kind_(find(kinds, "kind", sensor.kind, channel.name)),
        mounting_(find(mountings, "mounting", sensor.mounting, channel.name)),
        ideal_(sensor.kind == "ideal") {}

  void errors(TemperatureSpecimen& s) const {
    bool const thermistor = sensor_.kind == "thermistor";
    s.offset = sensor_.offset.value_or(stream("offset").within(kind_.offset, kind_.offset_limit));
    s.gain = sensor_.gain.value_or(0.0);
    s.drift = sensor_.drift.value_or(kind_.drift * stream("drift").normal());
    s.beta_error = sensor_.beta_error.value_or(thermistor ? stream("beta_error").within(0.0025, 0.005) : 0.0);
    s.cold_junction = sensor_.cold_junction.value_or(sensor_.kind == "thermocouple" ? 0.2 : 0.0);
    s.noise = sensor_.noise.value_or(stream("noise_level").log_uniform(kind_.noise.low, kind_.noise.high));
    if (sensor_.kind == "pt100") tolerance(s);
  }

  void contact(TemperatureSpecimen& s) const {
    Interval const lag{std::max(mounting_.lag.low, kind_.case_lag.low),
                       std::max(mounting_.lag.high, kind_.case_lag.high)};
    Interval const loss = mounting_.stem_loss;
    double const heating = stream("self_heating").uniform(kind_.self_heating.low, kind_.self_heating.high);
    s.lag = sensor_.lag.value_or(ideal_ ? 0.0 : stream("lag").log_uniform(lag.low, lag.high));
    s.stem_loss = sensor_.stem_loss.value_or(ideal_ ? 0.0 : stream("stem_loss").uniform(loss.low, loss.high));
    s.self_heating = sensor_.self_heating.value_or(heating);
  }

  void converter(TemperatureSpecimen& s) const {
    bool const digital = sensor_.kind == "ds18b20";
    if (sensor_.bits < 9 || sensor_.bits > 12)
      throw InputError(fmt::format("sensor '{}': bits is {}; allowed is 9 to 12", channel_.name, sensor_.bits));
    s.resolution = sensor_.resolution.value_or(digital ? std::ldexp(1.0, 8 - sensor_.bits) : kind_.resolution);
    s.conversion_interval = sensor_.conversion_interval.value_or(digital ? std::ldexp(0.75, sensor_.bits - 12) : 0.1);
    if (!(s.conversion_interval > 0.0))
      throw InputError(fmt::format("sensor '{}': conversion_interval is {:g} s; it must be positive", channel_.name,
                                   s.conversion_interval));
    s.lowest = sensor_.lowest.value_or(kind_.range_degc.low + zero_celsius);
    s.highest = sensor_.highest.value_or(kind_.range_degc.high + zero_celsius);
    if (!(s.lowest < s.highest))
      throw InputError(fmt::format("sensor '{}': lowest is {:g} degC, highest {:g} degC; they must rise", channel_.name,
                                   s.lowest - zero_celsius, s.highest - zero_celsius));
  }

 private:
  [[nodiscard]] RandomStream stream(std::string const& property) const {
    return {channel_.seed, channel_.name + "/" + property};
  }

  void tolerance(TemperatureSpecimen& s) const {
    ToleranceClass const limit = pt100_tolerance(sensor_.tolerance_class);
    double const share = stream("tolerance").within(0.5, 1.0);
    s.offset = sensor_.offset.value_or(share * limit.constant);
    s.gain = sensor_.gain.value_or(share * limit.slope);
  }

  TemperatureSensor const& sensor_;
  InstrumentChannel const& channel_;
  Kind const& kind_;
  Mounting const& mounting_;
  bool ideal_;
};

}  // namespace

TemperatureSpecimen draw_specimen(TemperatureSensor const& sensor, InstrumentChannel const& channel) {
  Draw const draw(sensor, channel);
  TemperatureSpecimen specimen;
  draw.errors(specimen);
  draw.contact(specimen);
  draw.converter(specimen);
  return specimen;
}

void check_sensor(TemperatureSensor const& sensor, std::string const& name) {
  InstrumentChannel const channel{name};
  TemperatureSpecimen specimen;
  Draw(sensor, channel).converter(specimen);
  if (sensor.kind == "pt100") static_cast<void>(pt100_tolerance(sensor.tolerance_class));
}

std::map<std::string, double> chance_properties(TemperatureSpecimen const& s) {
  return {{"offset", s.offset},
          {"gain", s.gain},
          {"drift", s.drift},
          {"beta_error", s.beta_error},
          {"lag", s.lag},
          {"stem_loss", s.stem_loss},
          {"self_heating", s.self_heating},
          {"noise", s.noise}};
}

}  // namespace thermotwin::twin
