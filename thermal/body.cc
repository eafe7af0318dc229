#include "thermal/body.h"

#include <cmath>
#include <fmt/format.h>

#include "thermal/error.h"
#include "thermal/laws.h"
#include "thermal/nearest_name.h"

namespace thermotwin::thermal {

int Body::cell(int i, int j, int k) const {
  return shape == Shape::block ? i + count(0) * (j + count(1) * k) : i * count(1) + j;
}

std::vector<Facet> const& Body::face(std::string const& face_name) const {
  auto const found = faces.find(face_name);
  if (found != faces.end()) return found->second;
  std::vector<std::string> known;
  for (auto const& [known_name, facets] : faces) known.push_back(known_name);
  throw InputError(fmt::format("the body '{}' has no face '{}'; {}", name, face_name, did_you_mean(face_name, known)));
}

Port add_to(NetworkBuilder& builder, int part, Body const& body) {
  Port const first = builder.add_body(body.name, body.capacities, body.capacity_slope);
  auto const node = [&](int cell) { return Port{Port::Kind::node, first.index + cell}; };
  for (auto const& link : body.links) {
    if (body.conductivity_slope == 0.0)
      builder.connect(part, node(link.a), node(link.b), link.conductance);
    else
      builder.add<TemperatureDependentConductance>(part, {node(link.a), node(link.b)},
                                                   {link.conductance, body.conductivity_slope});
  }
  return first;
}

BodyGeometry geometry_of(Body const& body, int first_node) { return {body.name, first_node, body.cells}; }

void require_positive(std::string const& body, std::string const& what, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw InputError(fmt::format("'{}': the {} is {}; it must be positive", body, what, value));
}

std::vector<double> equal_edges(double length, int n) {
  std::vector<double> edges;
  for (int i = 0; i <= n; ++i) edges.push_back(length * i / n);
  return edges;
}

std::vector<double> middles(std::vector<double> const& edges) {
  std::vector<double> middle;
  for (std::size_t i = 1; i < edges.size(); ++i) middle.push_back(0.5 * (edges[i - 1] + edges[i]));
  return middle;
}

}  // namespace thermotwin::thermal
