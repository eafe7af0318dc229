#include "twin/machine.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "scenarios/course.h"
#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "twin/bodies.h"
#include "twin/carried_bodies.h"
#include "twin/channel_flow.h"
#include "twin/file/document.h"
#include "twin/file/shipped_file.h"
#include "twin/file/tables.h"
#include "twin/file_kind.h"
#include "twin/instruments/temperature_specimen.h"
#include "twin/machine_tables.h"
#include "twin/stated_axes.h"
#include "twin/uncertain_range.h"
#include "twin/volumetric/volumetric_machine.h"

namespace thermotwin::twin {

using thermal::InputError;

namespace {

/// The document's own keys, without its tables.
HeadDescription head_of(Value const& document) {
  Value own{document.where, Value::Table{}};
  for (auto const& entry : std::get<Value::Table>(document.content))
    if (!entry.value.is_table() && !entry.value.is_list()) std::get<Value::Table>(own.content).push_back(entry);
  HeadDescription head;
  read_fields(own, head);
  return head;
}

/// Every key of the document must be one that the program knows.
void check_keys(Value const& document) {
  auto const& known = machine_keys();
  for (auto const& entry : std::get<Value::Table>(document.content))
    if (std::find(known.begin(), known.end(), entry.key) == known.end()) {
      refuse_other_kind(document, FileKind::machine);
      throw FileError(entry.where,
                      fmt::format("unknown key '{}'; {}", entry.key, thermal::did_you_mean(entry.key, known)));
    }
}

/// Files are called by it; a machine that gives none has none.
void check_machine_name(Value const& document, std::string const& name) {
  Value const* given = document.find("name");
  if (given && (name.empty() || name.find('/') != std::string::npos))
    throw FileError(given->where,
                    fmt::format("'{}' cannot be the name of a machine: files are called by it; a word without '/' is "
                                "due, for example \"v450\"",
                                name));
}

/// Data sets and their CSV files hold each channel by its name.
void check_channel_name(Value const& table, std::string const& name) {
  if (!name.empty() && name != "." && name != "time" && name.find('/') == std::string::npos) return;
  throw FileError(
      where_of(table, "name"),
      fmt::format("'{}' cannot be the name of a channel: no '/', nor the whole '.', 'time' or empty", name));
}

/// Keys of the two places between which a part carries heat.
struct Ends {
  char const *one, *other;
  bool of_two_bodies = true;
};
constexpr Ends ends[] = {{"from", "to", false}, {"inner", "outer"},  {"shaft", "ring"},
                         {"nut", "screw"},      {"rotor", "stator"}, {"first", "second", false}};

/// InputError for a sensor without a place, in air and elsewhere at once, or with shares that do not add up to 1.
void check_places(SensorDescription const& d) {
  if (d.at.empty()) throw InputError(fmt::format("sensor '{}' needs a place: at = \"head\"", d.name));
  if (d.at.size() > 1 && std::find(d.at.begin(), d.at.end(), "ambient") != d.at.end())
    throw InputError(fmt::format("sensor '{}': one in the room, 'ambient', has no other place", d.name));
  if (d.shares.empty()) return;
  if (d.shares.size() != d.at.size())
    throw InputError(
        fmt::format("sensor '{}': 'shares' has {} numbers for {} places", d.name, d.shares.size(), d.at.size()));
  double const sum = std::accumulate(d.shares.begin(), d.shares.end(), 0.0);
  if (std::abs(sum - 1.0) > 1e-6)
    throw InputError(fmt::format("sensor '{}': 'shares' must add up to 1, not to {:g}", d.name, sum));
}

}  // namespace

/// Goes through a machine's document table by table.
class MachineBuilder {
 public:
  explicit MachineBuilder(Value const& document)
      : document_(document),
        head_(head_of(document)),
        tables_(document),
        bodies_(tables_),
        assembly_(bodies_.all(), bodies_.order(), spindle_limit(), head_.upwards()),
        loop_(assembly_, bodies_, document.where.file),
        axes_(tables_) {}
  Machine operator()();

 private:
  [[nodiscard]] double spindle_limit() const;
  void claim_channel(Value const& table, std::string const& name, std::string const& kind);
  void read_head();
  void read_parts();
  void check_ends(Value const& table) const;
  void refuse_common_places(Value const& table, std::string const& key) const;
  void check_fluid(Value const& film) const;
  void check_terms() const;
  void read_sensors();
  void read_displacements();
  void check_moves(DisplacementDescription const& description) const;
  void read_screws();
  void read_reading_terms();
  void read_displacement_instruments();
  void check_volumetric() const;
  void build_network();
  void refuse_names_of_inputs() const;
  void hang_bodies();

  Value const& document_;
  HeadDescription head_;
  Machine machine_;
  Tables tables_;
  Bodies bodies_;
  Assembly assembly_;
  StructuralLoop loop_;
  StatedAxes axes_;
  std::map<std::string, std::string> channels_;  ///< of readings, by name: the kind of table that has it
};

double MachineBuilder::spindle_limit() const {
  SpindleDescription spindle;
  Value const* table = document_.find("spindle");
  if (!table) return 0.0;
  read_fields(*table, spindle);
  if (!(spindle.maximum_speed > 0.0)) {
    Value const& given = *table->find("maximum_speed");
    throw FileError(given.where, fmt::format("'maximum_speed' is {}; it must be positive; a machine without a spindle "
                                             "has no [spindle]",
                                             given.text()));
  }
  return spindle.maximum_speed;
}

/// Sensors and displacements are read under one name each.
void MachineBuilder::claim_channel(Value const& table, std::string const& name, std::string const& kind) {
  check_channel_name(table, name);
  auto const [known, is_new] = channels_.emplace(name, kind);
  if (!is_new)
    throw FileError(table.find("name")->where, fmt::format("the name '{}' is taken by a [[{}]]", name, known->second));
}

void MachineBuilder::read_head() {
  check_machine_name(document_, head_.name);
  machine_.name = head_.name;
  machine_.title = head_.title;
  machine_.up = head_.upwards();
  machine_.limits.max_spindle_speed = assembly_.maximum_spindle_speed();
  machine_.limits.axes = axes_.limits();
  for (auto const& axis : axes_.with_friction_while_moving()) assembly_.take_friction_while_moving(axis);
}

/// What carries heat between two places needs two.
void MachineBuilder::check_ends(Value const& table) const {
  for (auto const& [a, b, of_two_bodies] : ends) {
    auto const one = texts_of(table, a), other = texts_of(table, b);
    if (one.empty() || other.empty()) continue;
    Place const here = assembly_.place(one[0]), there = assembly_.place(other[0]);
    auto const shared = [&](auto const& contact) {
      return std::any_of(there.site.contacts.begin(), there.site.contacts.end(),
                         [&](auto const& c) { return c.node == contact.node; });
    };
    if (here.body == there.body && std::any_of(here.site.contacts.begin(), here.site.contacts.end(), shared))
      throw InputError(fmt::format("'{}' and '{}' share a cell: heat would go from it to itself", one[0], other[0]));
    if (here.body == there.body && of_two_bodies)
      throw FileError(table.find(b)->where, fmt::format("'{}' and '{}' are on one body; '{}' and '{}' are due on two",
                                                        one[0], other[0], a, b));
  }
}

/// What adds up over the places of a list, or is their mean, takes none of them twice.
void MachineBuilder::refuse_common_places(Value const& table, std::string const& key) const {
  Value const* list = table.find(key);
  if (!list || !list->is_list()) return;
  auto const& items = std::get<Value::List>(list->content);
  if (items.size() < 2) return;
  std::vector<Place> places;
  for (std::size_t i = 0; i < items.size(); ++i) {
    auto const& place = places.emplace_back(assembly_.place(std::get<std::string>(items[i].content)));
    for (std::size_t before = 0; before < i; ++before)
      if (have_in_common(places[before], place))
        throw FileError(items[i].where, fmt::format("'{}' and '{}' overlap: what they share would count twice",
                                                    places[before].text, place.text));
  }
}

/// A film leads to a fluid; between solids there are joints.
void MachineBuilder::check_fluid(Value const& film) const {
  Value const* to = film.find("to");
  if (!to || std::get<std::string>(to->content) == "ambient") return;
  auto const& place = std::get<std::string>(to->content);
  std::string const body = assembly_.place(place, {"ambient"}).body->name;
  auto const* solid = bodies_.material_of(body);
  if (!solid) return;
  std::vector<std::string> fluids = {"ambient"};
  for (auto const& name : bodies_.order())
    if (!bodies_.material_of(name)) fluids.push_back(name);
  throw FileError(to->where,
                  fmt::format("'{}' is a solid of {}; a fluid is due, which has a heat_capacity and no material; {}",
                              place, solid->name, thermal::did_you_mean(place, fluids)));
}

/// Parts are added in the order of the file, whatever their kind: a motor finds the torques that stand before it.
void MachineBuilder::read_parts() {
  std::vector<std::pair<Value const*, Effect const*>> tables;
  for (auto const& entry : effect_catalogue())
    for (auto const& table : tables_.of(entry.name)) tables.emplace_back(&table, &entry);
  std::stable_sort(tables.begin(), tables.end(), [](auto const& a, auto const& b) {
    return std::pair(a.first->where.line, a.first->where.column) <
           std::pair(b.first->where.line, b.first->where.column);
  });
  for (auto const& [table, entry] : tables) {
    auto const part = entry->read(*table);
    tables_.claim(*table, entry->name, part->name());
    check_channel_name(*table, entry->name + "." + part->name());
    assembly_.begin_part(entry->name + "." + part->name());
    axes_.check(*table);
    located(*table, [&, &table = *table, entry = entry] {
      check_ends(table);
      refuse_common_places(table, "on");
      if (entry->name == "film") check_fluid(table);
      part->add_to(assembly_);
      axes_.check_nut(table, assembly_);
      check_terms();
    });
  }
}

/// What parts add to displacements and readings must find one of that name.
void MachineBuilder::check_terms() const {
  auto const names_of = [&](std::vector<std::string> const& kinds) {
    std::vector<std::string> names;
    for (auto const& kind : kinds)
      for (auto const& table : tables_.of(kind))
        if (Value const* name = table.is_table() ? table.find("name") : nullptr; name && name->is_text())
          names.push_back(std::get<std::string>(name->content));
    return names;
  };
  auto const check = [](std::string const& kind, std::string const& name, std::vector<std::string> const& names) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError(fmt::format("unknown {} '{}'; {}", kind, name, thermal::did_you_mean(name, names)));
  };
  auto const displacements = names_of({"displacement", "rotation"}), sensors = names_of({"temperature_sensor"});
  auto errors = displacements;
  for (auto const& table : tables_.of("ball_screw")) {
    auto const name = texts_of(table, "name");
    errors.push_back(name.empty() ? BallScrewDescription().name : name[0]);
  }
  for (auto const& term : assembly_.input_terms()) check("displacement", term.displacement, displacements);
  for (auto const& term : assembly_.temperature_terms()) check("displacement", term.displacement, errors);
  for (auto const& term : assembly_.reading_terms())
    check(term.of_displacement ? "displacement" : "sensor", term.channel, term.of_displacement ? errors : sensors);
}

void MachineBuilder::read_sensors() {
  for (auto& [description, table] : tables_.read<SensorDescription>("temperature_sensor"))
    located(*table, [&, &d = description, &table = *table] {
      claim_channel(table, d.name, "temperature_sensor");
      Sensor sensor{d, {}, {0.0, 0.0, 0.0}};
      check_places(d);
      if (d.shares.empty()) refuse_common_places(table, "at");
      for (std::size_t i = 0; i < d.at.size(); ++i) {
        if (d.at[i] == "ambient") continue;
        Place const place = assembly_.place(d.at[i], {"ambient"});
        for (auto const& contact : place.site.contacts)
          sensor.weights.emplace_back(place.first_node + contact.node, contact.share * d.share(i));
        sensor.position += place.centre() * d.share(i);
      }
      check_sensor(d, d.name);
      if (sensor.weights.empty()) sensor.position = machine_.up;  // at 1 m
      machine_.sensors.push_back(std::move(sensor));
    });
}

void MachineBuilder::read_displacements() {
  std::vector<Tabled<DisplacementDescription>> all;
  for (std::string const kind : {"rotation", "displacement"})
    for (auto& tabled : tables_.read<DisplacementDescription>(kind)) {
      located(*tabled.table, [&, &d = tabled.description, &table = *tabled.table] {
        claim_channel(table, d.name, kind);
        loop_.add(d, kind == "rotation");
      });
      all.push_back(std::move(tabled));
    }
  for (auto const& tabled : all)
    located(*tabled.table, [&] {
      loop_.add_beyond(tabled.description);
      check_moves(tabled.description);
    });
  machine_.displacements = loop_.channels();
}

/// InputError for a channel that nothing moves: neither its loop, nor a part.
void MachineBuilder::check_moves(DisplacementDescription const& d) const {
  auto const moves = [&](auto const& terms, auto channel_of) {
    return std::any_of(terms.begin(), terms.end(), [&](auto const& term) { return channel_of(term) == d.name; });
  };
  auto const displaced = [](auto const& term) { return term.displacement; };
  if (!d.segment.empty() || !d.influence.empty() || !d.beyond.empty() || moves(assembly_.input_terms(), displaced) ||
      moves(assembly_.temperature_terms(), displaced) || moves(assembly_.reading_terms(), [](auto const& term) {
        return term.of_displacement ? term.channel : std::string();
      }))
    return;
  throw InputError(
      fmt::format("nothing moves '{}'; give it steps of the loop, for example segment = [{{ of = "
                  "\"column\", length = \"1 m\" }}]",
                  d.name));
}

void MachineBuilder::read_screws() {
  for (auto const& [description, table] : tables_.read<BallScrewDescription>("ball_screw"))
    located(*table, [&, &d = description, &table = *table] {
      check_channel_name(table, d.name);
      axes_.check(table);
      thermal::Body const& body = assembly_.body(d.body);
      if (body.shape != thermal::Body::Shape::axial) throw InputError(fmt::format("'{}' is not a bar", d.body));
      axes_.check_screw(table, d, assembly_);
      thermal::Material const& metal = bodies_.metal_of(d.body);
      using Support = thermal::BallScrew::Support;
      thermal::BallScrew screw;
      screw.support = d.support == "fixed-free"    ? Support::fixed_free
                      : d.support == "fixed-fixed" ? Support::fixed_fixed
                                                   : Support::fixed_supported;
      screw.expansion = d.growth_factor * metal.expansion;
      screw.section_area =
          body.capacities[0] / (metal.density * metal.specific_heat * (body.edges[0][1] - body.edges[0][0]));
      screw.youngs_modulus = d.youngs_modulus;
      screw.stiffness_fixed = d.stiffness_fixed;
      screw.stiffness_far = d.stiffness_far;
      screw.preload_temperature = d.preload_temperature;
      screw.unilateral = d.unilateral;
      screw.released_stiffness = d.released_stiffness;
      screw.edges = body.edges[0];
      Screw built{d, screw, {}, {}, {}, assembly_.first_node(d.body)};
      auto const add = [&](NodeWeights& weights, std::string const& text, double length) {
        if (text.empty()) return;
        Place const place = assembly_.place(text);
        add_growth(weights, place, length * loop_.expansion_at(place, {}));
      };
      add(built.seat_growth, d.seats, screw.length());
      add(built.reference_strain, d.reference, 1.0);
      for (auto const& term : assembly_.temperature_terms()) {
        if (term.displacement != d.name) continue;
        add_growth(built.zero_shift, term.place, term.coefficient);
        add_growth(built.reference_strain, term.place, -term.strain);
      }
      machine_.screws.push_back(std::move(built));
    });
  machine_.linear_channels = machine_.displacements;
  for (auto const& screw : machine_.screws)
    for (double const x : screw.description.positions)
      if (screw.is_linear())
        machine_.linear_channels.push_back({screw.channel_at(x), "", false, screw.weights_at(x), {}});
}

/// Of a ball screw, one for each of its positions.
void MachineBuilder::read_reading_terms() {
  for (auto const& term : assembly_.reading_terms()) {
    auto const screw = std::find_if(machine_.screws.begin(), machine_.screws.end(), [&](auto const& s) {
      return term.of_displacement && s.description.name == term.channel;
    });
    if (screw == machine_.screws.end())
      machine_.reading_terms.push_back(term);
    else
      for (double const x : screw->description.positions) {
        auto& own = machine_.reading_terms.emplace_back(term);
        own.channel = screw->channel_at(x);
        own.per_air += term.air_strain * x;
      }
  }
}

void MachineBuilder::read_displacement_instruments() {
  std::vector<std::string> known;
  for (auto const& channel : machine_.displacements)
    if (!channel.rotation) known.push_back(channel.name);
  for (auto& [probe, table] : tables_.read<ProbeDescription>("displacement_probe"))
    located(*table, [&, &p = probe] {
      if (std::find(known.begin(), known.end(), p.of) == known.end())
        throw InputError(fmt::format("unknown displacement '{}'; {}", p.of, thermal::did_you_mean(p.of, known)));
      check_probe(p, p.name);
      machine_.probes.push_back(p);
    });
  if (Value const* table = document_.find("five_probe_nest")) {
    read_fields(*table, machine_.nest.emplace());
    located(*table, [&] { check_nest(*machine_.nest); });
    for (auto const& probe : probe_names)
      if (std::find(known.begin(), known.end(), probe) != known.end())
        throw FileError(table->where,
                        fmt::format("the nest has a probe '{}': no displacement may have its name", probe));
  }
  if (Value const* table = document_.find("laser")) read_fields(*table, machine_.laser);
}

/// The volumetric errors are no part of the network; what they refer to must be there.
void MachineBuilder::check_volumetric() const {
  Value const* table = document_.find("volumetric");
  if (!table) return;
  std::vector<std::string> screws, channels;
  for (auto const& screw : machine_.screws) screws.push_back(screw.description.name);
  for (auto const& channel : machine_.displacements) channels.push_back(channel.name);
  auto const check = [](std::string const& kind, std::string const& name, std::vector<std::string> const& known) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(fmt::format("unknown {} '{}'; {}", kind, name, thermal::did_you_mean(name, known)));
  };
  auto const description = read_volumetric(document_).description;
  located(*table, [&] {
    for (auto const& axis : description.axis)
      if (!axis.screw.empty()) check("ball_screw", axis.screw, screws);
    for (auto const& growth : description.growth) check("displacement", growth.channel, channels);
  });
}

void MachineBuilder::build_network() {
  try {
    machine_.network_ = std::make_shared<thermal::Network const>(assembly_.network().build());
  } catch (InputError const& error) {
    auto const words = quoted(error.what());
    for (auto const& kind : {"lump", "bar", "hollow_cylinder", "block", "channel"})
      for (auto const& table : tables_.of(kind))
        if (Value const* name = table.find("name"); name && !words.empty() && name->is_text()) {
          auto const& text = std::get<std::string>(name->content);
          if (words[0] == text || words[0].starts_with(text + "[")) throw FileError(name->where, error.what());
        }
    throw FileError(document_.where, error.what());
  }
  for (auto const& name : bodies_.order())
    machine_.geometry.push_back(thermal::geometry_of(bodies_.all().at(name), assembly_.first_node(name)));
}

/// A table of numbers tells inputs and readings apart by their names.
void MachineBuilder::refuse_names_of_inputs() const {
  auto const& network = *machine_.network_;
  std::set<std::string> inputs(network.channel_names().begin(),
                               network.channel_names().begin() + network.external_channels());
  for (auto const& channel : scenarios::own_channels(machine_.limits)) inputs.insert(channel.name);
  for (auto const& [name, kind] : channels_) {
    if (!inputs.contains(name)) continue;
    for (auto const& table : tables_.of(kind))
      if (name_in(table) == name)
        throw FileError(table.find("name")->where,
                        fmt::format("'{}' is the name of an input channel; a [[{}]] needs another", name, kind));
  }
}

void MachineBuilder::hang_bodies() {
  std::vector<HungBody> hung;
  for (auto const& name : bodies_.order())
    if (auto const* carried = bodies_.carried(name)) {
      auto const* metal = bodies_.material_of(name);
      hung.push_back(
          {name, *carried, &bodies_.all().at(name), assembly_.first_node(name), metal ? metal->expansion : 0.0});
    }
  try {
    machine_.growing = carried_bodies(hung, machine_.up);
  } catch (InputError const& error) {
    for (auto const& kind : {"lump", "bar", "hollow_cylinder", "block"})
      for (auto const& table : tables_.of(kind))
        if (Value const* carrier = table.find("carried_by"); carrier && carrier->is_text())
          if (quoted(error.what())[0] == std::get<std::string>(carrier->content))
            throw FileError(carrier->where, error.what());
    throw;
  }
}

Machine MachineBuilder::operator()() {
  read_head();
  for (auto const& [description, table] : bodies_.channels())
    located(*table, [&, &d = description, &table = *table] {
      check_channel_name(table, "channel." + d.name);
      assembly_.begin_part("channel." + d.name);
      add_channel_flow(assembly_, d);
    });
  read_parts();
  read_sensors();
  read_displacements();
  read_screws();
  machine_.limits.axes = axes_.limits_on_screws(machine_.screws, assembly_);
  read_displacement_instruments();
  check_volumetric();
  static_cast<void>(tables_.read<UncertainRange>("uncertain"));  // the keys; what they say is for ranged_numbers()
  read_reading_terms();
  assembly_.add_air_terms();
  build_network();
  machine_.limits.shares = machine_.network_->shares();
  axes_.check_inputs(*machine_.network_);
  refuse_names_of_inputs();
  hang_bodies();
  return std::move(machine_);
}

Machine Machine::build(Value const& document) {
  check_keys(document);
  return MachineBuilder(document)();
}

Machine Machine::read(std::filesystem::path const& path) { return build(read_toml(path)); }

std::filesystem::path machine_file(std::string const& name_or_path) {
  return shipped_file("machine", "twin/machines", name_or_path);
}

}  // namespace thermotwin::twin
