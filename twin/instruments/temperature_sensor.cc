#include "twin/instruments/temperature_sensor.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "thermal/error.h"
#include "thermal/physical_constant.h"
#include "thermal/units.h"
#include "twin/instruments/averaging_window.h"
#include "twin/instruments/correlated_noise.h"
#include "twin/instruments/first_order_lag.h"
#include "twin/instruments/random_stream.h"
#include "twin/instruments/resistance_law.h"
#include "twin/instruments/sampling.h"
#include "twin/instruments/temperature_specimen.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;
using thermal::zero_celsius;

constexpr double cold_junction_time = 7200.0;
constexpr double cold_junction_step = 60.0;
constexpr double nominal_thermistor = 10e3;  // Ω at 25 °C; cancels

void check(TemperatureCourse const& course, InstrumentChannel const& channel) {
  if (course.body.size() != course.time.size() || course.air.size() != course.time.size())
    throw InputError(fmt::format("sensor '{}': {} times, {} temperatures of the body, {} of the air; as many are due",
                                 channel.name, course.time.size(), course.body.size(), course.air.size()));
  if (!course.body.allFinite() || !course.air.allFinite())
    throw InputError(fmt::format("sensor '{}': the temperatures that it is exposed to must be finite", channel.name));
}

/// Temperature of the sensing element.
FirstOrderLag element(TemperatureSpecimen const& specimen, TemperatureCourse const& course) {
  Eigen::VectorXd const exposed = course.body - specimen.stem_loss * (course.body - course.air) +
                                  Eigen::VectorXd::Constant(course.time.size(), specimen.self_heating);
  return {course.time, exposed, specimen.lag};
}

/// What the logger computes by the nominal law from an element whose resistance departs from it [°C].
double indicated(TemperatureSensor const& sensor, TemperatureSpecimen const& specimen, double temperature) {
  if (sensor.kind == "pt100" && sensor.lead_resistance > 0.0)
    return pt100_temperature(pt100_resistance(temperature) + sensor.lead_resistance) - zero_celsius;
  if (sensor.kind == "thermistor" && specimen.beta_error != 0.0) {
    double const actual = sensor.beta * (1.0 + specimen.beta_error);
    double const resistance = thermistor_resistance(temperature, nominal_thermistor, actual);
    return thermistor_temperature(resistance, nominal_thermistor, sensor.beta) - zero_celsius;
  }
  return temperature - zero_celsius;
}

/// From the element to the shown number, one conversion after another.
class Converter {
 public:
  Converter(TemperatureSensor const& sensor, TemperatureSpecimen const& specimen, InstrumentChannel const& channel,
            TemperatureCourse const& course)
      : sensor_(sensor),
        specimen_(specimen),
        element_(element(specimen, course)),
        white_(channel.seed, channel.name + "/noise"),
        correlated_({channel.seed, channel.name + "/correlated_noise"}, sensor.correlated_noise,
                    sensor.correlation_time),
        window_(sensor.averaging_window, specimen.conversion_interval) {}

  double convert(double t, double cold_junction) {
    double const celsius = indicated(sensor_, specimen_, element_.at(t - sensor_.clock_offset));
    double const noise = specimen_.noise * white_.normal() + correlated_.at(t);
    double const analogue = (1.0 + specimen_.gain) * celsius + specimen_.offset + specimen_.drift * t +
                            specimen_.cold_junction * cold_junction + noise;
    return std::clamp(quantised(analogue, specimen_.resolution), specimen_.lowest - zero_celsius,
                      specimen_.highest - zero_celsius);
  }

  double reading(double t, double cold_junction) {
    double const mean = window_.mean(t, [&](double at) { return convert(at, cold_junction); });
    return specimen_.resolution > 0.0 ? thermal::without_rounding(mean, zero_celsius) : mean;
  }

 private:
  TemperatureSensor const& sensor_;
  TemperatureSpecimen const& specimen_;
  FirstOrderLag element_;
  RandomStream white_;
  CorrelatedNoise correlated_;
  AveragingWindow window_;
};

}  // namespace

Eigen::VectorXd cold_junction_drift(std::string const& logger, std::uint64_t seed, Eigen::VectorXd const& time) {
  double const end = time.size() > 0 ? std::max(time.maxCoeff(), 0.0) : 0.0;
  auto const points = static_cast<Eigen::Index>(std::ceil(end / cold_junction_step)) + 1;
  CorrelatedNoise noise({seed, "cold junction of " + logger}, 1.0, cold_junction_time);
  Eigen::VectorXd grid(points);
  Eigen::VectorXd drift(points);
  for (Eigen::Index i = 0; i < points; ++i) {
    grid[i] = static_cast<double>(i) * cold_junction_step;
    drift[i] = noise.at(grid[i]);
  }
  FirstOrderLag const course(grid, drift, 0.0);
  return time.unaryExpr([&](double t) { return course.at(t); });
}

Readings read(TemperatureSensor const& sensor, InstrumentChannel const& channel, TemperatureCourse const& course,
              Eigen::VectorXd const& sample_times) {
  check(course, channel);
  TemperatureSpecimen const specimen = draw_specimen(sensor, channel);
  Converter converter(sensor, specimen, channel, course);
  FirstOrderLag const body(course.time, course.body, 0.0);
  Eigen::VectorXd const cold_junction = cold_junction_drift(sensor.logger, channel.seed, sample_times);
  std::vector<bool> const served = due(sample_times, sensor.sampling_interval);

  Readings readings{Eigen::VectorXd::Constant(sample_times.size(), std::numeric_limits<double>::quiet_NaN()),
                    sample_times.unaryExpr([&](double t) { return body.at(t) - zero_celsius; }),
                    chance_properties(specimen)};
  for (Eigen::Index k = 0; k < sample_times.size(); ++k)
    if (served[static_cast<std::size_t>(k)]) readings.values[k] = converter.reading(sample_times[k], cold_junction[k]);
  drop_out(readings.values, sample_times, channel, sensor.dropout,
           sensor.dead_from.value_or(std::numeric_limits<double>::infinity()));
  return readings;
}

}  // namespace thermotwin::twin
