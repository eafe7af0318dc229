#include "twin/diagnosis/sensor_places.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <utility>

#include "thermal/site.h"
#include "thermal/units.h"
#include "twin/assembly.h"
#include "twin/bodies.h"
#include "twin/file/document.h"
#include "twin/file/tables.h"

namespace thermotwin::twin {
namespace {

constexpr double way_along = 6e-3;  // [m]
constexpr double share_beyond = 0.1;

/// A joint as one of its two sides meets it.
struct Meeting {
  std::string body;
  std::vector<int> nodes;  ///< of the body, from 0
  std::string other, place;
  NodeWeights beyond;  ///< of the machine's network; Σ = 1
};

std::vector<Meeting> meetings_of(Value& document, Bodies const& bodies, Machine const& machine) {
  std::vector<Meeting> meetings;
  for (auto const* joint : tables_of(document, "joint"))
    for (auto const& [here, there] : {std::pair("from", "to"), std::pair("to", "from")})
      for (auto const& own : texts_of(*joint, here))
        for (auto const& place : texts_of(*joint, there)) {
          Meeting meeting{body_of(own), {}, body_of(place), place, {}};
          for (auto const& contact : site_of(bodies.all().at(meeting.body), own).contacts)
            meeting.nodes.push_back(contact.node);
          int const first = machine.network().range(meeting.other).first;
          for (auto const& contact : site_of(bodies.all().at(meeting.other), place).contacts)
            meeting.beyond.emplace_back(first + contact.node, contact.share);
          meetings.push_back(std::move(meeting));
        }
  return meetings;
}

/// A lump, or cells along one line.
bool is_line(thermal::Body const& body) { return body.shape != thermal::Body::Shape::block && body.count(1) == 1; }

/// d/dz of the nodes' temperatures at one of them: between its neighbours.
NodeWeights slope_at(thermal::Body const& body, int node, int first) {
  auto const& z = body.stations[0];
  int const before = std::max(0, node - 1), after = std::min(body.nodes() - 1, node + 1);
  double const way = z[std::size_t(after)] - z[std::size_t(before)];
  return {{first + after, 1.0 / way}, {first + before, -1.0 / way}};
}

/// A position along a bar that a place names, `cartridge[10 mm]`: where its number stands in the text.
std::optional<std::pair<std::size_t, std::size_t>> position_in(std::string const& place) {
  auto const open = place.find('['), close = place.find(']');
  if (open == place.npos || close == place.npos || place.find("..", open) < close || place.find(',', open) < close)
    return {};
  return std::pair(open + 1, close - open - 1);
}

class Places {
 public:
  Places(thermal::Body const& body, int first, std::vector<Meeting> const& meetings)
      : body_(body), first_(first), meetings_(meetings) {}

  /// Of a sensor that has weight on the body.
  void add(Sensor const& sensor, std::vector<SensorPlace>& places) const {
    NodeWeights own;
    for (auto const& [node, weight] : sensor.weights)
      if (node >= first_ && node < first_ + body_.nodes()) own.emplace_back(node - first_, weight);
    if (own.empty()) return;
    auto const& name = sensor.description.name;
    if (body_.nodes() > 1) {
      SensorPlace along{fmt::format("{} along {}", name, body_.name), name, body_.name, "", {}};
      along.can_be_written =
          std::any_of(sensor.description.at.begin(), sensor.description.at.end(),
                      [&](auto const& at) { return body_of(at) == body_.name && position_in(at).has_value(); });
      for (auto const& [node, weight] : own)
        for (auto const& [at, slope] : slope_at(body_, node, first_))
          along.change.emplace_back(at, way_along * weight * slope);
      places.push_back(std::move(along));
    }
    for (auto const& meeting : meetings_) {
      if (meeting.body != body_.name || !is_by(meeting, own)) continue;
      SensorPlace near{fmt::format("{} near {}", name, meeting.other), name, body_.name, meeting.place, {}};
      for (auto const& [node, weight] : own) {
        near.change.emplace_back(first_ + node, -share_beyond * weight);
        for (auto const& [there, share] : meeting.beyond)
          near.change.emplace_back(there, share_beyond * weight * share);
      }
      places.push_back(std::move(near));
    }
  }

 private:
  /// Whether the joint touches a node of the sensor, or one next to it.
  static bool is_by(Meeting const& meeting, NodeWeights const& own) {
    return std::any_of(own.begin(), own.end(), [&](auto const& entry) {
      return std::any_of(meeting.nodes.begin(), meeting.nodes.end(),
                         [&](int node) { return std::abs(node - entry.first) <= 1; });
    });
  }

  thermal::Body const& body_;
  int first_;
  std::vector<Meeting> const& meetings_;
};

/// Moved along the bar by `way` [m], to a hundredth of a millimetre, as far as the bar goes.
std::string moved(std::string const& place, double way, thermal::Body const& bar) {
  auto const position = position_in(place);
  if (!position) return place;
  auto const& z = bar.stations[0];
  double const at = thermal::parse_value(place.substr(position->first, position->second), dimension::length);
  double const there = std::clamp(at + way, std::min(at, z[0]), std::max(at, z[std::size_t(bar.nodes() - 1)]));
  std::string text = place;
  return text.replace(position->first, position->second, fmt::format("{:.4g} mm", std::round(1e5 * there) / 100.0));
}

/// Where one sensor is, place by place.
class Seat {
 public:
  explicit Seat(SensorDescription const& sensor) : name_(sensor.name) {
    for (std::size_t i = 0; i < sensor.at.size(); ++i) add(sensor.at[i], sensor.share(i));
  }

  void move(SensorPlace const& place, double way, thermal::Body const& bar) {
    for (auto& [at, share] : places_)
      if (body_of(at) == place.body) at = moved(at, way, bar);
  }

  /// A share of what it has on each body goes elsewhere.
  void lean(std::vector<std::pair<SensorPlace const*, double>> const& leanings) {
    auto const before = places_;
    for (auto const& [place, share] : leanings)
      for (std::size_t i = 0; i < before.size(); ++i) {
        if (body_of(before[i].first) != place->body) continue;
        double const part = std::round(1e4 * share * before[i].second) / 1e4;
        places_[i].second -= part;
        add(place->toward, part);
      }
  }

  [[nodiscard]] PlacedSensor placed() const {
    PlacedSensor result{name_, {}, {}};
    for (auto const& [at, share] : places_) {
      result.at.push_back(at);
      result.shares.push_back(share);
    }
    if (places_.size() == 1) result.shares.clear();
    return result;
  }

 private:
  void add(std::string const& at, double share) {
    auto const known = std::find_if(places_.begin(), places_.end(), [&](auto const& p) { return p.first == at; });
    if (known == places_.end())
      places_.emplace_back(at, share);
    else
      known->second += share;
  }

  std::string name_;
  std::vector<std::pair<std::string, double>> places_;
};

}  // namespace

std::vector<SensorPlace> sensor_places(Value const& document, Machine const& machine) {
  Tables tables(document);
  Bodies const bodies(tables);
  Value copy = document;
  auto const meetings = meetings_of(copy, bodies, machine);
  std::vector<SensorPlace> places;
  for (auto const& name : bodies.order()) {
    auto const& body = bodies.all().at(name);
    if (!bodies.material_of(name) || !is_line(body)) continue;
    Places const on_body(body, machine.network().range(name).first, meetings);
    for (auto const& sensor : machine.sensors) on_body.add(sensor, places);
  }
  return places;
}

std::vector<PlacedSensor> placed_sensors(Value const& document, std::vector<SensorPlace> const& places,
                                         std::vector<double> const& x) {
  Tables tables(document);
  Bodies const bodies(tables);
  std::vector<PlacedSensor> placed;
  for (auto const& [sensor, table] : tables.read<SensorDescription>("temperature_sensor")) {
    Seat seat(sensor);
    std::vector<std::pair<SensorPlace const*, double>> leanings;
    bool elsewhere = false;
    for (std::size_t p = 0; p < places.size(); ++p) {
      if (places[p].sensor != sensor.name || x[p] == 0.0 || !places[p].can_be_written) continue;
      elsewhere = true;
      if (places[p].toward.empty())
        seat.move(places[p], way_along * x[p], bodies.all().at(places[p].body));
      else
        leanings.emplace_back(&places[p], share_beyond * x[p]);
    }
    seat.lean(leanings);
    if (elsewhere) placed.push_back(seat.placed());
  }
  return placed;
}

void put(Value& table, PlacedSensor const& sensor) {
  set_key(table, "at", list_of(sensor.at));
  Value::List shares;
  for (double const share : sensor.shares) shares.push_back({table.where, share});
  if (!shares.empty()) set_key(table, "shares", shares);
}

}  // namespace thermotwin::twin
