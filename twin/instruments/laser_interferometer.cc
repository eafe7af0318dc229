#include "twin/instruments/laser_interferometer.h"

#include <fmt/format.h>
#include <limits>
#include <utility>
#include <vector>

#include "thermal/error.h"
#include "thermal/physical_constant.h"
#include "thermal/units.h"
#include "twin/instruments/air_refraction.h"
#include "twin/instruments/first_order_lag.h"
#include "twin/instruments/random_stream.h"
#include "twin/instruments/sampling.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

constexpr double um = 1e-6;

struct LaserSpecimen {
  AirState environment_error;
  double material_temperature_error;
};

LaserSpecimen draw(LaserInterferometer const& laser, InstrumentChannel const& channel) {
  auto const within = [&](std::string const& property, double limit) {
    return RandomStream(channel.seed, channel.name + "/" + property).within(0.5 * limit, limit);
  };
  return {{laser.air_temperature_error.value_or(within("air_temperature_error", 0.2)),
           laser.pressure_error.value_or(within("pressure_error", 100.0)),
           laser.humidity_error.value_or(within("humidity_error", 0.06))},
          laser.material_temperature_error.value_or(within("material_temperature_error", 0.1))};
}

Eigen::VectorXd or_constant(Eigen::VectorXd const& course, Eigen::Index points, double value) {
  return course.size() > 0 ? course : Eigen::VectorXd::Constant(points, value);
}

/// Everything between the reflector and the number on the screen.
class Beam {
 public:
  Beam(LaserInterferometer const& laser, LaserSpecimen const& specimen, LaserCourse const& course, double zeroed_at)
      : laser_(laser),
        specimen_(specimen),
        air_(course.time, course.air, 0.0),
        pressure_(course.time, or_constant(course.pressure, course.time.size(), AirState{}.pressure), 0.0),
        material_(course.time, course.material.size() > 0 ? course.material : course.air, 0.0),
        zeroed_at_(zeroed_at) {}

  /// y + x without noise: the distance shown when the reflector is `distance` from the first target.
  [[nodiscard]] double shown(double distance, double t) const {
    double const n = 1.0 + refractivity(air(t), laser_.wavelength);
    double const n_zero = 1.0 + refractivity(air(zeroed_at_), laser_.wavelength);
    double const n_unit = compensated(t);
    double const path = n / n_unit * distance + laser_.dead_path * (n - n_zero) / n_unit;
    double const correction =
        laser_.dead_path_correction ? laser_.dead_path * (n_unit - compensated(zeroed_at_)) / n_unit : 0.0;
    double const mount = laser_.mount_expansion * laser_.mount_length * (air_.at(t) - air_.at(zeroed_at_));
    double const warm = material_.at(t) + specimen_.material_temperature_error - thermal::reference_temperature;
    return (path - correction - mount) * (1.0 - laser_.material_expansion * warm);
  }

 private:
  [[nodiscard]] AirState air(double t) const { return {air_.at(t), pressure_.at(t), laser_.humidity}; }

  [[nodiscard]] double compensated(double t) const {
    if (!laser_.air_compensation) return 1.0 + refractivity(AirState{}, laser_.wavelength);
    AirState const true_air = air(t);
    AirState const& error = specimen_.environment_error;
    AirState const seen{true_air.temperature + error.temperature, true_air.pressure + error.pressure,
                        true_air.humidity + error.humidity};
    return 1.0 + refractivity(seen, laser_.wavelength);
  }

  LaserInterferometer const& laser_;
  LaserSpecimen const& specimen_;
  FirstOrderLag air_;
  FirstOrderLag pressure_;
  FirstOrderLag material_;
  double zeroed_at_;
};

/// Fills two tables, what the laser shows and what is, target after target.
class Recording {
 public:
  Recording(LaserInterferometer const& laser, InstrumentChannel const& channel, LaserCourse const& course, Beam beam,
            std::vector<double> targets)
      : laser_(laser),
        error_(course.error),
        beam_(std::move(beam)),
        targets_(std::move(targets)),
        noise_(channel.seed, channel.name + "/noise"),
        turning_(channel.seed, channel.name + "/turning") {}

  void pass(Eigen::Index row, bool both_directions, output::Positioning& shown, output::Positioning& truth) {
    auto const last = static_cast<int>(targets_.size()) - 1;
    turning_error_ = laser_.turning_error * turning_.normal();
    double t = truth.time_s[row];
    for (int i = 0; i <= last; ++i, t += laser_.time_per_target)
      visit(i, t, 0.0, shown.forward_um(row, i), truth.forward_um(row, i));
    if (!both_directions) return;
    for (int i = last; i >= 0; --i, t += laser_.time_per_target)
      visit(i, t, laser_.lost_motion, shown.backward_um(row, i), truth.backward_um(row, i));
  }

 private:
  void visit(int target, double t, double lost_motion, double& shown, double& truth) {
    double const position = targets_[static_cast<std::size_t>(target)];
    double const nominal = position - targets_.front();
    double const error = error_(position, t);
    bool const turns_here = !laser_.overrun && target + 1 == static_cast<int>(targets_.size());
    double const actual = nominal + error + (turns_here ? turning_error_ : lost_motion);
    double const y = beam_.shown(actual, t) - nominal + laser_.noise * noise_.normal();
    shown = thermal::without_rounding(quantised(y, laser_.resolution) / um);
    truth = (error + (turns_here ? 0.0 : lost_motion)) / um;
  }

  LaserInterferometer const& laser_;
  std::function<double(double, double)> const& error_;
  Beam beam_;
  std::vector<double> targets_;
  RandomStream noise_;
  RandomStream turning_;
  double turning_error_ = 0.0;
};

output::Positioning empty_table(std::string const& axis, std::vector<double> const& times,
                                std::vector<double> const& targets) {
  auto const passes = static_cast<Eigen::Index>(times.size());
  auto const places = static_cast<Eigen::Index>(targets.size());
  Eigen::MatrixXd const none = Eigen::MatrixXd::Constant(passes, places, std::numeric_limits<double>::quiet_NaN());
  return {axis, 1e3 * Eigen::Map<Eigen::VectorXd const>(targets.data(), places),
          Eigen::Map<Eigen::VectorXd const>(times.data(), passes), none, none};
}

void take_off_first_pass(output::Positioning& table) {
  for (Eigen::MatrixXd* errors : {&table.forward_um, &table.backward_um}) {
    Eigen::RowVectorXd const first = errors->row(0);
    for (auto row : errors->rowwise())
      row = row.binaryExpr(first,
                           [](double error, double zero) { return thermal::without_rounding(error - zero, zero); });
  }
}

void check(InstrumentChannel const& channel, LaserCourse const& course) {
  auto const points = course.time.size();
  auto const fits = [&](Eigen::VectorXd const& values) { return values.size() == 0 || values.size() == points; };
  if (course.air.size() != points || !fits(course.pressure) || !fits(course.material))
    throw InputError(
        fmt::format("laser '{}': {} times, {} air temperatures, {} pressures, {} material temperatures; "
                    "as many are due",
                    channel.name, points, course.air.size(), course.pressure.size(), course.material.size()));
  if (!course.error) throw InputError(fmt::format("laser '{}': there is no axis to measure", channel.name));
}

}  // namespace

LaserReadings read(LaserInterferometer const& laser, InstrumentChannel const& channel,
                   scenarios::LaserMeasurement const& measurement, double duration, LaserCourse const& course) {
  check(channel, course);
  std::vector<double> const targets = scenarios::targets(measurement);
  std::vector<double> const times = scenarios::measurement_times(measurement, duration);
  LaserSpecimen const specimen = draw(laser, channel);
  Recording recording(laser, channel, course, Beam(laser, specimen, course, times.front()), targets);

  output::Positioning shown = empty_table(measurement.axis, times, targets);
  output::Positioning truth = shown;
  for (Eigen::Index row = 0; row < truth.time_s.size(); ++row)
    recording.pass(row, measurement.both_directions, shown, truth);
  if (laser.relative_to_first_pass) {
    take_off_first_pass(shown);
    take_off_first_pass(truth);
  }
  AirState const& environment = specimen.environment_error;
  return {shown,
          truth,
          {{"air_temperature_error", environment.temperature},
           {"pressure_error", environment.pressure},
           {"humidity_error", environment.humidity},
           {"material_temperature_error", specimen.material_temperature_error}}};
}

std::function<double(double, double)> error_table(Eigen::VectorXd const& time, Eigen::VectorXd position,
                                                  Eigen::MatrixXd const& error) {
  if (error.rows() != time.size() || error.cols() != position.size())
    throw InputError(fmt::format("the table of position errors is {} x {}; {} times x {} positions are due",
                                 error.rows(), error.cols(), time.size(), position.size()));
  std::vector<FirstOrderLag> places;
  for (Eigen::Index i = 0; i < position.size(); ++i) places.emplace_back(time, error.col(i), 0.0);
  return [places = std::move(places), position = std::move(position)](double x, double t) {
    Eigen::VectorXd profile(position.size());
    for (Eigen::Index i = 0; i < profile.size(); ++i) profile[i] = places[static_cast<std::size_t>(i)].at(t);
    return FirstOrderLag(position, profile, 0.0).at(x);
  };
}

}  // namespace thermotwin::twin
