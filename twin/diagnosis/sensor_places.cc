#include "twin/diagnosis/sensor_places.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <string>

#include "thermal/site.h"
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
  std::string other;
  NodeWeights beyond;  ///< of the machine's network; Σ = 1
};

std::vector<Meeting> meetings_of(Value& document, Bodies const& bodies, Machine const& machine) {
  std::vector<Meeting> meetings;
  for (auto const* joint : tables_of(document, "joint"))
    for (auto const& [here, there] : {std::pair("from", "to"), std::pair("to", "from")})
      for (auto const& own : texts_of(*joint, here))
        for (auto const& place : texts_of(*joint, there)) {
          Meeting meeting{body_of(own), {}, body_of(place), {}};
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
      SensorPlace along{fmt::format("{} along {}", name, body_.name), name, {}};
      for (auto const& [node, weight] : own)
        for (auto const& [at, slope] : slope_at(body_, node, first_))
          along.change.emplace_back(at, way_along * weight * slope);
      places.push_back(std::move(along));
    }
    for (auto const& meeting : meetings_) {
      if (meeting.body != body_.name || !is_by(meeting, own)) continue;
      SensorPlace near{fmt::format("{} near {}", name, meeting.other), name, {}};
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

}  // namespace thermotwin::twin
