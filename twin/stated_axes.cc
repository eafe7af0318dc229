#include "twin/stated_axes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <utility>

#include "scenarios/course.h"
#include "scenarios/feed_program.h"
#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "twin/effect.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

/// Length without what the sum of its cells rounds [m].
double length_of(thermal::Body const& bar) { return std::round(1e9 * bar.edges[0].back()) / 1e9; }

/// "w" of "w.stroke_from"; empty for what is no input of an axis.
std::string axis_of_input(std::string const& input) {
  auto const dot = input.rfind('.');
  if (dot == std::string::npos || input.starts_with("spindle.")) return {};
  scenarios::AxisLimits any;
  any.name = "any";
  for (auto const& channel : scenarios::own_channels({0.0, {any}}))
    if (channel.name == any.name + input.substr(dot)) return input.substr(0, dot);
  return {};
}

/// `given` holds x, a place on the screw of the axis, under `key`.
void require_on_screw(Value const& given, std::string const& key, double x, scenarios::AxisLimits const& axis) try {
  scenarios::require_on_screw(x, axis, fmt::format("'{}': ", key));
} catch (InputError const& error) {
  throw FileError(given.where, error.what());
}

/// Each position is a channel of its own.
void refuse_same_channels(Value const& table, BallScrewDescription const& description) {
  Screw screw;
  screw.description = description;
  std::set<std::string> channels;
  for (std::size_t i = 0; i < description.positions.size(); ++i) {
    auto const channel = screw.channel_at(description.positions[i]);
    if (!channels.insert(channel).second)
      throw FileError(where_of_item(table, "positions", i),
                      fmt::format("'positions' has two for which the channel is '{}'; one is due", channel));
  }
}

}  // namespace

StatedAxes::StatedAxes(Tables& tables) : tables_(tables) {
  for (auto const& [axis, table] : tables.read<AxisDescription>("axis")) {
    if (!(axis.stroke_to > axis.stroke_from))
      throw FileError(table->find("stroke_to")->where,
                      fmt::format("the stroke of axis '{}' ends at {}; it must end beyond stroke_from, {}", axis.name,
                                  thermal::format_quantity(axis.stroke_to, thermal::dimension::length),
                                  thermal::format_quantity(axis.stroke_from, thermal::dimension::length)));
    limits_.push_back({axis.name, axis.rapid_feed, axis.lead, axis.stroke_from, axis.stroke_to});
    if (axis.friction_at == "moving speed") while_moving_.push_back(axis.name);
  }
}

std::vector<std::string> StatedAxes::names() const {
  std::vector<std::string> names;
  for (auto const& axis : limits_) names.push_back(axis.name);
  return names;
}

void StatedAxes::check(Value const& table) const {
  Value const* given = table.find("axis");
  auto const known = names();
  if (!given || !given->is_text() || known.empty()) return;
  auto const& name = std::get<std::string>(given->content);
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw FileError(given->where,
                    fmt::format("the machine has no axis '{}'; {}", name, thermal::did_you_mean(name, known)));
}

void StatedAxes::check_inputs(thermal::Network const& network) const {
  auto const known = names();
  auto const& document = tables_.document();
  for (int i = 0; i < network.external_channels(); ++i) {
    auto const& input = network.channel_names()[std::size_t(i)];
    auto const axis = axis_of_input(input);
    if (known.empty() || axis.empty() || std::find(known.begin(), known.end(), axis) != known.end()) continue;
    auto const what = fmt::format("the machine has no axis '{}'; {}", axis, thermal::did_you_mean(axis, known));
    auto const place = place_of(document, "'" + input + "'");
    bool const is_written = place.line != document.where.line || place.column != document.where.column;
    if (!is_written) throw FileError(place_without_axis(), fmt::format("'axis' is not given: {}", what));
    if (!thermal::meant_name(axis, known).empty()) throw FileError(place, fmt::format("'{}': {}", input, what));
  }
}

/// Of the first part that takes the axis it has by default.
Location StatedAxes::place_without_axis() const {
  for (auto const& entry : effect_catalogue()) {
    bool const has_axis = std::any_of(entry.parameters.begin(), entry.parameters.end(),
                                      [](auto const& parameter) { return parameter.key == "axis"; });
    for (auto const& table : tables_.of(entry.name))
      if (has_axis && !table.find("axis")) return table.where;
  }
  return tables_.document().where;
}

/// The bars on which the ball nuts of an axis run.
std::vector<std::string> StatedAxes::bars_of_nuts(std::string const& axis) const {
  std::vector<std::string> bars;
  for (auto const& table : tables_.of("ball_nut")) {
    auto const own = texts_of(table, "axis"), screw = texts_of(table, "screw");
    if ((own.empty() ? BallScrewDescription().axis : own[0]) == axis)
      bars.insert(bars.end(), screw.begin(), screw.end());
  }
  return bars;
}

void StatedAxes::check_screw(Value const& table, BallScrewDescription const& screw, Assembly const& assembly) const {
  if (auto const bars = bars_of_nuts(screw.axis);
      !bars.empty() && std::find(bars.begin(), bars.end(), screw.body) == bars.end())
    throw FileError(table.find("body")->where, fmt::format("'{}' is no screw of axis '{}', whose ball_nut runs on '{}'",
                                                           screw.body, screw.axis, fmt::join(bars, "', '")));
  scenarios::AxisLimits own;
  own.name = screw.axis;
  own.screw_length = length_of(assembly.body(screw.body));
  for (std::size_t i = 0; i < screw.positions.size(); ++i) {
    Value const& given = *table.find("positions");
    require_on_screw(given.is_list() ? std::get<Value::List>(given.content)[i] : given, "positions", screw.positions[i],
                     own);
  }
  refuse_same_channels(table, screw);
}

void StatedAxes::check_nut(Value const& table, Assembly const& assembly) const {
  auto const length = number_in(table, "nut_length", thermal::dimension::length);
  if (!length) return;
  auto const screw = body_of(texts_of(table, "screw").at(0));
  auto const& body = assembly.body(screw);
  if (body.shape != thermal::Body::Shape::axial) return;
  double const longest = length_of(body);
  if (*length > longest)
    throw FileError(where_of(table, "nut_length"),
                    fmt::format("'nut_length' is {}; its screw '{}' is {} long", table.find("nut_length")->text(),
                                screw, thermal::format_quantity(longest, thermal::dimension::length)));
}

std::vector<scenarios::AxisLimits> StatedAxes::limits_on_screws(std::vector<Screw> const& screws,
                                                                Assembly const& assembly) const {
  auto limits = limits_;
  for (std::size_t a = 0; a < limits.size(); ++a) {
    auto& axis = limits[a];
    auto bars = bars_of_nuts(axis.name);
    for (auto const& screw : screws)
      if (screw.description.axis == axis.name) bars.push_back(screw.description.body);
    for (auto const& bar : bars) axis.screw_length = std::min(axis.screw_length, length_of(assembly.body(bar)));
    for (auto const& [key, x] : {std::pair("stroke_from", axis.stroke_from), std::pair("stroke_to", axis.stroke_to)})
      if (Value const* given = tables_.of("axis")[a].find(key)) require_on_screw(*given, key, x, axis);
  }
  return limits;
}

}  // namespace thermotwin::twin
