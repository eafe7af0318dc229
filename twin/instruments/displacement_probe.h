#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "thermal/units.h"
#include "twin/file/schema.h"
#include "twin/instruments/readings.h"

namespace thermotwin::twin {

/// An eddy-current or capacitive probe in its fixture, as the machine's file describes it. What the file leaves open is
/// drawn once per specimen.
///
///   d(t) = E(t) + α_f L_f θ_f(t) + c_p θ_a(t) + b t + r̄(t),   τ_f dθ_f/dt = θ_a − θ_f
///   y    = Quant[clip((1 + ε) d + v)] − y(t₀)                                                            [µm]
///
/// E > 0: the target comes nearer. θ_a = T_a − T_a(0) air near the probe, θ_f the fixture, which follows it and grows
/// towards the target; c_p temperature coefficient of probe and electronics; b drift; v white noise of one conversion.
/// A reading is the mean of the conversions in the averaging window; r̄ = mean over the window of the runout a sin φ
/// with φ = φ₀ + ∫ω dt. Averaged over full revolutions it is zero; a spindle that stands shows a sin φ. (physics.md §4,
/// §7 no. 35)
///
/// Drawn: ε normal 0.5 % (eddy_current) or 0.2 % (capacitive) within two deviations; c_p 0.02…0.05 or 0.005…0.02 % of
/// the full scale per kelvin; b normal 0.02 µm/h; v 0.02…0.1 µm; φ₀ even.
struct DisplacementProbe {
  std::string kind = "eddy_current";
  double full_scale = 0.5e-3;                     ///< the reading ends at ± half of it [m]
  std::optional<double> scale_error;              ///< ε [1]
  std::optional<double> temperature_coefficient;  ///< c_p [m/K]
  std::optional<double> drift;                    ///< b [m/s]; a fault is 0.05 to 0.5 µm/h
  std::optional<double> noise;                    ///< standard deviation of v [m]
  double fixture_length = 0.02;                   ///< L_f, from where the fixture is held to the probe's face [m]
  double fixture_expansion = 11e-6;               ///< α_f [1/K]
  double fixture_lag = 600.0;                     ///< τ_f [s]
  double runout = 1e-6;                           ///< amplitude a, of the target and its electric unevenness [m]
  bool full_revolutions = true;                   ///< the window is cut to a whole number of revolutions, if it has one
  bool oriented_stop = true;                      ///< the spindle always stops at the same angle φ₀
  bool zeroed = true;                             ///< readings are changes from the first one
  double resolution = 0.0;                        ///< step of the shown numbers [m]; 0: none
  double sampling_interval = 0.0;                 ///< 0: with every sample of the data set [s]
  double averaging_window = 1.0;                  ///< [s]
  double conversion_interval = 0.1;               ///< between the conversions that are averaged [s]
  double dropout = 0.0;                           ///< probability that a reading is missing

  template <class Fields>
  static void fields(Fields& f) {
    using P = DisplacementProbe;
    namespace dimension = thermal::dimension;
    f.choice("kind", &P::kind, {"eddy_current", "capacitive"}, "what measures");
    f("full_scale", &P::full_scale, dimension::length, "readings end at plus and minus half of it", Range{1e-6, 0.01});
    f("scale_error", &P::scale_error, dimension::dimensionless, "relative error of the scale", Range{-0.05, 0.05});
    f("temperature_coefficient", &P::temperature_coefficient, dimension::growth_per_kelvin,
      "of probe and electronics, per kelvin of the air", Range{-1e-6, 1e-6});
    f("drift", &P::drift, dimension::speed, "steady change from the start of the run");
    f("noise", &P::noise, dimension::length, "white noise of one conversion, rms", Range{0, 1e-6});
    f("fixture_length", &P::fixture_length, dimension::length, "from where the fixture is held to the probe's face",
      Range{0, 1});
    f("fixture_expansion", &P::fixture_expansion, dimension::expansion, "of the fixture", Range{0, 30e-6});
    f("fixture_lag", &P::fixture_lag, dimension::time, "with which the fixture follows the air", Range{0, 7200});
    f("runout", &P::runout, dimension::length, "amplitude at the target, once per revolution", Range{0, 50e-6});
    f("full_revolutions", &P::full_revolutions, "the averaging covers a whole number of revolutions");
    f("oriented_stop", &P::oriented_stop, "the spindle always stops at the same angle");
    f("zeroed", &P::zeroed, "readings are changes from the first one");
    f("resolution", &P::resolution, dimension::length, "step of the shown numbers; 0: none", Range{0, 1e-5});
    f("sampling_interval", &P::sampling_interval, dimension::time, "0: as the data set", Range{0, 3600});
    f("averaging_window", &P::averaging_window, dimension::time, "before each sample", Range{0, 60});
    f("conversion_interval", &P::conversion_interval, dimension::time, "between conversions that are averaged",
      Range{1e-4, 1});
    f("dropout", &P::dropout, dimension::dimensionless, "probability that a reading is missing", Range{0, 1});
  }
};

/// What the probe is exposed to, on the time grid of the run: linear between its points, held beyond its ends.
struct DisplacementCourse {
  Eigen::VectorXd time;           ///< [s]
  Eigen::VectorXd displacement;   ///< towards the probe [m]
  Eigen::VectorXd air;            ///< near the probe [K]
  Eigen::VectorXd spindle_speed;  ///< [rad/s]; empty: stands
};

/// InputError for an unknown kind or a conversion interval that is not positive.
void check_probe(DisplacementProbe const& probe, std::string const& name);

/// Readings [µm] at the sample times. Throws InputError as check_probe does, and for a course that does not fit
/// together.
Readings read(DisplacementProbe const& probe, InstrumentChannel const& channel, DisplacementCourse const& course,
              Eigen::VectorXd const& sample_times);

/// Mean of sin φ while φ goes evenly from `from` to `to`: (cos from − cos to)/(to − from); sin where they meet.
double mean_sine(double from, double to);

}  // namespace thermotwin::twin
