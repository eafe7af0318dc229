#include "twin/placement/candidate_sites.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "twin/assembly.h"
#include "twin/file/document.h"
#include "twin/file/tables.h"
#include "twin/file_kind.h"
#include "twin/turning_bodies.h"

namespace thermotwin::twin {
namespace {

using thermal::Body;
using thermal::InputError;

/// A facet of a body's surface as a candidate.
struct SurfacePoint {
  CandidateSite site;
  std::string body;
  Eigen::Vector3d position;
};

std::string millimetres(double metres) { return fmt::format("{:.5g} mm", 1e3 * metres); }

/// The place of a block's facet: the two directions that lie in its face, from the block's corner.
std::string place_on_block(Body const& block, std::string const& face, thermal::Facet const& facet) {
  Eigen::Vector3d const from_corner = facet.centre - block.origin;
  std::vector<std::string> extents;
  for (int d = 0; d < 3; ++d)
    if (face[0] != char('x' + d)) extents.push_back(millimetres(from_corner[d]));
  return fmt::format("{}.{}[{}]", block.name, face, fmt::join(extents, ", "));
}

std::vector<SurfacePoint> surface_points(Body const& body) {
  std::vector<SurfacePoint> points;
  if (body.shape == Body::Shape::lump) return {{{"", {body.name}}, body.name, body.face("surface").front().centre}};
  for (auto const& [face, facets] : body.faces) {
    bool const mantle = face == "outer" || face == "surface";
    if (body.shape == Body::Shape::axial && !mantle) continue;
    for (auto const& facet : facets)
      points.push_back({{"",
                         {mantle ? fmt::format("{}.{}[{}]", body.name, face, millimetres((facet.low + facet.high) / 2))
                                 : place_on_block(body, face, facet)}},
                        body.name,
                        facet.centre});
  }
  return points;
}

double diagonal(std::vector<SurfacePoint> const& points, std::string const& body) {
  Eigen::AlignedBox3d box;
  for (auto const& point : points)
    if (point.body == body) box.extend(point.position);
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

/// Farthest-point sampling; the first of each body is infinitely far from everything.
std::vector<SurfacePoint> thinned(std::vector<SurfacePoint> const& points, std::size_t most) {
  if (points.size() <= most) return points;
  std::map<std::string, double> scale;
  for (auto const& point : points)
    if (!scale.contains(point.body)) scale[point.body] = std::max(1e-3, diagonal(points, point.body));
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> kept;
  while (kept.size() < most) {
    auto const next = std::size_t(std::max_element(distance.begin(), distance.end()) - distance.begin());
    kept.push_back(next);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i].body == points[next].body)
        distance[i] =
            std::min(distance[i], (points[i].position - points[next].position).norm() / scale.at(points[i].body));
  }
  std::sort(kept.begin(), kept.end());
  std::vector<SurfacePoint> result;
  for (std::size_t i : kept) result.push_back(points[i]);
  return result;
}

Body const& known_body(std::string const& body, Bodies const& bodies) {
  if (auto const found = bodies.all().find(body); found != bodies.all().end()) return found->second;
  throw InputError(fmt::format("unknown body '{}'; {}", body, thermal::did_you_mean(body, bodies.order())));
}

std::vector<CandidateSite> mesh_of_sites(Bodies const& bodies, std::set<std::string> const& without, int most) {
  std::vector<SurfacePoint> points;
  for (auto const& name : bodies.order())
    if (bodies.carried(name) && !without.contains(name)) {
      auto const on_body = surface_points(bodies.all().at(name));
      points.insert(points.end(), on_body.begin(), on_body.end());
    }
  std::vector<CandidateSite> sites = {{"ambient", {"ambient"}}};
  for (auto& point : thinned(points, std::size_t(std::max(1, most - 1)))) sites.push_back(std::move(point.site));
  return sites;
}

/// The dearest counts: the sensor is on all of them.
double cost_on_bodies(std::vector<std::string> const& at, std::vector<BodyCost> const& bodies) {
  std::optional<double> dearest;
  for (auto const& place : at) {
    auto const is_there = [on = body_of(place)](BodyCost const& body) { return body.name == on; };
    auto const body = std::find_if(bodies.begin(), bodies.end(), is_there);
    double const cost = body == bodies.end() ? 1.0 : body->cost;
    dearest = std::max(cost, dearest.value_or(cost));
  }
  return dearest.value_or(1.0);
}

/// Checks rules against a machine; a complaint gets the place in the rules' file in front.
class RulesCheck {
 public:
  RulesCheck(CandidateRules const& rules, Bodies const& bodies) : rules_(rules), bodies_(bodies) {}

  void operator()() const {
    for (std::size_t i = 0; i < rules_.forbidden.size(); ++i)
      at(item("forbidden", i), [&] { known_body(rules_.forbidden[i], bodies_); });
    for (std::size_t i = 0; i < rules_.bodies.size(); ++i) {
      auto const& body = rules_.bodies[i];
      at(key("name", item("body", i)), [&] { known_body(body.name, bodies_); });
      at(key("cost", item("body", i)), [&] { require_positive("cost", body.cost); });
    }
    for (std::size_t i = 0; i < rules_.sites.size(); ++i) {
      auto const& site = rules_.sites[i];
      for (auto const& place : site.at)
        at(key("at", item("site", i)), [&] {
          check_place(place, bodies_);
          if (auto const body = body_of(place); std::count(rules_.forbidden.begin(), rules_.forbidden.end(), body) > 0)
            throw InputError(fmt::format("a site on '{}', which 'forbidden' names, too", body));
        });
      at(key("cost", item("site", i)), [&] { require_positive("cost", site.cost); });
    }
    at(key("most", whole()), [&] {
      if (rules_.most < 1) throw InputError(fmt::format("'most' is {}; a mesh has at least one site", rules_.most));
    });
    at(key("budget", whole()), [&] { require_positive("budget", rules_.budget); });
  }

  /// That the budget buys a sensor at all.
  void affordable(std::vector<CandidateSite> const& sites) const {
    auto const cheapest = std::min_element(sites.begin(), sites.end(),
                                           [](auto const& one, auto const& other) { return one.cost < other.cost; });
    at(key("budget", whole()), [&] {
      if (cheapest->cost > rules_.budget)
        throw InputError(fmt::format("a 'budget' of {:g} buys no sensor: the cheapest, at '{}', costs {:g}",
                                     rules_.budget, cheapest->name, cheapest->cost));
    });
  }

 private:
  [[nodiscard]] Value const* whole() const { return rules_.document ? &*rules_.document : nullptr; }
  [[nodiscard]] static Value const* key(char const* name, Value const* table) {
    Value const* value = table ? table->find(name) : nullptr;
    return value ? value : table;
  }
  [[nodiscard]] Value const* item(char const* name, std::size_t i) const {
    Value const* list = key(name, whole());
    return list && list->is_list() ? &std::get<Value::List>(list->content).at(i) : list;
  }
  template <class Action>
  static void at(Value const* where, Action action) {
    try {
      action();
    } catch (InputError const& error) {
      if (!where) throw;
      throw FileError(where->where, error.what());
    }
  }
  static void require_positive(char const* key, double value) {
    if (!(value > 0.0)) throw InputError(fmt::format("'{}' is {:g}; it must be positive", key, value));
  }

  CandidateRules const& rules_;
  Bodies const& bodies_;
};

}  // namespace

CandidateRules read_candidate_rules(std::filesystem::path const& path) {
  if (std::filesystem::is_regular_file(path) && std::filesystem::is_empty(path)) return {};  // all is left out
  Value const document = read_toml(path);
  CandidateRules rules;
  read_file_fields(document, FileKind::candidates, rules);
  rules.document = document;
  Tables names(document);
  auto site = rules.sites.begin();
  for (auto const& table : names.of("site")) {
    if (texts_of(table, "at").empty()) throw FileError(table.where, "a site needs a place: at = \"head\"");
    if (auto const name = name_in(table); !name.empty()) names.claim(table, "site", name);
    if (!table.find("cost")) site->cost = cost_on_bodies(site->at, rules.bodies);
    ++site;
  }
  for (auto const& table : names.of("body")) names.claim(table, "body", name_in(table));
  return rules;
}

std::vector<CandidateSite> candidate_sites(Value const& document, CandidateRules const& rules) {
  Tables tables(document);
  Bodies const bodies(tables);
  RulesCheck const check(rules, bodies);
  check();
  auto const without = bodies_without_candidates(document, rules);
  auto sites = rules.sites;
  if (sites.empty()) {
    sites = mesh_of_sites(bodies, without, rules.most);
    for (auto& site : sites) site.cost = cost_on_bodies(site.at, rules.bodies);
  }
  for (auto& site : sites)
    if (site.name.empty()) site.name = fmt::format("{}", fmt::join(site.at, " and "));
  if (sites.empty()) throw InputError("no site is left on which a sensor could sit");
  check.affordable(sites);
  return sites;
}

double cost_at(std::vector<std::string> const& at, CandidateRules const& rules) {
  auto const there =
      std::find_if(rules.sites.begin(), rules.sites.end(), [&](CandidateSite const& site) { return site.at == at; });
  return there == rules.sites.end() ? cost_on_bodies(at, rules.bodies) : there->cost;
}

std::set<std::string> bodies_without_candidates(Value const& document, CandidateRules const& rules) {
  std::set<std::string> without;
  for (auto const& body : turning_bodies(document)) without.insert(body);
  for (auto const& site : rules.sites)
    for (auto const& at : site.at) without.erase(body_of(at));
  without.insert(rules.forbidden.begin(), rules.forbidden.end());
  return without;
}

void check_place(std::string const& place, Bodies const& bodies) {
  if (place != "ambient") static_cast<void>(site_of(known_body(body_of(place), bodies), place));
}

std::vector<CandidateSite> with_spares(std::vector<CandidateSite> sites, int spares) {
  auto const once = sites;
  for (int i = 1; i <= spares; ++i)
    for (auto const& site : once)
      sites.push_back(
          {site.name + (i == 1 ? " (spare)" : fmt::format(" (spare {})", i)), site.at, site.cost, site.shares});
  return sites;
}

Value with_sensors_at(Value document, std::vector<CandidateSite> const& sites) {
  int number = 0;
  for (auto const& site : sites) {
    Value table = make_table({document.where.file, 1'000'000 + number, 1}, {});
    set_key(table, "name", fmt::format("candidate {}", ++number));
    set_key(table, "title", site.name);
    set_key(table, "at", list_of(site.at));
    if (!site.shares.empty()) set_key(table, "shares", site.shares);
    append_table(document, "temperature_sensor", std::move(table));
  }
  return document;
}

}  // namespace thermotwin::twin
