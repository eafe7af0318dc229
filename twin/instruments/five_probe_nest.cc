#include "twin/instruments/five_probe_nest.h"

#include <fmt/format.h>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

struct Places {
  double far;   // z₁
  double near;  // z₂
};

Places places(FiveProbeNest const& nest) {
  if (nest.far_distance == nest.near_distance)
    throw InputError(fmt::format("five-probe nest: far_distance and near_distance are both {} m; tilt needs two places",
                                 nest.far_distance));
  double const sign = nest.bar_points_to == "-z" ? -1.0 : 1.0;
  return {sign * nest.far_distance, sign * nest.near_distance};
}

}  // namespace

void check_nest(FiveProbeNest const& nest) {
  static_cast<void>(places(nest));
  check_probe(nest.radial, "nest/radial");
  check_probe(nest.axial, "nest/axial");
}

FiveColumns probe_displacements(FiveProbeNest const& nest, FiveColumns const& errors) {
  auto const [far, near] = places(nest);
  FiveColumns seen(errors.rows(), 5);
  seen.col(0) = errors.col(0) + far * errors.col(4);
  seen.col(1) = errors.col(1) - far * errors.col(3);
  seen.col(2) = errors.col(0) + near * errors.col(4);
  seen.col(3) = errors.col(1) - near * errors.col(3);
  seen.col(4) = errors.col(2);
  return seen;
}

FiveColumns spindle_errors(FiveProbeNest const& nest, FiveColumns const& displacements) {
  auto const [far, near] = places(nest);
  FiveColumns errors(displacements.rows(), 5);
  errors.col(3) = -(displacements.col(1) - displacements.col(3)) / (far - near);
  errors.col(4) = (displacements.col(0) - displacements.col(2)) / (far - near);
  errors.col(0) = displacements.col(2) - near * errors.col(4);
  errors.col(1) = displacements.col(3) + near * errors.col(3);
  errors.col(2) = displacements.col(4);
  return errors;
}

NestReadings read(FiveProbeNest const& nest, InstrumentChannel const& channel, SpindleCourse const& course,
                  Eigen::VectorXd const& sample_times) {
  FiveColumns const seen = probe_displacements(nest, course.errors);
  NestReadings readings;
  readings.probes.resize(sample_times.size(), 5);
  readings.truth_probes.resize(sample_times.size(), 5);
  for (int i = 0; i < 5; ++i) {
    std::string const& name = probe_names[static_cast<std::size_t>(i)];
    DisplacementProbe const& probe = i < 4 ? nest.radial : nest.axial;
    auto const one = read(probe, {channel.name + "/" + name, channel.seed},
                          {course.time, seen.col(i), course.air, course.spindle_speed}, sample_times);
    readings.probes.col(i) = one.values;
    readings.truth_probes.col(i) = one.truth;
    for (auto const& [property, value] : one.drawn) readings.drawn[name + "." + property] = value;
  }
  readings.errors = spindle_errors(nest, readings.probes);
  return readings;
}

}  // namespace thermotwin::twin
