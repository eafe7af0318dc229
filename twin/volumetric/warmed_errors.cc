#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <map>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "thermal/units.h"
#include "twin/volumetric/volumetric_machine.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

constexpr double micro = 1e-6;     // µm, µrad
constexpr double rounding = 1e-6;  // of an instant that is written in hours [s]

Eigen::Index nearest(Eigen::VectorXd const& times, double time) {
  Eigen::Index row = 0;
  (times.array() - time).abs().minCoeff(&row);
  return row;
}

void check_instant(Eigen::VectorXd const& times, double time) {
  double const first = times[0], last = times[times.size() - 1];
  if (time >= first - rounding && time <= last + rounding) return;
  auto const text = [](double t) { return thermal::format_quantity(t, thermal::dimension::time); };
  throw InputError(fmt::format("the instant {} is not within the run, which goes from {} to {}", text(time),
                               text(first), text(last)));
}

/// One instant of a run: what its displacement channels show [m, rad].
class Instant {
 public:
  Instant(output::Dataset const& run, double time) : run_(run), time_(time), row_(nearest(run.time_s, time)) {}

  [[nodiscard]] double channel(std::string const& name, bool angle) const {
    auto const& all = channels();
    auto const* shown = find_channel(all, name);
    if (!shown)
      throw InputError(
          fmt::format("the run has no displacement '{}'; {}", name, thermal::did_you_mean(name, names_of(all))));
    if ((shown->unit == "urad") != angle)
      throw InputError(fmt::format("'{}' of the run is in {}; {} is due for the element that it moves", name,
                                   shown->unit, angle ? "urad" : "um"));
    return micro * (shown->values[row_] - shown->values[0]);
  }

  /// Error of position by the nut's place on the screw: from channels "E_P_120mm", else from the laser.
  [[nodiscard]] std::map<double, double> screw_error(VolumetricAxisDescription const& axis) const {
    std::map<double, double> error;
    for (auto const& c : channels()) {
      if (!c.name.starts_with(axis.screw + "_") || !c.name.ends_with("mm")) continue;
      double millimetres = 0.0;
      char const* const end = c.name.data() + c.name.size() - 2;
      auto const parsed = std::from_chars(c.name.data() + axis.screw.size() + 1, end, millimetres);
      if (parsed.ptr == end) error[1e-3 * millimetres] = channel(c.name, false);
    }
    return error.empty() ? laser_error(axis) : error;
  }

 private:
  [[nodiscard]] std::vector<output::Channel> const& channels() const {
    return run_.truth_displacements.empty() ? run_.displacements : run_.truth_displacements;
  }

  [[nodiscard]] std::map<double, double> laser_error(VolumetricAxisDescription const& axis) const {
    auto const& tables = run_.truth_positioning.empty() ? run_.positioning : run_.truth_positioning;
    auto const it = std::find_if(tables.begin(), tables.end(), [&](auto const& p) { return p.axis == axis.name; });
    if (it == tables.end())
      throw InputError(
          fmt::format("the run shows no error of position of axis '{}': neither channels '{}_…mm' nor a "
                      "laser along it",
                      axis.name, axis.screw));
    auto const pass = nearest(it->time_s, time_);
    double const start = std::min(*axis.screw_from, *axis.screw_to);
    std::map<double, double> error;
    for (Eigen::Index i = 0; i < it->position_mm.size(); ++i)
      error[start + 1e-3 * it->position_mm[i]] = micro * (it->forward_um(pass, i) - it->forward_um(0, i));
    return error;
  }

  output::Dataset const& run_;
  double time_;
  Eigen::Index row_;
};

/// A course along the screw as one along the axis.
ErrorTable along_axis(std::map<double, double> const& on_screw, VolumetricAxisDescription const& axis) {
  double const slope = (axis.to - axis.from) / (*axis.screw_to - *axis.screw_from);
  double const sign = slope > 0.0 ? 1.0 : -1.0;
  std::map<double, double> on_axis;
  for (auto const& [place, error] : on_screw) on_axis[axis.from + slope * (place - *axis.screw_from)] = sign * error;
  ErrorTable table{Eigen::VectorXd(Eigen::Index(on_axis.size())), Eigen::VectorXd(Eigen::Index(on_axis.size()))};
  Eigen::Index i = 0;
  for (auto const& [q, error] : on_axis) {
    table.positions[i] = q;
    table.values[i++] = error;
  }
  return table;
}

/// A carriage that carries the workpiece and whose errors are its own moves the tool by their opposite.
double sense(VolumetricDescription const& description, int axis) {
  bool const carries_workpiece = axis < int(chain_of(description.chain));
  return carries_workpiece && convention_of(description.convention) == ErrorConvention::body_fixed ? -1.0 : 1.0;
}

void grow(GeometricErrors& errors, GrowthDescription const& growth, Instant const& instant) {
  std::array<std::string, 3> const names = {"squareness_xy", "squareness_xz", "squareness_yz"};
  if (auto const it = std::find(names.begin(), names.end(), growth.element); it != names.end()) {
    errors.squareness[it - names.begin()] += growth.factor * instant.channel(growth.channel, true);
    return;
  }
  auto const place = element_place(growth.element);
  double const change = growth.factor * instant.channel(growth.channel, place.component >= 3);
  auto& course = errors.courses[std::size_t(place.axis)][std::size_t(place.component)];
  course.tables.push_back({Eigen::VectorXd::Constant(1, course.from), Eigen::VectorXd::Constant(1, change)});
}

}  // namespace

GeometricErrors warmed(VolumetricMachine const& machine, output::Dataset const& run, double time) {
  if (run.time_s.size() == 0) throw InputError("the run has no samples");
  check_instant(run.time_s, time);
  Instant const instant(run, time);
  GeometricErrors errors = machine.cold;
  for (auto const& axis : machine.description.axis) {
    if (axis.screw.empty()) continue;
    int const number = axis.name[0] - 'x';
    auto table = along_axis(instant.screw_error(axis), axis);
    table.values *= sense(machine.description, number);
    errors.courses[std::size_t(number)][std::size_t(number)].tables.push_back(std::move(table));
  }
  for (auto const& growth : machine.description.growth) grow(errors, growth, instant);
  return errors;
}

}  // namespace thermotwin::twin
