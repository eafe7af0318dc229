#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "thermal/units.h"
#include "twin/file/schema.h"
#include "twin/instruments/readings.h"

namespace thermotwin::twin {

/// What a sensor may read at most, not what a machine may have: -200 degC to 1800 degC.
inline constexpr Range measurable{73.15, 2073.15};

/// A temperature sensor as the machine's file describes it. What the file gives holds; what it leaves open is drawn
/// once per specimen, by kind and mounting.
///
///   T* = T_b − χ (T_b − T_a) + ΔT_self,   τ dT_s/dt = T* − T_s,   T_s(0) = T*(0)
///   y  = Quant[(1 + g) law(T_s(t − Δt_clock)) + b₀ + b₁ t + c(t) + v(t)], clipped to the range      [°C]
///
/// T_b body at the sensor's site, T_a air near it, χ contact and stem loss, g gain, b₀ offset, b₁ drift, c cold
/// junction (thermocouples), v white noise plus a first-order autoregressive one. The noise stands inside the
/// quantiser, where a real converter has it: a quantised channel shows multiples of its step and nothing else. `law` is
/// the identity unless the wires or the element's β deviate. One reading is the mean of the conversions within the
/// averaging window. (physics.md §4)
///
/// Drawn by kind (IEC 60751; DS18B20 data sheet; physics.md §4):
///
/// | kind         | offset b₀                                  | drift b₁   | ΔT_self      | noise       | step    |
/// |--------------|--------------------------------------------|------------|--------------|-------------|---------|
/// | pt100        | u (constant of the class), gain u (slope)  | 10 mK/year | 0.05…0.2 K   | 5…20 mK     | 0.01 K  |
/// | ds18b20      | normal 0.2 K, within 0.5 K                 | 20 mK/year | 0…0.02 K     | 5…20 mK     | 1/16 K  |
/// | thermistor   | normal 0.1 K, within 0.2 K; β 0.25 %       | 15 mK/year | 0.005…0.05 K | 2…10 mK     | 0.001 K |
/// | thermocouple | normal 0.5 K, within 1.5 K                 | –          | –            | 20…50 mK    | 0.01 K  |
/// | ideal        | –                                          | –          | –            | –           | –       |
///
/// u is normal with deviation 1/2 within ±1: the limit of the class is two deviations. Drawn by mounting: lag and χ of
/// `screwed` 5…15 s, 0.01…0.03; `magnet` 20…60 s, 0.03…0.08; `taped` 60…300 s, 0.05…0.2; `immersed` 5…15 s, 0. A
/// ds18b20's case lags by 10…40 s even when screwed. A cold junction drifts by 0.2 K rms within hours.
struct TemperatureSensor {
  std::string kind = "pt100";
  std::string tolerance_class = "A";  ///< of a pt100: AA, A or B
  int bits = 12;                      ///< of a ds18b20: 9 to 12; the step is 2^(8 − bits) K
  double beta = 3435.0;               ///< of a thermistor [K]
  std::string logger;                 ///< thermocouples of one logger share its cold junction
  std::string mounting = "screwed";

  std::optional<double> lag;                  ///< τ [s]
  std::optional<double> stem_loss;            ///< χ [1]
  std::optional<double> self_heating;         ///< ΔT_self = I² R/(conductance to the body) [K]
  std::optional<double> offset;               ///< b₀ [K]
  std::optional<double> gain;                 ///< g, about 0 °C [1]
  std::optional<double> drift;                ///< b₁ [K/s]; a fault is 0.02 to 0.5 K/day
  std::optional<double> beta_error;           ///< of a thermistor: (β − nominal)/nominal [1]
  std::optional<double> cold_junction;        ///< of a thermocouple: standard deviation of the drift c [K]
  std::optional<double> noise;                ///< white, of one conversion: standard deviation [K]
  double correlated_noise = 0.0;              ///< standard deviation [K]
  double correlation_time = 600.0;            ///< of the correlated noise [s]
  std::optional<double> resolution;           ///< step of the quantiser [K]
  std::optional<double> lowest;               ///< range [K]
  std::optional<double> highest;              ///< range [K]
  double lead_resistance = 0.0;               ///< of the two wires of a two-wire pt100, together [Ω]; 1 Ω reads 2.6 K
  double clock_offset = 0.0;                  ///< Δt_clock [s]: the sample bears a time later than it was taken
  double sampling_interval = 0.0;             ///< 0: with every sample of the data set [s]
  double averaging_window = 0.0;              ///< 0: one conversion [s]
  std::optional<double> conversion_interval;  ///< between two conversions [s]
  double dropout = 0.0;                       ///< probability that a reading is missing
  std::optional<double> dead_from;            ///< no reading from here on [s]

  template <class Fields>
  static void fields(Fields& f) {
    using S = TemperatureSensor;
    namespace dimension = thermal::dimension;
    auto const kelvin = dimension::temperature_difference;
    auto const number = dimension::dimensionless;
    f.choice("kind", &S::kind, {"pt100", "ds18b20", "thermistor", "thermocouple", "ideal"}, "what measures");
    f.choice("tolerance_class", &S::tolerance_class, {"AA", "A", "B"}, "of a pt100, IEC 60751");
    f("bits", &S::bits, "of a ds18b20: 12 bits make steps of 1/16 K", Range{9, 12});
    f("beta", &S::beta, kelvin, "of a thermistor", Range{2000, 5000});
    f("logger", &S::logger, "thermocouples of the same logger share the drift of its cold junction");
    f.choice("mounting", &S::mounting, {"screwed", "magnet", "taped", "immersed"},
             "how it is held; sets the range from which lag and stem loss are drawn");
    f("lag", &S::lag, dimension::time, "first-order time constant", Range{0, 900});
    f("stem_loss", &S::stem_loss, number, "share of the way from the body's to the air's temperature", Range{0, 0.3});
    f("self_heating", &S::self_heating, kelvin, "rise by the measuring current", Range{0, 0.5});
    f("offset", &S::offset, kelvin, "added to every reading", Range{-2, 2});
    f("gain", &S::gain, number, "relative error of the Celsius reading", Range{-0.05, 0.05});
    f("drift", &S::drift, dimension::temperature_rate, "change of the offset from the start of the run");
    f("beta_error", &S::beta_error, number, "of a thermistor, relative", Range{-0.02, 0.02});
    f("cold_junction", &S::cold_junction, kelvin, "drift shared by the logger's thermocouples, rms", Range{0, 1});
    f("noise", &S::noise, kelvin, "white noise of one conversion, rms", Range{0, 1});
    f("correlated_noise", &S::correlated_noise, kelvin, "first-order autoregressive noise, rms", Range{0, 1});
    f("correlation_time", &S::correlation_time, dimension::time, "of the correlated noise", Range{1, 7200});
    f("resolution", &S::resolution, kelvin, "step of the shown numbers", Range{0, 1});
    f.temperature("lowest", &S::lowest, "end of the range; lower ones show as this", measurable);
    f.temperature("highest", &S::highest, "end of the range; higher ones show as this", measurable);
    f("lead_resistance", &S::lead_resistance, dimension::resistance, "of a two-wire pt100's wires", Range{0, 5});
    f("clock_offset", &S::clock_offset, dimension::time, "by which the logger's time stamps are late");
    f("sampling_interval", &S::sampling_interval, dimension::time, "0: as the data set", Range{0, 3600});
    f("averaging_window", &S::averaging_window, dimension::time,
      "conversions up to the sample that are averaged, however close the rows are", Range{0, 600});
    f("conversion_interval", &S::conversion_interval, dimension::time, "between conversions that are averaged",
      Range{0.001, 10});
    f("dropout", &S::dropout, number, "probability that a reading is missing", Range{0, 1});
    f("dead_from", &S::dead_from, dimension::time, "no reading from here on", Range{0});
  }
};

/// What the sensor is exposed to, on the time grid of the run: linear between its points, held beyond its ends.
struct TemperatureCourse {
  Eigen::VectorXd time;  ///< [s]
  Eigen::VectorXd body;  ///< at the sensor's site [K]
  Eigen::VectorXd air;   ///< near the sensor [K]
};

/// Drift of a logger's cold junction: autoregressive with 2 h, standard deviation 1, on a grid of 60 s from t = 0 and
/// linear between; a function of seed, logger and time alone, so that all thermocouples of the logger see the same.
Eigen::VectorXd cold_junction_drift(std::string const& logger, std::uint64_t seed, Eigen::VectorXd const& time);

/// Readings [°C] at the sample times, which may be coarser than the course's grid.
Readings read(TemperatureSensor const& sensor, InstrumentChannel const& channel, TemperatureCourse const& course,
              Eigen::VectorXd const& sample_times);

}  // namespace thermotwin::twin
