#include "twin/drift_test.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "thermal/units.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double sixty_minutes = 3600.0;
constexpr double same_time = 1e-6;      ///< [s]
constexpr double longest_lead = 120.0;  ///< of the sample that is read before the stop [s]

/// A course with a time axis of its own: the laser passes when it likes.
struct Course {
  std::string name, unit;
  VectorXd time, values;
};

std::vector<Course> courses_of(output::Dataset const& dataset) {
  std::vector<Course> courses;
  for (auto const& channel : dataset.displacements)
    courses.push_back({channel.name, channel.unit, dataset.time_s, channel.values});
  for (auto const& axis : dataset.positioning) {
    if (axis.position_mm.size() < 2 || axis.time_s.size() == 0) continue;
    Eigen::MatrixXd const mean = 0.5 * (axis.forward_um + axis.backward_um);
    Index const last = axis.position_mm.size() - 1;
    auto const at = [&](Index p) { return fmt::format("{} at {:g} mm", axis.axis, axis.position_mm[p]); };
    courses.push_back({at(0), "um", axis.time_s, mean.col(0)});
    courses.push_back({at(last), "um", axis.time_s, mean.col(last)});
    courses.push_back({axis.axis + ", between them", "um", axis.time_s, mean.col(last) - mean.col(0)});
  }
  return courses;
}

/// When something moves: the first sample at which it does, and the last.
struct Motion {
  bool known = false;  ///< the data set has such an input
  Index first = -1, last = -1;
};

Motion motion_of(output::Dataset const& dataset, std::string const& ending) {
  Motion motion;
  for (auto const& input : dataset.inputs) {
    if (!input.name.ends_with(ending)) continue;
    motion.known = true;
    for (Index r = 0; r < input.values.size(); ++r) {
      if (!(std::abs(input.values[r]) > 0.0)) continue;
      if (motion.first < 0 || r < motion.first) motion.first = r;
      motion.last = std::max(motion.last, r);
    }
  }
  return motion;
}

/// The last of the jumps after one time and not after another, or the first; without any the later time.
double jump_between(double after, double until, std::vector<double> const& jumps, bool last) {
  auto const begin = std::upper_bound(jumps.begin(), jumps.end(), after + same_time);
  auto const end = std::upper_bound(begin, jumps.end(), until + same_time);
  return begin == end ? until : last ? *(end - 1) : *begin;
}

/// Start and stop, where the inputs jump between two samples; of what moves from the first sample or to the last, that.
std::pair<double, double> ends_of(Motion const& motion, VectorXd const& time, std::vector<double> const& jumps) {
  bool const starts = motion.first > 0, stops = motion.last + 1 < time.size();
  return {starts ? jump_between(time[motion.first - 1], time[motion.first], jumps, false) : time[0],
          stops ? jump_between(time[motion.last], time[motion.last + 1], jumps, true) : time[motion.last]};
}

/// The last sample that is not after a time, else the first.
Index sample_at(VectorXd const& time, double t) {
  Index const next = std::upper_bound(time.begin(), time.end(), t + same_time) - time.begin();
  return std::max<Index>(next - 1, 0);
}

ChannelDrift drift_of(Course const& course, double from, double to) {
  double const end = course.time[course.time.size() - 1];
  Index const start = sample_at(course.time, from), stop = sample_at(course.time, to);
  ChannelDrift drift;
  drift.read_at = course.time[stop];
  VectorXd const instants = (VectorXd(3) << from + sixty_minutes, drift.read_at - sixty_minutes, end).finished();
  auto const at = output::at_times(course.values, course.time, instants);
  double const at_start = course.values[start], at_stop = course.values[stop];
  bool const long_enough = drift.read_at - from >= sixty_minutes - same_time;
  drift.name = course.name;
  drift.unit = course.unit;
  drift.range = course.values.maxCoeff<Eigen::PropagateNumbers>() - course.values.minCoeff<Eigen::PropagateNumbers>();
  drift.first_hour = long_enough ? at[0] - at_start : NAN;
  drift.last_hour = long_enough ? at_stop - at[1] : NAN;
  drift.at_stop = at_stop - at_start;
  drift.at_end = end > to ? at[2] - at_start : NAN;
  return drift;
}

std::string shown(double value) { return std::isnan(value) ? "-" : fmt::format("{:.2f}", value); }

std::string heading_of(DriftTest const& test) {
  std::string const when = fmt::format("{:.0f} to {:.0f} min", test.from / 60.0, test.to / 60.0);
  switch (test.kind) {
    case DriftTest::Kind::environment:
      return "environment, at rest";
    case DriftTest::Kind::spindle:
      return "spindle, " + when;
    case DriftTest::Kind::axis:
      return "axis, " + when;
  }
  return "";
}

/// When the values 'at stop' were read, where that was before the stop.
std::string samples_before_stop(DriftTest const& test) {
  std::set<double> times;
  for (auto const& drift : test.drifts) times.insert(drift.read_at);
  std::string text;
  for (double const t : times) {
    double const lead = test.to - t;
    if (lead <= same_time) continue;
    auto const minutes = [](double s) { return thermal::format_quantity(s, thermal::dimension::time); };
    text += fmt::format(
        "  'at stop' and 'last 60' are read at {}, {} before the stop{}\n", minutes(t), minutes(lead),
        lead > longest_lead ? "; that is too early for the figures: sample more often, or at the stop" : "");
  }
  return text;
}

}  // namespace

std::optional<DriftTest> drift_test(output::Dataset const& dataset, std::vector<double> const& jumps) {
  auto const courses = courses_of(dataset);
  Motion const spindle = motion_of(dataset, "spindle.speed"), axes = motion_of(dataset, ".feed");
  if (courses.empty() || dataset.time_s.size() < 2 || !(spindle.known || axes.known)) return std::nullopt;
  DriftTest test;
  Motion const& motion = spindle.first >= 0 ? spindle : axes;
  bool const moves = motion.first >= 0;
  if (moves) test.kind = spindle.first >= 0 ? DriftTest::Kind::spindle : DriftTest::Kind::axis;
  test.from = dataset.time_s[0];
  test.to = dataset.time_s[dataset.time_s.size() - 1];
  if (moves) std::tie(test.from, test.to) = ends_of(motion, dataset.time_s, jumps);
  for (auto const& course : courses) test.drifts.push_back(drift_of(course, test.from, test.to));
  return test;
}

std::string drift_table(DriftTest const& test) {
  std::string text = fmt::format("  drift in the style of ISO 230-3: {}\n", heading_of(test));
  bool const at_rest = test.kind == DriftTest::Kind::environment;
  if (at_rest)
    text += fmt::format("  {:<26} {:>10}\n", "", "range");
  else
    text += fmt::format("  {:<26} {:>10} {:>10} {:>10} {:>10}\n", "", "60 min", "last 60", "at stop", "at end");
  for (auto const& drift : test.drifts) {
    std::string const unit = drift.unit == "um" ? "µm" : "µrad";
    if (at_rest)
      text += fmt::format("  {:<26} {:>10} {}\n", drift.name, shown(drift.range), unit);
    else
      text += fmt::format("  {:<26} {:>10} {:>10} {:>10} {:>10} {}\n", drift.name, shown(drift.first_hour),
                          shown(drift.last_hour), shown(drift.at_stop), shown(drift.at_end), unit);
  }
  return at_rest ? text : text + samples_before_stop(test);
}

nlohmann::ordered_json drift_json(DriftTest const& test) {
  constexpr char const* kinds[] = {"environment", "spindle", "axis"};
  nlohmann::ordered_json json = {{"kind", kinds[int(test.kind)]}, {"from_s", test.from}, {"to_s", test.to}};
  json["drifts"] = nlohmann::ordered_json::array();
  for (auto const& drift : test.drifts)
    json["drifts"].push_back({{"name", drift.name},
                              {"unit", drift.unit},
                              {"range", drift.range},
                              {"first_hour", drift.first_hour},
                              {"last_hour", drift.last_hour},
                              {"at_stop", drift.at_stop},
                              {"read_at_s", drift.read_at},
                              {"at_end", drift.at_end}});
  return json;
}

}  // namespace thermotwin::twin
