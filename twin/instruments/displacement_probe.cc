#include "twin/instruments/displacement_probe.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "thermal/units.h"
#include "twin/instruments/averaging_window.h"
#include "twin/instruments/first_order_lag.h"
#include "twin/instruments/random_stream.h"
#include "twin/instruments/sampling.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

constexpr double revolution = 2.0 * std::numbers::pi;
constexpr double micrometre = 1e-6;

struct ProbeSpecimen {
  double scale_error;
  double temperature_coefficient;
  double drift;
  double noise;
  double phase;
};

ProbeSpecimen draw(DisplacementProbe const& probe, InstrumentChannel const& channel) {
  auto const stream = [&](std::string const& property) {
    return RandomStream(channel.seed, channel.name + "/" + property);
  };
  bool const eddy = probe.kind == "eddy_current";
  double const scale = eddy ? 0.005 : 0.002;
  double const low = eddy ? 2e-4 : 0.5e-4;
  double const high = eddy ? 5e-4 : 2e-4;
  double const coefficient = probe.full_scale * stream("temperature_coefficient").uniform(low, high);
  return {probe.scale_error.value_or(stream("scale_error").within(scale, 2.0 * scale)),
          probe.temperature_coefficient.value_or(coefficient),
          probe.drift.value_or(0.02e-6 / 3600.0 * stream("drift").normal()),
          probe.noise.value_or(stream("noise_level").log_uniform(0.02e-6, 0.1e-6)),
          stream("phase").uniform(0.0, revolution)};
}

void check(InstrumentChannel const& channel, DisplacementCourse const& course) {
  auto const points = course.time.size();
  bool const speed_fits = course.spindle_speed.size() == 0 || course.spindle_speed.size() == points;
  if (points == 0 || course.displacement.size() != points || course.air.size() != points || !speed_fits)
    throw InputError(
        fmt::format("probe '{}': {} times, {} displacements, {} air temperatures, {} speeds; as many are "
                    "due, and at least one",
                    channel.name, points, course.displacement.size(), course.air.size(), course.spindle_speed.size()));
}

/// Angle of the spindle over time, and what is left of the runout in an averaged reading.
class Runout {
 public:
  Runout(DisplacementProbe const& probe, DisplacementCourse const& course, double phase)
      : probe_(probe), phase_(phase), turning_(course.spindle_speed.size() > 0) {
    if (!turning_) return;
    speed_.emplace(course.time, course.spindle_speed.cwiseAbs(), 0.0);
    Eigen::VectorXd angle = Eigen::VectorXd::Zero(course.time.size());
    for (Eigen::Index i = 1; i < angle.size(); ++i)
      angle[i] = angle[i - 1] + 0.5 * (std::abs(course.spindle_speed[i]) + std::abs(course.spindle_speed[i - 1])) *
                                    (course.time[i] - course.time[i - 1]);
    angle_.emplace(course.time, angle, 0.0);
  }

  [[nodiscard]] double mean(double t) const {
    bool const stands = !turning_ || speed_->at(t) == 0.0;
    if (stands && (probe_.oriented_stop || !turning_)) return probe_.runout * std::sin(phase_);
    double const end = phase_ + angle_->at(t);
    double turned = speed_->at(t) * probe_.averaging_window;
    if (probe_.full_revolutions && turned >= revolution) turned = revolution * std::floor(turned / revolution);
    return probe_.runout * mean_sine(end - turned, end);
  }

 private:
  DisplacementProbe const& probe_;
  double phase_;
  bool turning_;
  std::optional<FirstOrderLag> speed_;
  std::optional<FirstOrderLag> angle_;
};

/// What the probe would show without noise and runout [m].
FirstOrderLag apparent(DisplacementProbe const& probe, ProbeSpecimen const& specimen,
                       DisplacementCourse const& course) {
  Eigen::VectorXd const air = course.air.array() - course.air[0];
  FirstOrderLag const fixture(course.time, air, probe.fixture_lag);
  Eigen::VectorXd const growth =
      course.time.unaryExpr([&](double t) { return probe.fixture_expansion * probe.fixture_length * fixture.at(t); });
  return {course.time,
          course.displacement + growth + specimen.temperature_coefficient * air + specimen.drift * course.time, 0.0};
}

class Conversion {
 public:
  Conversion(DisplacementProbe const& probe, ProbeSpecimen const& specimen, InstrumentChannel const& channel,
             DisplacementCourse const& course)
      : probe_(probe),
        specimen_(specimen),
        apparent_(apparent(probe, specimen, course)),
        runout_(probe, course, specimen.phase),
        noise_(channel.seed, channel.name + "/noise"),
        window_(probe.averaging_window, probe.conversion_interval) {}

  double reading(double t) {
    double const runout = runout_.mean(t);
    double const end = 0.5 * probe_.full_scale;
    return window_.mean(t, [&](double at) {
      double const gap = apparent_.at(at) + runout;
      double const shown = (1.0 + specimen_.scale_error) * gap + specimen_.noise * noise_.normal();
      return quantised(std::clamp(shown, -end, end), probe_.resolution);
    });
  }

 private:
  DisplacementProbe const& probe_;
  ProbeSpecimen const& specimen_;
  FirstOrderLag apparent_;
  Runout runout_;
  RandomStream noise_;
  AveragingWindow window_;
};

}  // namespace

void check_probe(DisplacementProbe const& probe, std::string const& name) {
  std::vector<std::string> const kinds{"eddy_current", "capacitive"};
  if (std::find(kinds.begin(), kinds.end(), probe.kind) == kinds.end())
    throw InputError(fmt::format("probe '{}': kind '{}' is unknown; {}", name, probe.kind,
                                 thermal::did_you_mean(probe.kind, kinds)));
  if (!(probe.conversion_interval > 0.0))
    throw InputError(
        fmt::format("probe '{}': conversion_interval is {:g} s; it must be positive", name, probe.conversion_interval));
}

double mean_sine(double from, double to) {
  double const half = 0.5 * (to - from);
  double const spread = std::abs(half) < 1e-8 ? 1.0 : std::sin(half) / half;
  return std::sin(0.5 * (from + to)) * spread;
}

Readings read(DisplacementProbe const& probe, InstrumentChannel const& channel, DisplacementCourse const& course,
              Eigen::VectorXd const& sample_times) {
  check_probe(probe, channel.name);
  check(channel, course);
  ProbeSpecimen const specimen = draw(probe, channel);
  Conversion conversion(probe, specimen, channel, course);
  FirstOrderLag const target(course.time, course.displacement, 0.0);
  std::vector<bool> const served = due(sample_times, probe.sampling_interval);

  Readings readings{Eigen::VectorXd::Constant(sample_times.size(), std::numeric_limits<double>::quiet_NaN()),
                    sample_times.unaryExpr([&](double t) { return target.at(t) / micrometre; }),
                    {{"scale_error", specimen.scale_error},
                     {"temperature_coefficient", specimen.temperature_coefficient},
                     {"drift", specimen.drift},
                     {"noise", specimen.noise}}};
  for (Eigen::Index k = 0; k < sample_times.size(); ++k)
    if (served[static_cast<std::size_t>(k)])
      readings.values[k] = thermal::without_rounding(conversion.reading(sample_times[k]) / micrometre);
  if (probe.zeroed && readings.values.size() > 0)
    for (double const zero = readings.values[0]; double& value : readings.values)
      value = thermal::without_rounding(value - zero, zero);
  drop_out(readings.values, sample_times, channel, probe.dropout, std::numeric_limits<double>::infinity());
  return readings;
}

}  // namespace thermotwin::twin
