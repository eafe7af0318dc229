#include "twin/challenge/refined_form.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <optional>

#include "thermal/bounding_box.h"
#include "thermal/units.h"
#include "twin/assembly.h"
#include "twin/bodies.h"
#include "twin/file/document.h"
#include "twin/file/tables.h"

namespace thermotwin::twin {
namespace {

using Box = Eigen::AlignedBox3d;

constexpr int bar_refinement = 5;  // odd: the middle of a cell stays the middle of one
constexpr double least_refinement = 10.5;
constexpr double touch = 1e-6;          // [m]
constexpr double plate_capacity = 1.0;  // [J/K]
constexpr double most_added = 0.15;     // of a joint's resistance
constexpr double most_within = 1.05;    // of it inside the two blocks
constexpr double most_solid = 0.8;      // denser lumps are round or bored: the box is not their form

bool plain(std::string const& place) { return place.find_first_of("[.") == std::string::npos; }
std::string mm(double metres) { return fmt::format("{:.9g} mm", metres * 1e3); }
std::string stretch(double low, double high) { return mm(low) + " .. " + mm(high); }

double overlap(Box const& a, Box const& b, int d) {
  return std::min(a.max()[d], b.max()[d]) - std::max(a.min()[d], b.min()[d]);
}

bool overlap_in_space(Box const& a, Box const& b) {
  return overlap(a, b, 0) > touch && overlap(a, b, 1) > touch && overlap(a, b, 2) > touch;
}

/// Where a box lies, seen from another one: in the direction in which they are furthest apart, or overlap least.
struct Facing {
  int direction;
  bool upper;  ///< b lies beyond the upper face of a
  double gap;  ///< negative where they overlap [m]
};

Facing facing(Box const& a, Box const& b) {
  Facing nearest{0, true, -INFINITY};
  for (int d = 0; d < 3; ++d)
    if (double const gap = -overlap(a, b, d); gap > nearest.gap) nearest = {d, b.center()[d] > a.center()[d], gap};
  return nearest;
}

bool touching(Box const& a, Box const& b) {
  auto const side = facing(a, b);
  if (std::abs(side.gap) > touch) return false;
  for (int d = 0; d < 3; ++d)
    if (d != side.direction && overlap(a, b, d) <= touch) return false;
  return true;
}

std::string face_name(int direction, bool upper) {
  return fmt::format("{}_{}", "xyz"[direction], upper ? "max" : "min");
}

/// The part of a block's face that looks at another box; all of it where nothing does.
std::string face_towards(std::string const& block, Box const& own, Box const& other) {
  auto const side = facing(own, other);
  std::vector<std::string> extents;
  for (int d = 0; d < 3; ++d) {
    if (d == side.direction) continue;
    bool const seen = overlap(own, other, d) > touch;
    double const low = seen ? std::max(own.min()[d], other.min()[d]) : own.min()[d];
    double const high = seen ? std::min(own.max()[d], other.max()[d]) : own.max()[d];
    extents.push_back(stretch(low - own.min()[d], high - own.min()[d]));
  }
  return fmt::format("{}.{}[{}]", block, face_name(side.direction, side.upper), fmt::join(extents, ", "));
}

std::string region_within(std::string const& block, Box const& own, Box const& other) {
  Box const common = own.intersection(other);
  std::vector<std::string> extents;
  for (int d = 0; d < 3; ++d)
    extents.push_back(stretch(common.min()[d] - own.min()[d], common.max()[d] - own.min()[d]));
  return fmt::format("{}[{}]", block, fmt::join(extents, ", "));
}

/// Share of a block's face that another box covers.
double covered(Box const& own, int direction, bool upper, Box const& other) {
  double const plane = upper ? own.max()[direction] : own.min()[direction];
  if (other.min()[direction] > plane + 1e-3 || other.max()[direction] < plane - 1e-3) return 0.0;
  double share = 1.0;
  for (int d = 0; d < 3; ++d)
    if (d != direction) share *= std::max(0.0, overlap(own, other, d)) / own.sizes()[d];
  return share;
}

/// From middle to middle, as far as a joint states it: what a bare coefficient says holds for the surfaces alone.
std::optional<double> conductance_between_middles(Value const& joint) {
  auto const whole = number_in(joint, "conductance", dimension::conductance);
  auto const behind = number_in(joint, "in_series", dimension::conductance);
  if (!behind) return whole;
  double const surfaces = whole.value_or(number_in(joint, "coefficient", dimension::film_coefficient).value_or(0.0) *
                                         number_in(joint, "area", dimension::area).value_or(0.0));
  return 1.0 / (1.0 / surfaces + 1.0 / *behind);
}

std::map<std::string, thermal::Body> bodies_of(Value const& document) {
  Tables tables(document);
  return Bodies(tables).all();
}

int nodes_of(std::map<std::string, thermal::Body> const& bodies) {
  return std::accumulate(bodies.begin(), bodies.end(), 0, [](int n, auto const& b) { return n + b.second.nodes(); });
}

/// Cells along the edges of a box, as even as `along_longest` allows, at least three.
Value::List cells_of(Eigen::Vector3d const& size, int along_longest) {
  Value::List list;
  for (int d = 0; d < 3; ++d) {
    double const cells = std::round(size[d] / size.maxCoeff() * along_longest);
    list.push_back(Value{{}, std::max(3.0, cells)});
  }
  return list;
}

}  // namespace

Eigen::VectorXd rise_about_mean(thermal::Body const& body, thermal::Site const& site) {
  int const n = body.nodes();
  std::vector<Eigen::Triplet<double>> entries;
  for (auto const& link : body.links) {
    entries.emplace_back(link.a, link.a, link.conductance);
    entries.emplace_back(link.b, link.b, link.conductance);
    entries.emplace_back(link.a, link.b, -link.conductance);
    entries.emplace_back(link.b, link.a, -link.conductance);
  }
  entries.emplace_back(0, 0, body.links[0].conductance);  // holds the level, which is taken out below
  Eigen::SparseMatrix<double> conduction(n, n);
  conduction.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd capacity_share = Eigen::Map<Eigen::VectorXd const>(body.capacities.data(), n);
  capacity_share /= capacity_share.sum();
  Eigen::VectorXd heat = -capacity_share;
  for (auto const& contact : site.contacts) heat[contact.node] += contact.share;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> const solver(conduction);
  Eigen::VectorXd const rise = solver.solve(heat);
  return rise.array() - capacity_share.dot(rise);
}

double resistance_to_mean(thermal::Body const& body, thermal::Site const& site) {
  if (body.nodes() < 2) return 0.0;
  Eigen::VectorXd const rise = rise_about_mean(body, site);
  double resistance = 0.0;
  for (auto const& contact : site.contacts) {
    resistance += contact.share * rise[contact.node];
    if (contact.area > 0.0) resistance += contact.share * contact.share * contact.half_resistance / contact.area;
  }
  return resistance;
}

RefinedForm::RefinedForm(Value const& machine_document) : document_(machine_document) {
  erase_key(document_, "uncertain");
  read_solids();
  make_blocks();
  make_cells();
  stiffen_blocks();
  refine_parts();
  place_sensors();
}

Value refined_form(Value const& machine_document) { return RefinedForm(machine_document).document(); }

Eigen::AlignedBox3d RefinedForm::box(std::string const& body) const {
  auto const it = solids_.find(body);
  return it == solids_.end() ? Box() : it->second.box;
}

void RefinedForm::read_solids() {
  auto const bodies = bodies_of(document_);
  nominal_nodes_ = nodes_of(bodies);
  for (auto const& kind : {"lump", "bar", "hollow_cylinder", "block"})
    for (auto const* table : tables_of(document_, kind)) {
      auto const name = name_in(*table);
      solids_[name] = {thermal::bounding_box(bodies.at(name).cells), std::string(kind) == "block",
                       std::string(kind) == "bar"};
    }
}

/// Lumps of metal whose mass fits into their box become blocks.
void RefinedForm::make_blocks() {
  Tables tables(document_);
  Bodies const bodies(tables);
  Value::List kept, blocks;
  for (auto const* table : tables_of(document_, "lump")) {
    auto const name = name_in(*table);
    auto const mass = number_in(*table, "mass", dimension::mass);
    bool const drawn = table->find("corner") && table->find("size");
    double const solidity =
        mass && drawn && bodies.material_of(name) ? *mass / (bodies.metal_of(name).density * box(name).volume()) : 2.0;
    if (table->find("heat_capacity") || solidity > most_solid) {
      kept.push_back(*table);
      continue;
    }
    Value block = *table;
    erase_key(block, "mass");
    set_key(block, "solidity", solidity);
    blocks.push_back(std::move(block));
    solids_.at(name).block = true;
  }
  set_key(document_, "lump", std::move(kept));
  for (auto& block : blocks) append_table(document_, "block", std::move(block));
}

void RefinedForm::make_cells() {
  for (auto* table : tables_of(document_, "bar"))
    set_key(*table, "cells",
            std::int64_t(bar_refinement * number_in(*table, "cells", dimension::dimensionless).value_or(10.0)));
  for (int along = 6; along <= 16; ++along) {
    for (auto* table : tables_of(document_, "block"))
      set_key(*table, "cells", cells_of(box(name_in(*table)).sizes(), along));
    bodies_ = bodies_of(document_);
    if (nodes_of(bodies_) >= least_refinement * nominal_nodes_) return;
  }
}

std::vector<std::string> RefinedForm::free_faces(std::string const& block) const {
  Box const own = box(block);
  std::vector<std::pair<double, std::string>> faces;
  for (int d = 0; d < 3; ++d)
    for (bool const upper : {false, true}) {
      double hidden = 0.0;
      for (auto const& [name, solid] : solids_)
        if (name != block) hidden = std::max(hidden, covered(own, d, upper, solid.box));
      double const area = own.volume() / own.sizes()[d];
      if (hidden < 0.5) faces.emplace_back(-area, block + "." + face_name(d, upper));
    }
  std::sort(faces.begin(), faces.end());
  std::vector<std::string> names;
  for (auto const& face : faces) names.push_back(face.second);
  return names;
}

double RefinedForm::own_resistance(std::string const& place) const {
  auto const name = body_of(place);
  if (!is_block(name)) return 0.0;
  auto const& body = bodies_.at(name);
  return resistance_to_mean(body, site_of(body, place));
}

/// Where a block meets another body.
std::string RefinedForm::contact_place(std::string const& text, std::string const& other) const {
  auto const name = body_of(text);
  if (!is_block(name) || !plain(text) || !solids_.contains(body_of(other))) return text;
  Box const own = box(name), beyond = box(body_of(other));
  return overlap_in_space(own, beyond) ? region_within(name, own, beyond) : face_towards(name, own, beyond);
}

/// A block that would resist more than a joint's stated resistance conducts better: its metal lies along the flow.
void RefinedForm::stiffen_blocks() {
  std::map<std::string, double> factors;
  for (auto const* table : tables_of(document_, "joint")) {
    auto const conductance = conductance_between_middles(*table);
    if (!conductance) continue;
    auto const from = texts_of(*table, "from").at(0), to = texts_of(*table, "to").at(0);
    double const within = own_resistance(contact_place(from, to)) + own_resistance(contact_place(to, from));
    for (auto const& block : {body_of(from), body_of(to)})
      if (is_block(block)) factors[block] = std::max(factors[block], within * *conductance / most_within);
  }
  Tables tables(document_);
  Bodies const bodies(tables);
  for (auto* table : tables_of(document_, "block")) {
    auto const name = name_in(*table);
    if (!(factors[name] > 1.0)) continue;
    thermal::Material const& metal = bodies.metal_of(name);
    auto const own = fmt::format("{} of {}", metal.name, name);
    append_table(document_, "material",
                 make_table(table->where,
                            {{"name", own},
                             {"like", texts_of(*table, "material").at(0)},
                             {"conductivity",
                              thermal::format_quantity(factors[name] * metal.conductivity, dimension::conductivity)},
                             {"density", thermal::format_quantity(metal.density, dimension::density)},
                             {"specific_heat", thermal::format_quantity(metal.specific_heat, dimension::specific_heat)},
                             {"expansion", thermal::format_quantity(metal.expansion, dimension::expansion)}}));
    set_key(*table, "material", own);
  }
  for (auto* table : tables_of(document_, "material"))
    if (auto const like = texts_of(*table, "like"); !like.empty())
      for (auto const* other : tables_of(document_, "material"))
        if (name_in(*other) == like[0]) set_key(*table, "like", texts_of(*other, "like").at(0));
  bodies_ = bodies_of(document_);
}

void RefinedForm::correct_conductance(Value& table, std::string const& from, std::string const& to) const {
  auto const conductance = conductance_between_middles(table);
  if (!conductance || (!is_block(body_of(from)) && !is_block(body_of(to)))) return;
  double const stated = 1.0 / *conductance, blocks = own_resistance(from) + own_resistance(to);
  double const left = std::max(0.1 * stated, std::min(stated, (1.0 + most_added) * stated - blocks));
  set_key(table, "conductance", thermal::format_quantity(1.0 / left, dimension::conductance));
  for (auto const& key : {"coefficient", "area", "in_series"}) erase_key(table, key);
}

/// A joint between two bodies: directly where they touch, through a plate elsewhere.
void RefinedForm::join(Value& document, std::string const& kind, Value table) const {
  auto const from = texts_of(table, "from").at(0), to = texts_of(table, "to").at(0);
  auto const a = body_of(from), b = body_of(to);
  auto const here = contact_place(from, to), there = contact_place(to, from);
  bool const lump_or_same = (!is_block(a) && !solids_.at(a).bar) || (!is_block(b) && !solids_.at(b).bar);
  bool const meet = is_block(a) && is_block(b) ? touching(box(a), box(b)) : overlap_in_space(box(a), box(b));
  correct_conductance(table, here, there);
  if ((!is_block(a) && !is_block(b)) || lump_or_same || meet || kind != "joint") {
    set_key(table, "from", here);
    set_key(table, "to", there);
    return append_table(document, kind, std::move(table));
  }
  double const conductance = number_in(table, "conductance", dimension::conductance)
                                 .value_or(number_in(table, "coefficient", dimension::film_coefficient).value_or(0.0) *
                                           number_in(table, "area", dimension::area).value_or(0.0));
  auto const plate = name_in(table) + "_plate";
  append_table(
      document, "lump",
      make_table(table.where, {{"name", plate},
                               {"heat_capacity", thermal::format_quantity(plate_capacity, dimension::heat_capacity)}}));
  for (auto const& [place, suffix] : {std::pair(here, "_from"), std::pair(there, "_to")})
    append_table(document, kind,
                 make_table(table.where,
                            {{"name", name_in(table) + suffix},
                             {"from", place},
                             {"to", plate},
                             {"conductance", thermal::format_quantity(2.0 * conductance, dimension::conductance)}}));
}

void RefinedForm::append(Value& document, std::string const& kind, Value table) const {
  auto const from = texts_of(table, "from"), to = texts_of(table, "to");
  bool const two_solids =
      from.size() == 1 && to.size() == 1 && solids_.contains(body_of(from[0])) && solids_.contains(body_of(to[0]));
  if (two_solids && (kind == "joint" || kind == "contact_joint")) return join(document, kind, std::move(table));
  std::vector<std::string> on;
  for (auto const& place : texts_of(table, "on")) {
    bool const lump_before = is_block(place);
    auto const faces = lump_before ? free_faces(place) : std::vector{place};
    if (faces.empty())
      throw FileError(table.where, fmt::format("a hidden world makes '{}' a block, but no face of its box is free for "
                                               "this {}: it lies inside others; move 'corner' and 'size' apart",
                                               place, kind));
    on.insert(on.end(), faces.begin(), kind == "film" ? faces.end() : faces.begin() + 1);
  }
  if (kind == "film")
    set_key(table, "on", list_of(on));
  else if (!on.empty())
    set_key(table, "on", on[0]);
  append_table(document, kind, std::move(table));
}

void RefinedForm::refine_parts() {
  for (std::string const kind : {"joint", "contact_joint", "film", "radiation", "draught", "flood_coolant"}) {
    if (!document_.find(kind)) continue;
    Value::List const tables = std::get<Value::List>(document_.find(kind)->content);
    set_key(document_, kind, Value::List{});
    for (auto const& table : tables) append(document_, kind, table);
  }
}

/// The point of a block's free faces that stands best for its mean while heat comes in by its joints.
std::string RefinedForm::sensor_place(std::string const& block) const {
  auto const& body = bodies_.at(block);
  std::vector<Eigen::VectorXd> rises;
  for (std::string const kind : {"joint", "contact_joint"}) {
    Value const* joints = document_.find(kind);
    if (!joints) continue;
    for (auto const& joint : std::get<Value::List>(joints->content))
      for (std::string const side : {"from", "to"})
        if (auto const place = texts_of(joint, side).at(0); body_of(place) == block) {
          auto const rise = rise_about_mean(body, site_of(body, place));
          rises.push_back(rise / rise.cwiseAbs().maxCoeff());
        }
  }
  std::string best = block;
  double least = INFINITY;
  constexpr double shares[] = {0.55, 0.45, 0.3, 0.7, 0.2, 0.85};
  for (auto const& face : free_faces(block))
    for (double const along_u : shares)
      for (double const along_v : shares) {
        std::vector<std::string> extents;
        for (int d = 0; d < 3; ++d)
          if (face[block.size() + 1] != "xyz"[d])
            extents.push_back(mm((extents.empty() ? along_u : along_v) * box(block).sizes()[d]));
        auto const place = fmt::format("{}[{}]", face, fmt::join(extents, ", "));
        double deviation = 0.0;
        for (auto const& rise : rises) {
          double seen = 0.0;
          for (auto const& contact : site_of(body, place).contacts) seen += contact.share * rise[contact.node];
          deviation += seen * seen;
        }
        if (deviation < least) least = deviation, best = place;
      }
  return best;
}

void RefinedForm::place_sensors() {
  for (auto* table : tables_of(document_, "temperature_sensor")) {
    auto places = texts_of(*table, "at");
    for (auto& place : places)
      if (is_block(place)) place = sensor_place(place);
    set_key(*table, "at", list_of(places));
  }
}

}  // namespace thermotwin::twin
