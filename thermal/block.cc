#include "thermal/block.h"

#include <fmt/format.h>

#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

void check(std::string const& name, Block const& block) {
  for (int d = 0; d < 3; ++d) {
    require_positive(name, fmt::format("size along {} [m]", "xyz"[d]), block.size[d]);
    require_positive(name, fmt::format("number of cells along {}", "xyz"[d]), block.cells[std::size_t(d)]);
  }
  require_positive(name, "conductivity [W/(m K)]", block.material.conductivity);
  if (!(block.solidity > 0.0 && block.solidity <= 1.0))
    throw InputError(fmt::format("'{}': the solidity is {}; it must lie between 0 and 1", name, block.solidity));
}

Body grid(std::string const& name, Block const& block) {
  Body body;
  body.name = name;
  body.shape = Body::Shape::block;
  body.origin = block.corner;
  for (int d = 0; d < 3; ++d) {
    auto const k = std::size_t(d);
    body.edges[k] = equal_edges(block.size[d], block.cells[k]);
    body.stations[k] = middles(body.edges[k]);
  }
  body.conductivity_slope = block.material.conductivity_slope;
  body.capacity_slope = block.material.specific_heat_slope;
  return body;
}

void add_facet(Body& body, std::array<int, 3> place, int d, bool far, double area, double half_resistance) {
  static char const* const names[3][2] = {{"x_min", "x_max"}, {"y_min", "y_max"}, {"z_min", "z_max"}};
  Facet facet;
  facet.cell = body.cell(place[0], place[1], place[2]);
  facet.area = area;
  facet.half_resistance = half_resistance;
  facet.centre = centre(body.cells[std::size_t(facet.cell)]);
  auto const& edges = body.edges[std::size_t(d)];
  facet.centre[d] = body.origin[d] + (far ? edges.back() : edges.front());
  facet.normal = (far ? 1.0 : -1.0) * Eigen::Vector3d::Unit(d);
  body.faces[names[d][far]].push_back(facet);
}

void add_cell(Body& body, std::array<int, 3> place, Eigen::Vector3d const& step, double conductivity, double capacity) {
  Eigen::Vector3d const corner = body.origin + step.cwiseProduct(Eigen::Vector3d(place[0], place[1], place[2]));
  body.cells.push_back(BoxCell{corner, step.asDiagonal()});
  body.capacities.push_back(capacity);
  int const here = body.cell(place[0], place[1], place[2]);
  for (int d = 0; d < 3; ++d) {
    double const area = step.prod() / step[d], half = 0.5 * step[d] / conductivity;
    auto before = place;
    if (--before[std::size_t(d)] >= 0)
      body.links.push_back({body.cell(before[0], before[1], before[2]), here, 0.5 * area / half});
    else
      add_facet(body, place, d, false, area, half);
    if (place[std::size_t(d)] + 1 == body.count(d)) add_facet(body, place, d, true, area, half);
  }
}

}  // namespace

Body make_body(std::string const& name, Block const& block) {
  check(name, block);
  Body body = grid(name, block);
  Eigen::Vector3d const step = block.size.cwiseQuotient(Eigen::Vector3d(body.count(0), body.count(1), body.count(2)));
  double const conductivity = block.solidity * block.material.conductivity;
  double const capacity = block.solidity * block.material.density * block.material.specific_heat * step.prod();
  for (int k = 0; k < body.count(2); ++k)
    for (int j = 0; j < body.count(1); ++j)
      for (int i = 0; i < body.count(0); ++i) add_cell(body, {i, j, k}, step, conductivity, capacity);
  return body;
}

}  // namespace thermotwin::thermal
