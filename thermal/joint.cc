#include "thermal/joint.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>

#include "thermal/error.h"
#include "thermal/overlap.h"

namespace thermotwin::thermal {
namespace {

constexpr double tolerance = 1e-6;  // of typed coordinates [m]

[[noreturn]] void reject(Site const& a, Site const& b, std::string const& why) {
  throw InputError(fmt::format("'{}' ({}) and '{}' ({}) do not touch: {}", a.body, a.place, b.body, b.place, why));
}

bool single(Site const& site) {
  return std::all_of(site.contacts.begin(), site.contacts.end(),
                     [&](Contact const& c) { return c.node == site.contacts[0].node; });
}

/// What the contact's cell resists when the joint takes `area` of it.
double resistance(Contact const& contact, double area) { return area > 0.0 ? contact.half_resistance / area : 0.0; }

Pair pair_of(Contact const& a, Contact const& b, double measure, double area_a, double area_b) {
  double const area = area_a > 0.0 && area_b > 0.0 ? std::min(area_a, area_b) : std::max(area_a, area_b);
  return {a.node, b.node, measure, area,
          resistance(a, area_a > 0.0 ? area_a : area) + resistance(b, area_b > 0.0 ? area_b : area)};
}

std::vector<Pair> by_product(Site const& a, Site const& b) {
  double const area_a = a.area(), area_b = b.area();
  double const area = area_a > 0.0 && area_b > 0.0 ? std::min(area_a, area_b) : std::max(area_a, area_b);
  std::vector<Pair> pairs;
  for (auto const& i : a.contacts)
    for (auto const& j : b.contacts) {
      double const share = i.share * j.share;
      pairs.push_back(pair_of(i, j, share, area * share, area * share));
    }
  return pairs;
}

/// A contact as an interval along a common axis, with its fraction of the layer it lies in.
struct Layered {
  Contact const* contact;
  double low, high, fraction;
};

void set_fractions(std::vector<Layered>& all) {
  std::map<std::pair<long, long>, double> sums;
  auto const key = [](Layered const& l) { return std::pair(std::lround(l.low / 1e-9), std::lround(l.high / 1e-9)); };
  for (auto const& l : all) sums[key(l)] += l.contact->share;
  for (auto& l : all) l.fraction = l.contact->share / sums[key(l)];
}

/// Intervals of a site's contacts along the line through `origin`; empty if the site does not lie along it.
std::vector<Layered> layers(Site const& site, Eigen::Vector3d const& origin, Eigen::Vector3d const& axis) {
  std::vector<Layered> all;
  bool const box = site.kind == Site::Kind::plane || site.kind == Site::Kind::volume;
  for (auto const& contact : site.contacts) {
    double low, high;
    if (box) {
      low = (contact.box.min() - origin).dot(axis);
      high = (contact.box.max() - origin).dot(axis);
    } else {
      double const shift = (site.origin - origin).dot(axis), sense = site.axis.dot(axis);
      low = shift + sense * contact.low;
      high = shift + sense * contact.high;
    }
    all.push_back({&contact, std::min(low, high), std::max(low, high), 1.0});
  }
  set_fractions(all);
  return all;
}

/// Length that two layers share; a ring (no length) counts where it lies, by its own share.
double common(Layered const& a, Layered const& b) {
  bool const ring_a = a.high - a.low < 1e-12, ring_b = b.high - b.low < 1e-12;
  if (ring_a && ring_b) return std::abs(a.low - b.low) < tolerance ? 1.0 : 0.0;
  if (ring_a) return b.low <= a.low && a.low < b.high ? 1.0 : 0.0;
  if (ring_b) return a.low <= b.low && b.low < a.high ? 1.0 : 0.0;
  return overlap(a.low, a.high, b.low, b.high);
}

double part(Layered const& layer, double length) {
  double const own = layer.high - layer.low;
  return own > 0.0 ? layer.contact->area * std::min(1.0, length / own) : 0.0;
}

std::vector<Pair> along_axis(Site const& a, Site const& b) {
  std::vector<Pair> pairs;
  auto const of_a = layers(a, a.origin, a.axis), of_b = layers(b, a.origin, a.axis);
  for (auto const& i : of_a)
    for (auto const& j : of_b) {
      double const length = common(i, j);
      if (length > 1e-12)
        pairs.push_back(pair_of(*i.contact, *j.contact, length * i.fraction * j.fraction, part(i, length) * j.fraction,
                                part(j, length) * i.fraction));
    }
  return pairs;
}

std::vector<Pair> in_plane(Site const& a, Site const& b) {
  double const distance = (b.contacts[0].box.min() - a.contacts[0].box.min()).dot(a.normal);
  if (std::abs(distance) > tolerance) reject(a, b, fmt::format("their planes are {:.6g} m apart", std::abs(distance)));
  std::vector<Pair> pairs;
  for (auto const& i : a.contacts)
    for (auto const& j : b.contacts) {
      double area = 1.0;
      for (int d = 0; d < 3; ++d)
        if (a.normal[d] == 0.0) area *= overlap(i.box.min()[d], i.box.max()[d], j.box.min()[d], j.box.max()[d]);
      if (area > 1e-15) pairs.push_back(pair_of(i, j, area, area, area));
    }
  return pairs;
}

Eigen::Vector3d position_of_end(Site const& site) { return site.contacts[0].centre; }

std::vector<Pair> end_on_end(Site const& a, Site const& b) {
  std::vector<Pair> pairs;
  for (auto const& i : a.contacts)
    for (auto const& j : b.contacts) {
      double const inner = std::max(i.inner_radius, j.inner_radius), outer = std::min(i.outer_radius, j.outer_radius);
      double const area = std::numbers::pi * (outer * outer - inner * inner);
      if (outer > inner && area > 1e-15) pairs.push_back(pair_of(i, j, area, area, area));
    }
  return pairs;
}

std::vector<Pair> end_on_plane(Site const& end, Site const& plane) {
  Eigen::Vector3d const c = position_of_end(end);
  double const distance = (plane.contacts[0].box.min() - c).dot(plane.normal);
  if (std::abs(distance) > tolerance) reject(end, plane, fmt::format("they are {:.6g} m apart", std::abs(distance)));
  int normal = 0;
  plane.normal.cwiseAbs().maxCoeff(&normal);
  int const u = (normal + 1) % 3, v = (normal + 2) % 3;
  std::vector<Pair> pairs;
  for (auto const& i : end.contacts)
    for (auto const& j : plane.contacts) {
      auto const disc = [&](double r) {
        return disc_in_rectangle(r, j.box.min()[u] - c[u], j.box.max()[u] - c[u], j.box.min()[v] - c[v],
                                 j.box.max()[v] - c[v]);
      };
      double const area = disc(i.outer_radius) - disc(i.inner_radius);
      if (area > 1e-12) pairs.push_back(pair_of(i, j, area, area, area));
    }
  return pairs;
}

bool parallel(Eigen::Vector3d const& a, Eigen::Vector3d const& b) { return a.cross(b).norm() < 1e-6; }

bool along_an_edge(Eigen::Vector3d const& axis) { return axis.cwiseAbs().maxCoeff() > 1.0 - 1e-9; }

void require_coaxial(Site const& a, Site const& b) {
  if (!parallel(a.axis, b.axis)) reject(a, b, "their axes are not parallel");
  double const distance = (b.origin - a.origin).cross(a.axis).norm();
  if (distance > tolerance) reject(a, b, fmt::format("their axes are {:.6g} m apart", distance));
}

std::vector<Pair> swapped(std::vector<Pair> pairs) {
  for (auto& p : pairs) std::swap(p.a, p.b);
  return pairs;
}

std::vector<Pair> pairs_that_touch(Site const& a, Site const& b) {
  using Kind = Site::Kind;
  auto const is = [&](Kind x, Kind y) { return a.kind == x && b.kind == y; };
  if (single(a) || single(b)) return by_product(a, b);
  if (is(Kind::plane, Kind::plane) && parallel(a.normal, b.normal)) return in_plane(a, b);
  if (is(Kind::axial, Kind::axial)) return require_coaxial(a, b), along_axis(a, b);
  if (a.kind == Kind::axial && (b.kind == Kind::plane || b.kind == Kind::volume) && along_an_edge(a.axis))
    return along_axis(a, b);
  if (is(Kind::end, Kind::plane) && parallel(a.normal, b.normal)) return end_on_plane(a, b);
  if (is(Kind::end, Kind::end)) {
    require_coaxial(a, b);
    double const distance = (position_of_end(a) - position_of_end(b)).norm();
    if (distance > tolerance) reject(a, b, fmt::format("they are {:.6g} m apart", distance));
    return end_on_end(a, b);
  }
  if (a.kind > b.kind) return swapped(pairs_that_touch(b, a));
  reject(a, b, "say which faces, or which parts along one axis, meet");
}

}  // namespace

std::vector<Pair> pair(Site const& a, Site const& b) {
  auto pairs = pairs_that_touch(a, b);
  double sum = 0.0;
  for (auto const& p : pairs) sum += p.share;
  if (!(sum > 0.0)) reject(a, b, "nothing of them overlaps");
  for (auto& p : pairs) p.share /= sum;
  return pairs;
}

namespace {

template <class Resistance>
void add_pairs(NetworkBuilder& builder, int part, Site const& a, Site const& b, Resistance of) {
  int const first_a = builder.range(a.body).first, first_b = builder.range(b.body).first;
  for (auto const& p : pair(a, b))
    builder.connect(part, {Port::Kind::node, first_a + p.a}, {Port::Kind::node, first_b + p.b}, 1.0 / of(p));
}

}  // namespace

void connect(NetworkBuilder& builder, int part, Site const& a, Site const& b, double conductance) {
  require_positive(a.body + "' to '" + b.body, "conductance [W/K]", conductance);
  add_pairs(builder, part, a, b, [&](Pair const& p) { return p.resistance + 1.0 / (conductance * p.share); });
}

void connect_by_area(NetworkBuilder& builder, int part, Site const& a, Site const& b, double coefficient) {
  require_positive(a.body + "' to '" + b.body, "coefficient [W/(m2 K)]", coefficient);
  add_pairs(builder, part, a, b, [&](Pair const& p) {
    require_positive(a.body + "' to '" + b.body, "area of contact [m2]", p.area);
    return p.resistance + 1.0 / (coefficient * p.area);
  });
}

void weld(NetworkBuilder& builder, int part, Site const& a, Site const& b) {
  add_pairs(builder, part, a, b, [&](Pair const& p) {
    require_positive(a.body + "' to '" + b.body, "resistance of the cells that touch [K/W]", p.resistance);
    return p.resistance;
  });
}

}  // namespace thermotwin::thermal
