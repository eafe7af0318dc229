#include "thermal/site.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

constexpr double typed_tolerance = 1e-6;  // of typed coordinates [m]

Eigen::AlignedBox3d box_of(Body const& body, int cell) {
  if (body.shape != Body::Shape::block) return {};
  auto const& box = std::get<BoxCell>(body.cells[std::size_t(cell)]);
  return {box.corner, box.corner + box.edges.rowwise().sum()};
}

Site empty_site(Body const& body, std::string place, Site::Kind kind) {
  Site site;
  site.body = body.name;
  site.place = std::move(place);
  site.kind = body.shape == Body::Shape::lump ? Site::Kind::lump : kind;
  site.origin = body.origin;
  site.axis = body.axis;
  return site;
}

/// Shares in proportion to `measures`; InputError if there is nothing.
Site normalised(Site site, std::vector<double> const& measures) {
  double const sum = std::accumulate(measures.begin(), measures.end(), 0.0);
  if (!(sum > 0.0)) throw InputError(fmt::format("'{}' has nothing at {}", site.body, site.place));
  for (std::size_t i = 0; i < measures.size(); ++i) site.contacts[i].share = measures[i] / sum;
  std::erase_if(site.contacts, [](Contact const& c) { return c.share <= 0.0; });
  return site;
}

Contact contact_of(Body const& body, Facet const& facet) {
  Contact contact{facet.cell, 0.0,        facet.area,         facet.half_resistance, facet.centre,
                  facet.low,  facet.high, facet.inner_radius, facet.outer_radius,    box_of(body, facet.cell)};
  for (int d = 0; d < 3 && body.shape == Body::Shape::block; ++d)
    if (facet.normal[d] != 0.0) contact.box.min()[d] = contact.box.max()[d] = facet.centre[d];
  return contact;
}

Site whole_face(Body const& body, std::string const& name, std::string place) {
  auto const& facets = body.face(name);
  Facet const& first = facets.front();
  bool const flat = first.normal.squaredNorm() > 0.0;
  bool const block = body.shape == Body::Shape::block;
  Site site = empty_site(body, std::move(place),
                         block  ? Site::Kind::plane
                         : flat ? Site::Kind::end
                                : Site::Kind::axial);
  site.normal = first.normal;
  for (auto const& facet : facets) site.contacts.push_back(contact_of(body, facet));
  return site;
}

double area_of(Eigen::AlignedBox3d const& box, Eigen::Vector3d const& normal) {
  if (box.isEmpty()) return 0.0;
  double area = 1.0;
  for (int d = 0; d < 3; ++d)
    if (normal[d] == 0.0) area *= box.sizes()[d];
  return area;
}

std::string text_of(Eigen::AlignedBox3d const& box) {
  return fmt::format("the box ({:.6g}, {:.6g}, {:.6g})…({:.6g}, {:.6g}, {:.6g}) m", box.min()[0], box.min()[1],
                     box.min()[2], box.max()[0], box.max()[1], box.max()[2]);
}

void require_shape(Body const& body, Body::Shape shape, char const* what) {
  if (body.shape != shape) throw InputError(fmt::format("'{}' is no {}", body.name, what));
}

struct Weight {
  int index;
  double weight;
};

/// Linear interpolation between stations, constant beyond them.
std::vector<Weight> interpolate(std::vector<double> const& stations, double x) {
  int const n = int(stations.size());
  if (n == 0) return {{0, 1.0}};
  int const above = int(std::lower_bound(stations.begin(), stations.end(), x) - stations.begin());
  if (above == 0 || above == n) return {{std::min(above, n - 1), 1.0}};
  double const left = stations[std::size_t(above) - 1], right = stations[std::size_t(above)];
  double const t = (x - left) / (right - left);
  if (t < 1e-9 || t > 1.0 - 1e-9) return {{t < 0.5 ? above - 1 : above, 1.0}};
  return {{above - 1, 1.0 - t}, {above, t}};
}

/// Place in the grid: along the axis and radius, or x, y, z from the corner.
Eigen::Vector3d local(Body const& body, Eigen::Vector3d const& position) {
  Eigen::Vector3d const offset = position - body.origin;
  if (body.shape == Body::Shape::block) return offset;
  double const along = offset.dot(body.axis);
  return {along, (offset - along * body.axis).norm(), 0.0};
}

bool inside(Body const& body, Eigen::Vector3d const& place) {
  for (int d = 0; d < 3; ++d) {
    auto const& edges = body.edges[std::size_t(d)];
    if (!edges.empty() && (place[d] < edges.front() - typed_tolerance || place[d] > edges.back() + typed_tolerance))
      return false;
  }
  if (body.shape != Body::Shape::axial || !body.edges[1].empty()) return true;
  return place[1] <= std::get<RingCell>(body.cells[0]).outer_radius + typed_tolerance;
}

std::string text_of(Eigen::Vector3d const& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", p[0], p[1], p[2]); }

}  // namespace

double Site::area() const {
  return std::accumulate(contacts.begin(), contacts.end(), 0.0, [](double a, auto const& c) { return a + c.area; });
}

Site whole(Body const& body) {
  Site site =
      empty_site(body, "the whole body", body.shape == Body::Shape::block ? Site::Kind::volume : Site::Kind::axial);
  for (int i = 0; i < body.nodes(); ++i) {
    Contact contact;
    contact.node = i;
    contact.centre = centre(body.cells[std::size_t(i)]);
    contact.box = box_of(body, i);
    if (body.shape == Body::Shape::axial) {
      auto const layer = std::size_t(i / body.count(1));
      contact.low = body.edges[0][layer];
      contact.high = body.edges[0][layer + 1];
    }
    site.contacts.push_back(contact);
  }
  return normalised(std::move(site), body.capacities);
}

Site face(Body const& body, std::string const& name) {
  Site site = whole_face(body, name, fmt::format("face '{}'", name));
  std::vector<double> areas;
  for (auto const& contact : site.contacts) areas.push_back(site.kind == Site::Kind::lump ? 1.0 : contact.area);
  return normalised(std::move(site), areas);
}

Site face(Body const& body, std::string const& name, double from, double to) {
  require_shape(body, Body::Shape::axial, "bar or cylinder: an interval along the axis says nothing here");
  Site site = whole_face(body, name, fmt::format("face '{}' from {:.6g} to {:.6g} m", name, from, to));
  if (site.kind != Site::Kind::axial)
    throw InputError(fmt::format("'{}': the face '{}' has no extent along the axis", body.name, name));
  std::vector<double> areas;
  for (auto& contact : site.contacts) {
    double const low = std::max(contact.low, from), high = std::min(contact.high, to);
    double const part = std::max(0.0, high - low) / (contact.high - contact.low);
    contact.area *= part;
    contact.low = low;
    contact.high = high;
    contact.centre = body.origin + 0.5 * (low + high) * body.axis;
    areas.push_back(contact.area);
  }
  return normalised(std::move(site), areas);
}

Site face(Body const& body, std::string const& name, Eigen::AlignedBox3d const& box) {
  require_shape(body, Body::Shape::block, "block: a box says nothing here");
  Site site = whole_face(body, name, fmt::format("face '{}' in {}", name, text_of(box)));
  std::vector<double> areas;
  for (auto& contact : site.contacts) {
    Eigen::AlignedBox3d cut = box;
    for (int d = 0; d < 3; ++d)
      if (site.normal[d] != 0.0) cut.min()[d] = cut.max()[d] = contact.centre[d];
    contact.box = contact.box.intersection(cut);
    contact.area = area_of(contact.box, site.normal);
    contact.centre = contact.box.center();
    areas.push_back(contact.area);
  }
  return normalised(std::move(site), areas);
}

Site region(Body const& body, Eigen::AlignedBox3d const& box) {
  require_shape(body, Body::Shape::block, "block: a box says nothing here");
  Site site = whole(body);
  site.place = text_of(box);
  std::vector<double> volumes;
  for (auto& contact : site.contacts) {
    contact.box = contact.box.intersection(box);
    volumes.push_back(contact.box.isEmpty() ? 0.0 : contact.box.volume());
    contact.centre = contact.box.center();
  }
  return normalised(std::move(site), volumes);
}

Site point(Body const& body, Eigen::Vector3d const& position) {
  Site site = empty_site(body, "the point " + text_of(position),
                         body.shape == Body::Shape::block ? Site::Kind::volume : Site::Kind::axial);
  Eigen::Vector3d const place = local(body, position);
  if (body.shape != Body::Shape::lump && !inside(body, place))
    throw InputError(fmt::format("{} lies outside of '{}'", site.place, body.name));
  for (auto const& i : interpolate(body.stations[0], place[0]))
    for (auto const& j : interpolate(body.stations[1], place[1]))
      for (auto const& k : interpolate(body.stations[2], place[2])) {
        Contact contact;
        contact.node = body.cell(i.index, j.index, k.index);
        contact.share = i.weight * j.weight * k.weight;
        contact.centre = position;
        contact.low = contact.high = place[0];
        contact.box = Eigen::AlignedBox3d(position);
        site.contacts.push_back(contact);
      }
  std::erase_if(site.contacts, [](Contact const& c) { return c.share <= 0.0; });
  return site;
}

Site ring(Body const& body, std::string const& face_name, double position) {
  require_shape(body, Body::Shape::axial, "bar or cylinder: it has no rings");
  Site site = whole_face(body, face_name, fmt::format("face '{}' at {:.6g} m", face_name, position));
  auto const& edges = body.edges[0];
  if (site.kind != Site::Kind::axial || position < edges.front() - typed_tolerance ||
      position > edges.back() + typed_tolerance)
    throw InputError(fmt::format("{} lies outside of '{}'", site.place, body.name));
  auto const facets = std::move(site.contacts);
  site.contacts.clear();
  for (auto const& weight : interpolate(body.stations[0], position)) {
    Contact contact = facets[std::size_t(weight.index)];
    contact.share = weight.weight;
    contact.area = 0.0;
    contact.low = contact.high = position;
    contact.centre = body.origin + position * body.axis;
    if (contact.share > 0.0) site.contacts.push_back(contact);
  }
  return site;
}

Site with_area(Site site, double area) {
  require_positive(site.body, "area of " + site.place + " [m2]", area);
  for (auto& contact : site.contacts) contact.area = area * contact.share;
  return site;
}

Port port_of(NetworkBuilder const& builder, Site const& site, Contact const& contact) {
  return {Port::Kind::node, builder.range(site.body).first + contact.node};
}

Port port_of(NetworkBuilder& builder, Site const& site) {
  if (site.contacts.size() == 1) return port_of(builder, site, site.contacts[0]);
  Average average;
  average.name = fmt::format("{}, {}", site.body, site.place);
  for (auto const& contact : site.contacts) {
    average.nodes.push_back(port_of(builder, site, contact).index);
    average.weights.push_back(contact.share);
  }
  return builder.add_average(std::move(average));
}

}  // namespace thermotwin::thermal
