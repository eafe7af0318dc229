#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "output/dataset.h"
#include "scenarios/feed_program.h"
#include "thermal/units.h"
#include "twin/file/schema.h"
#include "twin/instruments/readings.h"

namespace thermotwin::twin {

/// A laser interferometer on an axis, as the machine's file describes it. What the file leaves open is drawn once.
///
///   D = [n (L_dp + s) − n₀ L_dp]/n_c − α_m L_m (T_a − T_a0),   s = x + E(x, t)        x from the first target
///   y = D (1 − α_w (T_w − 20 °C)) − x + v,   quantised
///
/// n refractive index of the air in the path at time t, n₀ when the laser was zeroed at the first target of the first
/// pass, n_c what the environment unit computes from its own, erroneous, sensors (without compensation: of air at 20
/// °C, 1013.25 hPa, 50 %). L_dp dead path, from the interferometer to the reflector at the first target: with the air
/// it drifts by L_dp (n − n₀)/n, −1.4 µm for 0.5 m and 3 K; with `dead_path_correction` the unit takes off L_dp (n_c −
/// n_c0)/n_c. L_m mount of the interferometer, which grows towards the reflector. α_w is what the material compensation
/// was told, T_w what its sensor reads. (Refraction: air_refraction.h; physics.md §4, §7 no. 36)
///
/// A pass visits the targets upwards and back. Backwards the lost motion of the axis shows. Unless the axis overruns
/// the last target, it is read there before the lost motion is taken up, and while the axis is still turning: both
/// readings of that target share an error of their own in each pass (why paper 000 evaluates 0…550 mm of 600).
///
/// Drawn, normal with half the limit as deviation, within it: environment 0.2 K, 1 hPa, 6 %; material sensor 0.1 K.
struct LaserInterferometer {
  double wavelength = 633e-9;  ///< in vacuum [m]
  bool air_compensation = true;
  std::optional<double> air_temperature_error;  ///< of the environment unit [K]
  std::optional<double> pressure_error;         ///< of the environment unit [Pa]
  std::optional<double> humidity_error;         ///< of the environment unit [1]
  double humidity = 0.5;                        ///< true, constant [1]
  double dead_path = 0.1;                       ///< L_dp [m]
  bool dead_path_correction = false;
  double mount_length = 0.0;                         ///< L_m [m]
  double mount_expansion = 11.5e-6;                  ///< α_m [1/K]
  double material_expansion = 0.0;                   ///< α_w [1/K]; 0: no compensation of the material
  std::optional<double> material_temperature_error;  ///< [K]
  double lost_motion = 2e-6;                         ///< backward less forward [m]
  bool overrun = false;                              ///< the axis goes beyond the last target before it turns
  double turning_error = 2e-6;                       ///< standard deviation at a last target without overrun [m]
  double noise = 0.1e-6;                             ///< standard deviation of one reading [m]
  double resolution = 1e-9;                          ///< [m]
  double time_per_target = 5.0;                      ///< travel and dwell [s]
  bool relative_to_first_pass = true;                ///< the errors of the first pass are taken off, per direction

  template <class Fields>
  static void fields(Fields& f) {
    using L = LaserInterferometer;
    namespace dimension = thermal::dimension;
    auto const kelvin = dimension::temperature_difference;
    auto const number = dimension::dimensionless;
    f("wavelength", &L::wavelength, dimension::length, "in vacuum", Range{400e-9, 700e-9});
    f("air_compensation", &L::air_compensation, "the environment unit corrects for the refraction of the air");
    f("air_temperature_error", &L::air_temperature_error, kelvin, "of the environment unit", Range{-1, 1});
    f("pressure_error", &L::pressure_error, dimension::pressure, "of the environment unit", Range{-500, 500});
    f("humidity_error", &L::humidity_error, number, "of the environment unit", Range{-0.2, 0.2});
    f("humidity", &L::humidity, number, "relative humidity of the air", Range{0, 1});
    f("dead_path", &L::dead_path, dimension::length, "from interferometer to reflector at the first target",
      Range{0, 5});
    f("dead_path_correction", &L::dead_path_correction, "the environment unit corrects for the dead path");
    f("mount_length", &L::mount_length, dimension::length, "of the interferometer's mount along the beam", Range{0, 1});
    f("mount_expansion", &L::mount_expansion, dimension::expansion, "of that mount", Range{0, 30e-6});
    f("material_expansion", &L::material_expansion, dimension::expansion, "to which material compensation is set",
      Range{0, 30e-6});
    f("material_temperature_error", &L::material_temperature_error, kelvin, "of its sensor", Range{-1, 1});
    f("lost_motion", &L::lost_motion, dimension::length, "backward less forward", Range{-1e-4, 1e-4});
    f("overrun", &L::overrun, "the axis goes beyond the last target before it turns");
    f("turning_error", &L::turning_error, dimension::length, "at a last target without overrun, rms", Range{0, 2e-5});
    f("noise", &L::noise, dimension::length, "of one reading, rms", Range{0, 1e-5});
    f("resolution", &L::resolution, dimension::length, "step of the shown numbers", Range{0, 1e-5});
    f("time_per_target", &L::time_per_target, dimension::time, "travel and dwell", Range{0, 60});
    f("relative_to_first_pass", &L::relative_to_first_pass, "the errors of the first pass are taken off");
  }
};

/// What the laser is exposed to.
struct LaserCourse {
  std::function<double(double position, double time)> error;  ///< E(x, t) [m], x as the targets [m], t [s]
  Eigen::VectorXd time;                                       ///< of the courses below [s]
  Eigen::VectorXd air;                                        ///< in the path [K]
  Eigen::VectorXd pressure;                                   ///< [Pa]; empty: 1013.25 hPa
  Eigen::VectorXd material;                                   ///< T_w [K]; empty: as the air
};

struct LaserReadings {
  output::Positioning readings;
  output::Positioning truth;            ///< of a perfect laser on an axis with the same lost motion
  std::map<std::string, double> drawn;  ///< [SI]
};

/// Measures at the targets and times that the experiment asks for, from 0 to `duration` [s]. Without both directions
/// the backward errors are NaN. Throws InputError where courses do not fit together.
LaserReadings read(LaserInterferometer const& laser, InstrumentChannel const& channel,
                   scenarios::LaserMeasurement const& measurement, double duration, LaserCourse const& course);

/// E(x, t) from a table, time × position [m]: linear in both, held beyond the ends.
std::function<double(double position, double time)> error_table(Eigen::VectorXd const& time, Eigen::VectorXd position,
                                                                Eigen::MatrixXd const& error);

}  // namespace thermotwin::twin
