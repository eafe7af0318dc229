#include "thermal/lump.h"

namespace thermotwin::thermal {
namespace {

double capacity_of(std::string const& name, Lump const& lump) {
  if (lump.capacity) return *lump.capacity;
  double const mass = lump.mass.value_or(lump.material.density * lump.size.prod());
  require_positive(name, "mass", mass);
  return mass * lump.material.specific_heat;
}

}  // namespace

Body make_body(std::string const& name, Lump const& lump) {
  Body body;
  body.name = name;
  body.shape = Body::Shape::lump;
  body.origin = lump.corner;
  body.capacities = {capacity_of(name, lump)};
  require_positive(name, "heat capacity", body.capacities[0]);
  body.capacity_slope = lump.material.specific_heat_slope;
  body.cells = {BoxCell{lump.corner, lump.size.asDiagonal()}};
  Facet surface;
  surface.area = lump.area;
  surface.centre = centre(body.cells[0]);
  body.faces["surface"] = {surface};
  return body;
}

}  // namespace thermotwin::thermal
