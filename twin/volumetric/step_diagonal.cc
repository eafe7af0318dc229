#include "twin/volumetric/step_diagonal.h"

#include <cmath>
#include <fmt/format.h>
#include <string>

#include "twin/instruments/random_stream.h"

namespace thermotwin::twin {
namespace {

/// A direction that deviates from u by normal angles.
Eigen::Vector3d misaligned(Eigen::Vector3d const& u, double deviation, RandomStream random) {
  Eigen::Vector3d const across = u.unitOrthogonal(), third = u.cross(across);
  double const first = deviation * random.normal(), second = deviation * random.normal();
  return (u + first * across + second * third).normalized();
}

/// True distances from the first stop along the beam.
Eigen::VectorXd distances(PoseFunction const& pose, Eigen::Matrix3Xd const& stops, Eigen::Vector3d const& normal,
                          Eigen::Vector3d const& beam) {
  Eigen::Vector3d const start = pose(stops.col(0)).translation();
  Eigen::VectorXd along(stops.cols());
  for (Eigen::Index i = 0; i < stops.cols(); ++i) {
    auto const here = pose(stops.col(i));
    Eigen::Vector3d const n = here.linear() * normal;
    along[i] = n.dot(here.translation() - start) / n.dot(beam);
  }
  return along;
}

/// What the instrument shows of them: the mean of the passes. Stops go to evenly spaced targets, whose differences
/// from the true distances are the error that the instrument sees.
Eigen::VectorXd shown(LaserInterferometer const& laser, InstrumentChannel const& channel,
                      Eigen::VectorXd const& distance, StepDiagonalDescription const& how) {
  auto const last = distance.size() - 1;
  double const length = distance[last], pitch = length / double(last);
  Eigen::VectorXd const targets = Eigen::VectorXd::LinSpaced(distance.size(), 0.0, length);
  scenarios::LaserMeasurement measurement;
  measurement.axis = channel.name;
  measurement.interval = laser.time_per_target * double(distance.size());
  measurement.to = length;
  measurement.pitch = pitch;
  measurement.both_directions = false;
  double const duration = measurement.interval * (how.passes - 0.5);
  LaserCourse course;
  course.error = [&](double x, double) {
    auto const i = std::min<Eigen::Index>(Eigen::Index(x / pitch + 0.5), last);
    return distance[i] - targets[i];
  };
  course.time = Eigen::Vector2d(0.0, duration + measurement.interval);
  course.air = how.air_temperature + how.air_drift * course.time.array();
  auto const readings = read(laser, channel, measurement, duration, course);
  return 1e-6 * readings.readings.forward_um.colwise().mean().transpose() + targets;
}

}  // namespace

Eigen::Vector3d diagonal_signs(int k) {
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if (k > 0) signs[k - 1] = -1.0;
  return signs;
}

Eigen::Vector3d diagonal_direction(int k, Workspace const& workspace) {
  return diagonal_signs(k).cwiseProduct(workspace.travel()).normalized();
}

Eigen::Matrix3Xd diagonal_stops(int k, Workspace const& workspace, int steps) {
  Eigen::Vector3d const signs = diagonal_signs(k);
  Eigen::Matrix3Xd stops(3, 3 * steps + 1);
  for (int axis = 0; axis < 3; ++axis) {
    double const first = signs[axis] > 0 ? workspace.from[axis] : workspace.to[axis];
    for (int i = 0; i <= 3 * steps; ++i) {
      int const done = (i + 2 - axis) / 3;
      stops(axis, i) = first + signs[axis] * workspace.travel()[axis] * done / steps;
    }
  }
  return stops;
}

StepDiagonals measure_diagonals(PoseFunction const& pose, Workspace const& workspace, LaserInterferometer const& laser,
                                StepDiagonalDescription const& how, std::uint64_t seed) {
  double const reading = std::hypot(laser.noise, laser.resolution / std::sqrt(12.0));
  StepDiagonals result{workspace, how.steps, {}, reading / std::sqrt(double(how.passes)), {}};
  LaserInterferometer instrument = laser;
  instrument.overrun = true;
  instrument.relative_to_first_pass = false;
  auto const unit = [&](char const* name, double limit) {
    return RandomStream(seed, fmt::format("step_diagonal/{}", name)).within(0.5 * limit, limit);
  };
  instrument.air_temperature_error = laser.air_temperature_error.value_or(unit("air_temperature_error", 0.2));
  instrument.pressure_error = laser.pressure_error.value_or(unit("pressure_error", 100.0));
  instrument.humidity_error = laser.humidity_error.value_or(unit("humidity_error", 0.06));
  for (int k = 0; k < 4; ++k) {
    auto const i = std::size_t(k);
    Eigen::Vector3d const u = diagonal_direction(k, workspace);
    std::string const name = fmt::format("step_diagonal/{}", diagonal_names[i]);
    result.mirror_normals[i] = misaligned(u, how.mirror_misalignment, RandomStream(seed, name + "/mirror"));
    Eigen::Vector3d const beam = misaligned(u, how.beam_misalignment, RandomStream(seed, name + "/beam"));
    Eigen::Matrix3Xd const stops = diagonal_stops(k, workspace, how.steps);
    Eigen::VectorXd const along = distances(pose, stops, result.mirror_normals[i], beam);
    Eigen::VectorXd const nominal = (u.transpose() * (stops.colwise() - stops.col(0))).transpose();
    result.errors[i] = shown(instrument, {name, seed}, along, how) - nominal;
  }
  return result;
}

Eigen::Vector3d measure_linear_totals(PoseFunction const& pose, Workspace const& workspace, double noise,
                                      std::uint64_t seed) {
  RandomStream random(seed, "step_diagonal/linear");
  Eigen::Vector3d totals;
  Eigen::Vector3d const start = pose(workspace.from).translation();
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3d end = workspace.from;
    end[axis] = workspace.to[axis];
    totals[axis] = (pose(end).translation() - start)[axis] - workspace.travel()[axis] + noise * random.normal();
  }
  return totals;
}

}  // namespace thermotwin::twin
