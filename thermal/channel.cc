#include "thermal/channel.h"

#include <cmath>
#include <numbers>

#include "thermal/laws.h"

namespace thermotwin::thermal {

double hydraulic_diameter(Channel const& channel) { return 4.0 * channel.section_area / channel.wetted_perimeter; }

Body make_body(std::string const& name, Channel const& channel) {
  require_positive(name, "length [m]", channel.length);
  require_positive(name, "section area [m2]", channel.section_area);
  require_positive(name, "wetted perimeter [m]", channel.wetted_perimeter);
  require_positive(name, "density [kg/m3]", channel.density);
  require_positive(name, "specific heat [J/(kg K)]", channel.specific_heat);
  require_positive(name, "number of cells", channel.cells);
  require_positive(name, "length of the axis vector", channel.axis.norm());
  double const step = channel.length / channel.cells;
  double const radius = std::sqrt(channel.section_area / std::numbers::pi);
  Body body;
  body.name = name;
  body.shape = Body::Shape::axial;
  body.origin = channel.origin;
  body.axis = channel.axis.normalized();
  body.edges[0] = equal_edges(channel.length, channel.cells);
  body.stations[0] = middles(body.edges[0]);
  for (int i = 0; i < channel.cells; ++i) {
    double const low = body.edges[0][std::size_t(i)], high = body.edges[0][std::size_t(i) + 1];
    Eigen::Vector3d const start = body.origin + low * body.axis;
    body.cells.push_back(RingCell{start, body.axis, step, 0.0, radius});
    body.capacities.push_back(channel.density * channel.specific_heat * channel.section_area * step);
    body.faces["wall"].push_back({i, channel.wetted_perimeter * step, 0.0, start + 0.5 * step * body.axis,
                                  Eigen::Vector3d::Zero(), low, high, radius, radius});
  }
  return body;
}

void add_flow(NetworkBuilder& builder, int part, Body const& channel, double specific_heat, int mass_flow, Port inlet,
              Port outlet) {
  Port upstream = inlet;
  for (int i = 0; i < channel.nodes(); ++i) {
    Port const here{Port::Kind::node, builder.range(channel.name).first + i};
    builder.add<Advection>(part, {upstream, here}, {specific_heat}, {mass_flow});
    upstream = here;
  }
  builder.add<Advection>(part, {upstream, outlet}, {specific_heat}, {mass_flow});
}

}  // namespace thermotwin::thermal
