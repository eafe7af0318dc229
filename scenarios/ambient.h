#pragma once

#include <optional>
#include <vector>

#include "scenarios/field.h"
#include "thermal/units.h"

namespace thermotwin::scenarios {

/// That a machine tool may stand in [K].
inline constexpr double coldest_air = 273.15 - 50.0, hottest_air = 273.15 + 80.0;

/// A_d cos(2π (t − t_d)/24 h); A_d = 0.5 to 4 K. (physics.md 2.13)
struct DailyCycle {
  double amplitude = 1.5;          ///< half of peak to peak [K]
  double peak_time = 15 * 3600.0;  ///< time of day of the maximum [s]

  template <class Fields>
  static void fields(Fields& f) {
    f("amplitude", &DailyCycle::amplitude, thermal::dimension::temperature_difference, "half of peak to peak",
      {0.0, 10.0});
    f("peak_time", &DailyCycle::peak_time, thermal::dimension::time, "time of day of the maximum");
  }
};

/// A_h sin(2π t/P), from the start of the run; A_h = 0.2 to 1 K, P = 5 to 40 min. (physics.md 2.13, §7 no. 12)
struct AirConditioning {
  double amplitude = 0.5;     ///< half of peak to peak [K]
  double period = 20 * 60.0;  ///< [s]

  template <class Fields>
  static void fields(Fields& f) {
    f("amplitude", &AirConditioning::amplitude, thermal::dimension::temperature_difference, "half of peak to peak",
      {0.0, 10.0});
    f("period", &AirConditioning::period, thermal::dimension::time, "of one cycle of the air conditioning",
      {0.0, unbounded});
  }
};

/// The air goes to ΔT(1 − exp(−t/τ)) while the door is open and back with the same τ; ΔT = −1 to −5 K, τ = 5 to 20 min.
/// (physics.md 2.13, §7 no. 15)
struct DoorOpening {
  double time = required;            ///< when it opens, from the start of the run [s]
  double duration = 10 * 60.0;       ///< how long it stays open [s]
  double step = -3.0;                ///< where the air would end up [K]
  double time_constant = 10 * 60.0;  ///< [s]

  template <class Fields>
  static void fields(Fields& f) {
    f("time", &DoorOpening::time, thermal::dimension::time, "when the door opens, from the start of the run",
      {0.0, unbounded});
    f("duration", &DoorOpening::duration, thermal::dimension::time, "how long it stays open", {0.0, unbounded});
    f("step", &DoorOpening::step, thermal::dimension::temperature_difference, "change of the air if it stayed open",
      {-40.0, 40.0});
    f("time_constant", &DoorOpening::time_constant, thermal::dimension::time, "of the air's change, both ways",
      {0.0, unbounded});
  }
};

/// T_a(z, t) = T̄ + A_d cos(2π(t_day − t_d)/24 h) + drift·t + Σ doors + A_h sin(2πt/P) + g_s (z − z_ref).
/// (physics.md 2.13)
struct Ambient {
  double mean = 293.15;           ///< T̄ [K]
  double drift = 0.0;             ///< [K/s]
  double stratification = 0.0;    ///< g_s [K/m]: 0.2 to 1.5 in a hall, warmer above
  double reference_height = 1.0;  ///< z_ref [m], where the other terms hold
  std::optional<DailyCycle> daily_cycle;
  std::optional<AirConditioning> air_conditioning;
  std::vector<DoorOpening> door_openings;

  template <class Fields>
  static void fields(Fields& f) {
    f.temperature("mean", &Ambient::mean, "mean air temperature", {coldest_air, hottest_air});
    f("drift", &Ambient::drift, thermal::dimension::temperature_rate, "steady change from the start of the run",
      {-20.0 / 3600.0, 20.0 / 3600.0});
    f("stratification", &Ambient::stratification, thermal::dimension::temperature_gradient,
      "rise of the air temperature with height", {-5.0, 10.0});
    f("reference_height", &Ambient::reference_height, thermal::dimension::length,
      "height over the machine's zero at which the air has the mean temperature", {-20.0, 100.0});
    f("daily_cycle", &Ambient::daily_cycle, "cosine of 24 h");
    f("air_conditioning", &Ambient::air_conditioning, "sine of some minutes");
    f("door_openings", &Ambient::door_openings, "times at which the door stands open");
  }
};

/// Air temperature [K] at the reference height, t [s] from the start of a run that starts at `start_time_of_day` [s].
double air_temperature(Ambient const& ambient, double start_time_of_day, double t);

/// Whether a door stands open; at the moment of opening yes, of closing no.
bool door_open(Ambient const& ambient, double t);

/// Throws InputError naming the field: times that cannot be, air that goes below -50 degC or above 80 degC within a
/// run.
void check(Ambient const& ambient, double start_time_of_day, double duration);

}  // namespace thermotwin::scenarios
