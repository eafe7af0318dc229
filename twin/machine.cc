#include "twin/machine.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

#include "thermal/bar.h"
#include "thermal/block.h"
#include "thermal/channel.h"
#include "thermal/error.h"
#include "thermal/fluid.h"
#include "thermal/hollow_cylinder.h"
#include "thermal/lump.h"
#include "thermal/nearest_name.h"
#include "twin/carried_bodies.h"
#include "twin/channel_flow.h"
#include "twin/influence.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

/// The words that a message quotes.
std::vector<std::string> quoted(std::string const& message) {
  std::vector<std::string> words;
  for (std::size_t open = message.find('\''); open != std::string::npos;) {
    auto const close = message.find('\'', open + 1);
    if (close == std::string::npos) break;
    words.push_back(message.substr(open + 1, close - open - 1));
    open = message.find('\'', close + 1);
  }
  return words;
}

/// Where in a table the text stands that a message is about: the value that holds a word it quotes, else the table.
Location place_of(Value const& table, std::string const& message) {
  auto const words = quoted(message);
  auto const mentioned = [&](Value const& value) {
    if (!value.is_text()) return false;
    auto const& text = std::get<std::string>(value.content);
    return std::any_of(words.begin(), words.end(), [&](auto const& word) {
      return text == word || text.starts_with(word + "[") || text.starts_with(word + ".");
    });
  };
  for (auto const& entry : std::get<Value::Table>(table.content)) {
    if (entry.key == "name" || entry.key == "title" || entry.key == "component") continue;
    if (mentioned(entry.value)) return entry.value.where;
    if (entry.value.is_list())
      for (auto const& item : std::get<Value::List>(entry.value.content)) {
        if (mentioned(item)) return item.where;
        if (item.is_table())
          if (auto const inner = place_of(item, message); inner.line != item.where.line) return inner;
      }
  }
  return table.where;
}

/// Runs what a table asks for; a complaint gets the table's place in front.
template <class Action>
void located(Value const& table, Action action) {
  try {
    action();
  } catch (FileError const&) {
    throw;
  } catch (InputError const& error) {
    throw FileError(place_of(table, error.what()), error.what());
  }
}

template <class Description>
struct Tabled {
  Description description;
  Value const* table;
};

}  // namespace

/// Goes through a machine's document table by table.
class MachineBuilder {
 public:
  explicit MachineBuilder(Value const& document) : document_(document) {}
  Machine operator()();

 private:
  template <class T>
  std::vector<Tabled<T>> read_list(std::string const& key);
  Value::List const& list(std::string const& key) const;
  void check_keys() const;
  void read_head();
  void read_materials();
  void read_bodies();
  void read_parts();
  void read_sensors();
  void check_terms() const;
  void read_displacements();
  void read_screws();
  void read_displacement_instruments();
  void build_network();
  void hang_bodies();
  void add_body(Value const& table, std::string const& name, thermal::Body body);
  void add_solid(Value const& table, std::string const& name, thermal::Body body, CarriedDescription const& carried);
  thermal::Material const& material(std::string const& name) const;
  void unique(Value const& table, std::string const& kind, std::string const& name);
  void add_segment(Displacement& channel, DisplacementDescription const& description, LoopSegment const& segment);
  void check_closure(DisplacementDescription const& description) const;
  double segment_length(LoopSegment const& segment) const;
  double expansion_at(Place const& place, std::optional<double> given) const;
  void add_growth(NodeWeights& weights, Place const& place, double factor) const;

  Value const& document_;
  Machine machine_;
  std::map<std::string, thermal::Material> materials_;
  std::map<std::string, thermal::Body> bodies_;
  std::map<std::string, std::string> material_of_;
  std::vector<std::string> order_;
  std::map<std::string, CarriedDescription> carried_;
  std::unique_ptr<Assembly> assembly_;
  std::set<std::pair<std::string, std::string>> names_;
};

namespace {

std::vector<std::string> const& own_tables() {
  static std::vector<std::string> const names = {"name",
                                                 "title",
                                                 "spindle",
                                                 "axis",
                                                 "material",
                                                 "lump",
                                                 "bar",
                                                 "hollow_cylinder",
                                                 "block",
                                                 "channel",
                                                 "temperature_sensor",
                                                 "displacement",
                                                 "rotation",
                                                 "ball_screw",
                                                 "displacement_probe",
                                                 "five_probe_nest",
                                                 "laser"};
  return names;
}

std::vector<std::string> known_keys() {
  auto keys = own_tables();
  for (auto const& entry : effect_catalogue()) keys.push_back(entry.name);
  return keys;
}

}  // namespace

void MachineBuilder::check_keys() const {
  auto const known = known_keys();
  for (auto const& entry : std::get<Value::Table>(document_.content))
    if (std::find(known.begin(), known.end(), entry.key) == known.end())
      throw FileError(entry.where,
                      fmt::format("unknown key '{}'; {}", entry.key, thermal::did_you_mean(entry.key, known)));
}

Value::List const& MachineBuilder::list(std::string const& key) const {
  static Value::List const none;
  Value const* value = document_.find(key);
  if (!value) return none;
  if (!value->is_list())
    throw FileError(value->where, fmt::format("'{}' is {}; write each one as [[{}]]", key, value->kind(), key));
  return std::get<Value::List>(value->content);
}

template <class T>
std::vector<Tabled<T>> MachineBuilder::read_list(std::string const& key) {
  std::vector<Tabled<T>> result;
  for (auto const& table : list(key)) {
    if (!table.is_table()) throw FileError(table.where, fmt::format("write each one as [[{}]]", key));
    T description;
    read_fields(table, description);
    unique(table, key, description.name);
    result.push_back({std::move(description), &table});
  }
  return result;
}

void MachineBuilder::unique(Value const& table, std::string const& kind, std::string const& name) {
  if (names_.insert({kind, name}).second) return;
  Value const* place = table.find("name");
  throw FileError(place ? place->where : table.where,
                  fmt::format("the name '{}' is taken by another [[{}]]", name, kind));
}

void MachineBuilder::read_head() {
  for (auto const& [key, target] : {std::pair{"name", &machine_.name}, std::pair{"title", &machine_.title}})
    if (Value const* value = document_.find(key)) {
      if (!value->is_text())
        throw FileError(value->where, fmt::format("'{}' is {}; a text is due", key, value->kind()));
      *target = std::get<std::string>(value->content);
    }
  if (machine_.name.empty()) throw FileError(document_.where, "'name' is missing; write for example name = \"v450\"");
  if (Value const* table = document_.find("spindle")) {
    SpindleDescription spindle;
    read_fields(*table, spindle);
    machine_.limits.max_spindle_speed = spindle.maximum_speed;
  }
  for (auto const& [axis, table] : read_list<AxisDescription>("axis"))
    machine_.limits.axes.push_back({axis.name, axis.rapid_feed, axis.lead, axis.stroke_from, axis.stroke_to});
}

void MachineBuilder::read_materials() {
  for (auto const& [description, table] : read_list<MaterialDescription>("material"))
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

thermal::Material const& MachineBuilder::material(std::string const& name) const {
  auto const it = materials_.find(name);
  if (it != materials_.end()) return it->second;
  auto names = thermal::material_names();
  for (auto const& entry : materials_) names.push_back(entry.first);
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw InputError(fmt::format("unknown material '{}'; {}", name, thermal::did_you_mean(name, names)));
  return thermal::material(name);
}

void MachineBuilder::add_body(Value const& table, std::string const& name, thermal::Body body) {
  if (bodies_.contains(name)) {
    Value const* place = table.find("name");
    throw FileError(place ? place->where : table.where, fmt::format("the name '{}' is taken by another body", name));
  }
  bodies_[name] = std::move(body);
  order_.push_back(name);
}

void MachineBuilder::add_solid(Value const& table, std::string const& name, thermal::Body body,
                               CarriedDescription const& carried) {
  add_body(table, name, std::move(body));
  carried_[name] = carried;
}

void MachineBuilder::read_bodies() {
  for (auto const& [d, table] : read_list<LumpDescription>("lump"))
    located(*table, [&, &d = d, table = table] {
      thermal::Lump lump;
      if (!d.heat_capacity && (!d.mass || d.material.empty()))
        throw InputError(fmt::format("lump '{}' needs a mass and a material, or a heat_capacity", d.name));
      if (!d.material.empty()) lump.material = material(d.material), material_of_[d.name] = d.material;
      lump.capacity = d.heat_capacity;
      lump.mass = d.mass;
      lump.corner = d.corner;
      lump.size = d.size;
      add_solid(*table, d.name, thermal::make_body(d.name, lump), d);
    });
  for (auto const& [d, table] : read_list<BarDescription>("bar"))
    located(*table, [&, &d = d, table = table] {
      thermal::Bar bar{material(d.material), d.origin,         d.axis(), d.length,
                       d.outer_diameter,     d.inner_diameter, {},       d.cells};
      if (d.section_diameter) bar.section_area = M_PI / 4.0 * *d.section_diameter * *d.section_diameter;
      material_of_[d.name] = d.material;
      add_solid(*table, d.name, thermal::make_body(d.name, bar), d);
    });
  for (auto const& [d, table] : read_list<HollowCylinderDescription>("hollow_cylinder"))
    located(*table, [&, &d = d, table = table] {
      thermal::HollowCylinder const cylinder{material(d.material), d.origin,         d.axis(),      d.length,
                                             d.outer_diameter,     d.inner_diameter, d.axial_cells, d.radial_cells};
      material_of_[d.name] = d.material;
      add_solid(*table, d.name, thermal::make_body(d.name, cylinder), d);
    });
  for (auto const& [d, table] : read_list<BlockDescription>("block"))
    located(*table, [&, &d = d, table = table] {
      if (d.cells.size() != 3)
        throw InputError(fmt::format("'{}': cells has {} entries; three are due", d.name, d.cells.size()));
      thermal::Block const block{
          material(d.material), d.corner, d.size, {int(d.cells[0]), int(d.cells[1]), int(d.cells[2])}, d.solidity};
      material_of_[d.name] = d.material;
      add_solid(*table, d.name, thermal::make_body(d.name, block), d);
    });
  for (auto const& [d, table] : read_list<ChannelDescription>("channel"))
    located(*table,
            [&, &d = d, table = table] { add_body(*table, d.name, thermal::make_body(d.name, channel_of(d))); });
}

/// Parts are added in the order of the file, whatever their kind: a motor finds the torques that stand before it.
void MachineBuilder::read_parts() {
  std::vector<std::pair<Value const*, Effect const*>> tables;
  for (auto const& entry : effect_catalogue())
    for (auto const& table : list(entry.name)) tables.emplace_back(&table, &entry);
  std::stable_sort(tables.begin(), tables.end(), [](auto const& a, auto const& b) {
    return std::pair(a.first->where.line, a.first->where.column) <
           std::pair(b.first->where.line, b.first->where.column);
  });
  for (auto const& [table, entry] : tables) {
    if (!table->is_table()) throw FileError(table->where, fmt::format("write each one as [[{}]]", entry->name));
    auto const part = entry->read(*table);
    unique(*table, entry->name, part->name());
    assembly_->begin_part(entry->name + "." + part->name());
    located(*table, [&] {
      part->add_to(*assembly_);
      check_terms();
    });
  }
}

/// What parts add to displacements must find one of that name.
void MachineBuilder::check_terms() const {
  std::vector<std::string> names;
  for (auto const& kind : {"displacement", "rotation"})
    for (auto const& table : list(kind))
      if (Value const* name = table.is_table() ? table.find("name") : nullptr; name && name->is_text())
        names.push_back(std::get<std::string>(name->content));
  auto const check = [&](auto const& terms) {
    for (auto const& term : terms)
      if (std::find(names.begin(), names.end(), term.displacement) == names.end())
        throw InputError(fmt::format("unknown displacement '{}'; {}", term.displacement,
                                     thermal::did_you_mean(term.displacement, names)));
  };
  check(assembly_->input_terms());
  check(assembly_->temperature_terms());
}

void MachineBuilder::read_sensors() {
  for (auto& [description, table] : read_list<SensorDescription>("temperature_sensor"))
    located(*table, [&, &d = description] {
      Sensor sensor{d, {}, {0.0, 0.0, 0.0}};
      if (d.at.empty()) throw InputError(fmt::format("sensor '{}' needs a place: at = \"head\"", d.name));
      for (auto const& text : d.at) {
        if (text == "ambient") continue;
        Place const place = assembly_->place(text);
        for (auto const& contact : place.site.contacts)
          sensor.weights.emplace_back(place.first_node + contact.node, contact.share / double(d.at.size()));
        sensor.position += place.centre() / double(d.at.size());
      }
      if (sensor.weights.empty()) sensor.position = {0.0, 0.0, 1.0};
      machine_.sensors.push_back(std::move(sensor));
    });
}

double MachineBuilder::expansion_at(Place const& place, std::optional<double> given) const {
  if (given) return *given;
  auto const it = material_of_.find(place.body->name);
  if (it == material_of_.end())
    throw InputError(fmt::format("'{}' has no material; give the segment's expansion", place.body->name));
  return material(it->second).expansion;
}

void MachineBuilder::add_growth(NodeWeights& weights, Place const& place, double factor) const {
  for (auto const& contact : place.site.contacts)
    weights.emplace_back(place.first_node + contact.node, factor * contact.share);
}

/// Length of the stretch that grows: given for lumps, else that of the place along its body's axis.
double MachineBuilder::segment_length(LoopSegment const& segment) const {
  Place const place = assembly_->place(segment.of);
  if (segment.length) return *segment.length;
  if (place.body->shape != thermal::Body::Shape::axial)
    throw InputError(fmt::format(
        "segment of '{}': 'length' is missing; only a stretch of a bar or cylinder has its own", segment.of));
  double low = INFINITY, high = -INFINITY;
  for (auto const& contact : place.site.contacts) {
    low = std::min(low, contact.low);
    high = std::max(high, contact.high);
  }
  auto const open = segment.of.find('[');
  if (open == std::string::npos) return high - low;
  auto const dots = segment.of.find("..");
  auto const length = [&](std::string const& text) { return thermal::parse_value(text, dimension::length); };
  return length(segment.of.substr(dots + 2, segment.of.size() - dots - 3)) -
         length(segment.of.substr(open + 1, dots - open - 1));
}

void MachineBuilder::add_segment(Displacement& channel, DisplacementDescription const& description,
                                 LoopSegment const& segment) {
  if (!segment.rotation.empty()) {
    auto const& known = machine_.displacements;
    auto const it = std::find_if(known.begin(), known.end(),
                                 [&](auto const& d) { return d.rotation && d.name == segment.rotation; });
    if (it == known.end()) throw InputError(fmt::format("unknown rotation '{}'", segment.rotation));
    if (!segment.lever) throw InputError(fmt::format("the lever of rotation '{}' is missing", segment.rotation));
    for (auto const& [node, weight] : it->weights)
      channel.weights.emplace_back(node, segment.weight * *segment.lever * weight);
    for (auto term : it->input_terms) {
      term.coefficient *= segment.weight * *segment.lever;
      channel.input_terms.push_back(std::move(term));
    }
    return;
  }
  Place const of = assembly_->place(segment.of);
  double const alpha = expansion_at(of, segment.expansion);
  double const length = segment_length(segment);
  if (segment.against.empty()) {
    add_growth(channel.weights, of, segment.weight * alpha * length / description.base.value_or(1.0));
    return;
  }
  if (!segment.height)
    throw InputError(fmt::format("bending of '{}' against '{}' needs a height", segment.of, segment.against));
  double const factor = segment.weight * 0.5 * alpha * length * length / *segment.height;
  add_growth(channel.weights, of, factor);
  add_growth(channel.weights, assembly_->place(segment.against), -factor);
}

/// A loop of one material at one temperature grows like its offset from table to tool (physics.md 3.8).
void MachineBuilder::check_closure(DisplacementDescription const& description) const {
  if (!description.closure) return;
  double sum = 0.0;
  for (auto const& segment : description.segment)
    if (segment.rotation.empty() && segment.against.empty()) sum += segment.weight * segment_length(segment);
  for (auto const& influence : description.influence)
    sum += closing_length(influence, description.direction, assembly_->body(influence.body));
  if (std::abs(sum - *description.closure) > 1e-9)
    throw InputError(
        fmt::format("the loop of '{}' does not close: its signed lengths add up to {:.6g} mm, not to {:.6g} mm",
                    description.name, sum * 1e3, *description.closure * 1e3));
}

void MachineBuilder::read_displacements() {
  for (bool const rotation : {true, false})
    for (auto const& [description, table] : read_list<DisplacementDescription>(rotation ? "rotation" : "displacement"))
      located(*table, [&, &d = description] {
        Displacement channel{d.name, d.title, rotation, {}, {}};
        if (rotation && !d.base && !d.segment.empty())
          throw InputError(fmt::format("rotation '{}': 'base' is missing", d.name));
        for (auto const& segment : d.segment) add_segment(channel, d, segment);
        for (auto const& influence : d.influence)
          add_influence(channel.weights, document_.where.file, influence, d.direction, assembly_->body(influence.body),
                        material(material_of_.at(influence.body)), assembly_->first_node(influence.body), rotation);
        check_closure(d);
        for (auto const& term : assembly_->input_terms())
          if (term.displacement == d.name) channel.input_terms.push_back(term);
        for (auto const& term : assembly_->temperature_terms())
          if (term.displacement == d.name) add_growth(channel.weights, term.place, term.coefficient);
        machine_.displacements.push_back(std::move(channel));
      });
}

void MachineBuilder::read_screws() {
  for (auto const& [description, table] : read_list<BallScrewDescription>("ball_screw"))
    located(*table, [&, &d = description] {
      thermal::Body const& body = assembly_->body(d.body);
      if (body.shape != thermal::Body::Shape::axial) throw InputError(fmt::format("'{}' is not a bar", d.body));
      thermal::Material const& metal = material(material_of_.at(d.body));
      using Support = thermal::BallScrew::Support;
      thermal::BallScrew screw;
      screw.support = d.support == "fixed-free"    ? Support::fixed_free
                      : d.support == "fixed-fixed" ? Support::fixed_fixed
                                                   : Support::fixed_supported;
      screw.expansion = metal.expansion;
      screw.section_area =
          body.capacities[0] / (metal.density * metal.specific_heat * (body.edges[0][1] - body.edges[0][0]));
      screw.youngs_modulus = d.youngs_modulus;
      screw.stiffness_fixed = d.stiffness_fixed;
      screw.stiffness_far = d.stiffness_far;
      screw.preload_temperature = d.preload_temperature;
      screw.unilateral = d.unilateral;
      screw.released_stiffness = d.released_stiffness;
      screw.edges = body.edges[0];
      Screw built{d, screw, {}, {}, assembly_->first_node(d.body)};
      auto const add = [&](NodeWeights& weights, std::string const& text, double length) {
        if (text.empty()) return;
        Place const place = assembly_->place(text);
        add_growth(weights, place, length * expansion_at(place, {}));
      };
      add(built.seat_growth, d.seats, screw.length());
      add(built.reference_strain, d.reference, 1.0);
      machine_.screws.push_back(std::move(built));
    });
}

void MachineBuilder::read_displacement_instruments() {
  std::vector<std::string> known;
  for (auto const& channel : machine_.displacements)
    if (!channel.rotation) known.push_back(channel.name);
  for (auto& [probe, table] : read_list<ProbeDescription>("displacement_probe"))
    located(*table, [&, &p = probe] {
      if (std::find(known.begin(), known.end(), p.of) == known.end())
        throw InputError(fmt::format("unknown displacement '{}'; {}", p.of, thermal::did_you_mean(p.of, known)));
      machine_.probes.push_back(p);
    });
  if (Value const* table = document_.find("five_probe_nest")) read_fields(*table, machine_.nest.emplace());
  if (Value const* table = document_.find("laser")) read_fields(*table, machine_.laser);
}

void MachineBuilder::build_network() {
  try {
    machine_.network_ = std::make_shared<thermal::Network const>(assembly_->network().build());
  } catch (InputError const& error) {
    auto const words = quoted(error.what());
    for (auto const& kind : {"lump", "bar", "hollow_cylinder", "block", "channel"})
      for (auto const& table : list(kind))
        if (Value const* name = table.find("name"); name && !words.empty() && name->is_text()) {
          auto const& text = std::get<std::string>(name->content);
          if (words[0] == text || words[0].starts_with(text + "[")) throw FileError(name->where, error.what());
        }
    throw FileError(document_.where, error.what());
  }
  for (auto const& name : order_)
    machine_.geometry.push_back(thermal::geometry_of(bodies_.at(name), assembly_->first_node(name)));
}

void MachineBuilder::hang_bodies() {
  std::vector<HungBody> hung;
  for (auto const& name : order_)
    if (carried_.contains(name)) {
      auto const known = material_of_.find(name);
      double const expansion = known == material_of_.end() ? 0.0 : material(known->second).expansion;
      hung.push_back({name, carried_.at(name), &bodies_.at(name), assembly_->first_node(name), expansion});
    }
  try {
    machine_.growing = carried_bodies(hung);
  } catch (InputError const& error) {
    for (auto const& kind : {"lump", "bar", "hollow_cylinder", "block"})
      for (auto const& table : list(kind))
        if (Value const* carrier = table.find("carried_by"); carrier && carrier->is_text())
          if (quoted(error.what())[0] == std::get<std::string>(carrier->content))
            throw FileError(carrier->where, error.what());
    throw;
  }
}

Machine MachineBuilder::operator()() {
  check_keys();
  read_head();
  read_materials();
  read_bodies();
  assembly_ = std::make_unique<Assembly>(bodies_, order_, machine_.limits.max_spindle_speed);
  for (auto const& [description, table] : read_list<ChannelDescription>("channel"))
    located(*table, [&, &d = description] {
      assembly_->begin_part("channel." + d.name);
      add_channel_flow(*assembly_, d);
    });
  read_parts();
  read_sensors();
  read_displacements();
  read_screws();
  read_displacement_instruments();
  build_network();
  hang_bodies();
  return std::move(machine_);
}

Machine Machine::build(Value const& document) { return MachineBuilder(document)(); }

Machine Machine::read(std::filesystem::path const& path) { return build(read_toml(path)); }

std::filesystem::path machine_file(std::string const& name_or_path) {
  std::filesystem::path const given = name_or_path;
  if (given.extension() == ".toml" || std::filesystem::exists(given)) return given;
  std::filesystem::path const folder = std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "twin" / "machines";
  auto const shipped = folder / (name_or_path + ".toml");
  if (std::filesystem::exists(shipped)) return shipped;
  std::vector<std::string> names;
  for (auto const& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  throw InputError(
      fmt::format("there is no machine '{}'; {}", name_or_path, thermal::did_you_mean(name_or_path, names)));
}

std::vector<TableRecord> describe_machine() {
  std::vector<TableRecord> tables = {
      {"spindle", "the main spindle", list_fields<SpindleDescription>()},
      {"axis", "a linear axis driven by a screw", list_fields<AxisDescription>()},
      {"material", "a solid of this machine", list_fields<MaterialDescription>()},
      {"lump", "a body of one temperature", list_fields<LumpDescription>()},
      {"bar", "a body whose temperature varies along it; faces: surface, start, end", list_fields<BarDescription>()},
      {"hollow_cylinder", "axial × radial cells; faces: outer, inner, start, end",
       list_fields<HollowCylinderDescription>()},
      {"block", "a box of cells; faces: x_min, x_max, y_min, y_max, z_min, z_max", list_fields<BlockDescription>()},
      {"channel", "a fluid that moves along a line; face: surface", list_fields<ChannelDescription>()},
      {"temperature_sensor", "an instrument at a place, or at the mean of several", list_fields<SensorDescription>()},
      {"rotation", "a rotation of the tool relative to the workpiece", list_fields<DisplacementDescription>()},
      {"displacement", "a displacement of the tool relative to the workpiece", list_fields<DisplacementDescription>()},
      {"ball_screw", "error of position along a stroke", list_fields<BallScrewDescription>()},
      {"displacement_probe", "an eddy-current or capacitive probe", list_fields<ProbeDescription>()},
      {"five_probe_nest", "X1, Y1, X2, Y2 and Z about a test bar; one table", list_fields<FiveProbeNest>()},
      {"laser", "laser interferometer along an axis; one table", list_fields<LaserInterferometer>()}};
  for (auto const& entry : effect_catalogue()) tables.push_back({entry.name, entry.meaning, entry.parameters});
  return tables;
}

}  // namespace thermotwin::twin
