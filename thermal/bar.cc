#include "thermal/bar.h"

#include <fmt/format.h>
#include <numbers>

#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

void check(std::string const& name, Bar const& bar) {
  require_positive(name, "length [m]", bar.length);
  require_positive(name, "outer diameter [m]", bar.outer_diameter);
  require_positive(name, "number of cells", bar.cells);
  require_positive(name, "length of the axis vector", bar.axis.norm());
  require_positive(name, "conductivity [W/(m K)]", bar.material.conductivity);
  if (bar.section_area) require_positive(name, "section area [m2]", *bar.section_area);
  if (!(bar.inner_diameter >= 0.0 && bar.inner_diameter < bar.outer_diameter))
    throw InputError(fmt::format("'{}': the inner diameter is {} m; it must lie between 0 and the outer one, {} m",
                                 name, bar.inner_diameter, bar.outer_diameter));
}

}  // namespace

Body make_body(std::string const& name, Bar const& bar) {
  check(name, bar);
  double const outer = 0.5 * bar.outer_diameter, inner = 0.5 * bar.inner_diameter;
  double const section = bar.section_area.value_or(std::numbers::pi * (outer * outer - inner * inner));
  double const step = bar.length / bar.cells;
  Body body;
  body.name = name;
  body.shape = Body::Shape::axial;
  body.origin = bar.origin;
  body.axis = bar.axis.normalized();
  body.edges[0] = equal_edges(bar.length, bar.cells);
  body.stations[0] = middles(body.edges[0]);
  body.conductivity_slope = bar.material.conductivity_slope;
  body.capacity_slope = bar.material.specific_heat_slope;
  for (int i = 0; i < bar.cells; ++i) {
    double const low = body.edges[0][std::size_t(i)], high = body.edges[0][std::size_t(i) + 1];
    Eigen::Vector3d const start = body.origin + low * body.axis;
    body.cells.push_back(RingCell{start, body.axis, high - low, inner, outer});
    body.capacities.push_back(bar.material.density * bar.material.specific_heat * section * step);
    if (i > 0) body.links.push_back({i - 1, i, bar.material.conductivity * section / step});
    body.faces["surface"].push_back({i, std::numbers::pi * bar.outer_diameter * step, 0.0,
                                     start + 0.5 * step * body.axis, Eigen::Vector3d::Zero(), low, high, outer, outer});
  }
  double const half = 0.5 * step / bar.material.conductivity;
  Eigen::Vector3d const end = body.origin + bar.length * body.axis;
  body.faces["start"] = {{0, section, half, body.origin, -body.axis, 0.0, 0.0, inner, outer}};
  body.faces["end"] = {{bar.cells - 1, section, half, end, body.axis, bar.length, bar.length, inner, outer}};
  return body;
}

}  // namespace thermotwin::thermal
