#include "twin/bodies.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "thermal/bar.h"
#include "thermal/block.h"
#include "thermal/channel.h"
#include "thermal/error.h"
#include "thermal/hollow_cylinder.h"
#include "thermal/lump.h"
#include "thermal/nearest_name.h"
#include "twin/channel_flow.h"
#include "twin/file/document.h"

namespace thermotwin::twin {

using thermal::InputError;

namespace {

/// A place's text begins with it, and means nothing else.
void check_body_name(Value const& table, std::string const& name) {
  auto const blank_at = [&](std::size_t i) { return std::isspace(static_cast<unsigned char>(name[i])) != 0; };
  bool const begins_places =
      !name.empty() && name.find_first_of(".[") == std::string::npos && !blank_at(0) && !blank_at(name.size() - 1);
  if (begins_places && name != "ambient") return;
  throw FileError(
      where_of(table, "name"),
      fmt::format("'{}' cannot be the name of a body: it has no '.' and no '[', no blank at its ends, is not "
                  "empty, and is not 'ambient', which is the air of the room",
                  name));
}

}  // namespace

Bodies::Bodies(Tables& tables) {
  read_materials(tables);
  read_lumps(tables);
  read_bars(tables);
  read_cylinders(tables);
  read_blocks(tables);
  channels_ = tables.read<ChannelDescription>("channel");
  for (auto const& [description, table] : channels_)
    located(*table, [&, &d = description, table = table] {
      claim_cells(*table, d.name, d.cells);
      add(*table, d.name, thermal::make_body(d.name, channel_of(d)));
    });
}

void Bodies::read_materials(Tables& tables) {
  for (auto const& [description, table] : tables.read<MaterialDescription>("material"))
    located(*table, [&, &d = description] {
      thermal::Material m = thermal::material(d.like);
      m.name = d.name;
      if (d.conductivity) m.conductivity = *d.conductivity, m.conductivity_slope = 0.0;
      if (d.density) m.density = *d.density;
      if (d.specific_heat) m.specific_heat = *d.specific_heat, m.specific_heat_slope = 0.0;
      if (d.expansion) m.expansion = *d.expansion;
      if (d.youngs_modulus) m.youngs_modulus = *d.youngs_modulus;
      if (d.poisson_ratio) m.poisson_ratio = *d.poisson_ratio;
      materials_[d.name] = m;
    });
}

thermal::Material const& Bodies::material(std::string const& name) const {
  auto const it = materials_.find(name);
  if (it != materials_.end()) return it->second;
  auto names = thermal::material_names();
  for (auto const& entry : materials_) names.push_back(entry.first);
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw InputError(fmt::format(
        "unknown material '{}'; {}", name,
        thermal::did_you_mean(name, names, [&](std::string const& known) { return material(known).meaning; })));
  return thermal::material(name);
}

CarriedDescription const* Bodies::carried(std::string const& body) const {
  auto const it = carried_.find(body);
  return it == carried_.end() ? nullptr : &it->second;
}

thermal::Material const* Bodies::material_of(std::string const& body) const {
  auto const it = material_names_.find(body);
  return it == material_names_.end() ? nullptr : &material(it->second);
}

thermal::Material const& Bodies::metal_of(std::string const& body) const {
  if (auto const* known = material_of(body)) return *known;
  throw InputError(fmt::format("'{}' has no material", body));
}

/// FileError before anything is allocated for more cells than a machine may have.
void Bodies::claim_cells(Value const& table, std::string const& name, double cells) {
  cells_ += cells;
  if (cells_ <= most_cells) return;
  Value const* place = nullptr;
  for (auto const* key : {"radial_cells", "axial_cells", "cells"})
    if (Value const* given = table.find(key)) place = given;
  throw FileError(
      place ? place->where : table.where,
      fmt::format("'{}' has {:.0f} cells, the machine with it {:.0f}; allowed is {:.0f} for a whole machine, "
                  "which takes 10 GB of memory",
                  name, cells, cells_, most_cells));
}

void Bodies::add(Value const& table, std::string const& name, thermal::Body body) {
  check_body_name(table, name);
  if (bodies_.contains(name))
    throw FileError(where_of(table, "name"), fmt::format("the name '{}' is taken by another body", name));
  bodies_[name] = std::move(body);
  order_.push_back(name);
}

void Bodies::add_solid(Value const& table, std::string const& name, std::string const& material, thermal::Body body,
                       CarriedDescription const& carried) {
  add(table, name, std::move(body));
  if (!material.empty()) material_names_[name] = material;
  carried_[name] = carried;
}

void Bodies::read_lumps(Tables& tables) {
  for (auto const& [d, table] : tables.read<LumpDescription>("lump"))
    located(*table, [&, &d = d, table = table] {
      thermal::Lump lump;
      if (!(d.size.minCoeff() > 0.0)) {
        Value const& size = *table->find("size");
        throw FileError(size.where, fmt::format("'size' is {}; every edge must be positive", size.text()));
      }
      refuse_both(*table, "mass", "heat_capacity");
      if (!d.heat_capacity && (!d.mass || d.material.empty()))
        throw InputError(fmt::format("lump '{}' needs a mass and a material, or a heat_capacity", d.name));
      if (!d.material.empty()) lump.material = material(d.material);
      lump.capacity = d.heat_capacity;
      lump.mass = d.mass;
      lump.corner = d.corner;
      lump.size = d.size;
      add_solid(*table, d.name, d.material, thermal::make_body(d.name, lump), d);
    });
}

namespace {

/// No section has a longer diameter of equal area than its surface has; a tube's is at least this share of it.
constexpr double least_section = 0.05;

void check_section(Value const& table, BarDescription const& bar) {
  double const outer = bar.outer_diameter, section = bar.section_diameter.value_or(outer);
  if (section >= least_section * outer && section <= outer * (1.0 + slack_of_limit)) return;
  auto const text = [](double x) { return fmt::format("{:.4g} mm", 1e3 * x); };
  throw FileError(where_of(table, "section_diameter"),
                  fmt::format("'section_diameter' is {}; of an outer diameter of {}, allowed is {} to {}",
                              text(section), text(outer), text(least_section * outer), text(outer)));
}

thermal::Body with_capacity(thermal::Body body, double factor) {
  for (double& capacity : body.capacities) capacity *= factor;
  return body;
}

}  // namespace

void Bodies::read_bars(Tables& tables) {
  for (auto const& [d, table] : tables.read<BarDescription>("bar"))
    located(*table, [&, &d = d, table = table] {
      claim_cells(*table, d.name, d.cells);
      check_section(*table, d);
      thermal::Bar bar{material(d.material), d.origin,         d.axis(), d.length,
                       d.outer_diameter,     d.inner_diameter, {},       d.cells};
      if (d.section_diameter) bar.section_area = M_PI / 4.0 * *d.section_diameter * *d.section_diameter;
      add_solid(*table, d.name, d.material, with_capacity(thermal::make_body(d.name, bar), d.capacity_factor), d);
    });
}

void Bodies::read_cylinders(Tables& tables) {
  for (auto const& [d, table] : tables.read<HollowCylinderDescription>("hollow_cylinder"))
    located(*table, [&, &d = d, table = table] {
      claim_cells(*table, d.name, double(d.axial_cells) * d.radial_cells);
      thermal::HollowCylinder const cylinder{material(d.material), d.origin,         d.axis(),      d.length,
                                             d.outer_diameter,     d.inner_diameter, d.axial_cells, d.radial_cells};
      add_solid(*table, d.name, d.material, with_capacity(thermal::make_body(d.name, cylinder), d.capacity_factor), d);
    });
}

void Bodies::read_blocks(Tables& tables) {
  for (auto const& [d, table] : tables.read<BlockDescription>("block"))
    located(*table, [&, &d = d, table = table] {
      auto const counts = d.cell_counts();
      claim_cells(*table, d.name, double(counts[0]) * counts[1] * counts[2]);
      thermal::Block const block{material(d.material), d.corner, d.size, counts, d.solidity};
      add_solid(*table, d.name, d.material, thermal::make_body(d.name, block), d);
    });
}

}  // namespace thermotwin::twin
