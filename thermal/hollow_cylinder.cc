#include "thermal/hollow_cylinder.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

using std::numbers::pi;

void check(std::string const& name, HollowCylinder const& c) {
  require_positive(name, "length [m]", c.length);
  require_positive(name, "outer diameter [m]", c.outer_diameter);
  require_positive(name, "number of axial cells", c.axial_cells);
  require_positive(name, "number of radial cells", c.radial_cells);
  require_positive(name, "length of the axis vector", c.axis.norm());
  require_positive(name, "conductivity [W/(m K)]", c.material.conductivity);
  if (!(c.inner_diameter >= 0.0 && c.inner_diameter < c.outer_diameter))
    throw InputError(fmt::format("'{}': the inner diameter is {} m; it must lie between 0 and the outer one, {} m",
                                 name, c.inner_diameter, c.outer_diameter));
}

Body grid(std::string const& name, HollowCylinder const& c) {
  Body body;
  body.name = name;
  body.shape = Body::Shape::axial;
  body.origin = c.origin;
  body.axis = c.axis.normalized();
  body.edges[0] = equal_edges(c.length, c.axial_cells);
  body.stations[0] = middles(body.edges[0]);
  for (double depth : equal_edges(0.5 * (c.outer_diameter - c.inner_diameter), c.radial_cells))
    body.edges[1].push_back(0.5 * c.inner_diameter + depth);
  for (std::size_t j = 1; j < body.edges[1].size(); ++j)
    body.stations[1].push_back(mean_radius(body.edges[1][j - 1], body.edges[1][j]));
  body.conductivity_slope = c.material.conductivity_slope;
  body.capacity_slope = c.material.specific_heat_slope;
  return body;
}

void add_cells_and_links(Body& body, HollowCylinder const& c) {
  auto const& radius = body.edges[1];
  double const step = c.length / c.axial_cells, k = c.material.conductivity;
  for (int i = 0; i < c.axial_cells; ++i)
    for (int j = 0; j < c.radial_cells; ++j) {
      auto const r = std::size_t(j);
      double const section = pi * (radius[r + 1] * radius[r + 1] - radius[r] * radius[r]);
      Eigen::Vector3d const start = body.origin + body.edges[0][std::size_t(i)] * body.axis;
      body.cells.push_back(RingCell{start, body.axis, step, radius[r], radius[r + 1]});
      body.capacities.push_back(c.material.density * c.material.specific_heat * section * step);
      if (i > 0) body.links.push_back({body.cell(i - 1, j), body.cell(i, j), k * section / step});
      if (j > 0)
        body.links.push_back({body.cell(i, j - 1), body.cell(i, j),
                              2.0 * pi * k * step / std::log(body.stations[1][r] / body.stations[1][r - 1])});
    }
}

void add_mantle(Body& body, HollowCylinder const& c, std::string const& face, double radius, int ring) {
  double const step = c.length / c.axial_cells;
  double const half =
      radius * std::abs(std::log(radius / body.stations[1][std::size_t(ring)])) / c.material.conductivity;
  for (int i = 0; i < c.axial_cells; ++i) {
    double const low = body.edges[0][std::size_t(i)], high = body.edges[0][std::size_t(i) + 1];
    body.faces[face].push_back({body.cell(i, ring), 2.0 * pi * radius * step, half,
                                body.origin + 0.5 * (low + high) * body.axis, Eigen::Vector3d::Zero(), low, high,
                                radius, radius});
  }
}

void add_end(Body& body, HollowCylinder const& c, std::string const& face, bool far) {
  double const half = 0.5 * c.length / c.axial_cells / c.material.conductivity;
  double const position = far ? c.length : 0.0;
  int const layer = far ? c.axial_cells - 1 : 0;
  for (int j = 0; j < c.radial_cells; ++j) {
    double const a = body.edges[1][std::size_t(j)], b = body.edges[1][std::size_t(j) + 1];
    body.faces[face].push_back({body.cell(layer, j), pi * (b * b - a * a), half, body.origin + position * body.axis,
                                (far ? 1.0 : -1.0) * body.axis, position, position, a, b});
  }
}

}  // namespace

double mean_radius(double a, double b) {
  double const inner = a > 0.0 ? a * a * std::log(a / b) : 0.0;
  return b * std::exp(-inner / (b * b - a * a) - 0.5);
}

Body make_body(std::string const& name, HollowCylinder const& cylinder) {
  check(name, cylinder);
  Body body = grid(name, cylinder);
  add_cells_and_links(body, cylinder);
  add_mantle(body, cylinder, "outer", 0.5 * cylinder.outer_diameter, cylinder.radial_cells - 1);
  if (cylinder.inner_diameter > 0.0) add_mantle(body, cylinder, "inner", 0.5 * cylinder.inner_diameter, 0);
  add_end(body, cylinder, "start", false);
  add_end(body, cylinder, "end", true);
  return body;
}

}  // namespace thermotwin::thermal
