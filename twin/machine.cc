#include "twin/machine.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <utility>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "twin/bodies.h"
#include "twin/carried_bodies.h"
#include "twin/channel_flow.h"
#include "twin/channel_names.h"
#include "twin/file/document.h"
#include "twin/file/shipped_file.h"
#include "twin/file/tables.h"
#include "twin/file_kind.h"
#include "twin/instruments/temperature_specimen.h"
#include "twin/machine_tables.h"
#include "twin/stated_axes.h"
#include "twin/stated_places.h"
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
  void read_head();
  void read_parts();
  void check_terms() const;
  void read_sensors();
  void read_displacements();
  void check_moves(DisplacementDescription const& description) const;
  void read_screws();
  void read_reading_terms();
  void read_displacement_instruments();
  void check_volumetric() const;
  void build_network();
  void hang_bodies();

  Value const& document_;
  HeadDescription head_;
  Machine machine_;
  Tables tables_;
  Bodies bodies_;
  Assembly assembly_;
  StructuralLoop loop_;
  StatedAxes axes_;
  ChannelNames channels_;  ///< of readings
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

void MachineBuilder::read_head() {
  check_machine_name(document_, head_.name);
  machine_.name = head_.name;
  machine_.title = head_.title;
  machine_.up = head_.upwards();
  machine_.limits.max_spindle_speed = assembly_.maximum_spindle_speed();
  machine_.limits.axes = axes_.limits();
  for (auto const& axis : axes_.with_friction_while_moving()) assembly_.take_friction_while_moving(axis);
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
      check_ends(table, assembly_);
      refuse_common_places(table, "on", assembly_);
      if (entry->name == "film") check_fluid(table, assembly_, bodies_);
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
      channels_.claim(table, d.name, "temperature_sensor");
      Sensor sensor{d, {}, {0.0, 0.0, 0.0}};
      check_places(d);
      if (d.shares.empty()) refuse_common_places(table, "at", assembly_);
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
        channels_.claim(table, d.name, kind);
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
      machine_.screws.push_back(screw_of(d, assembly_, bodies_, loop_));
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
  channels_.refuse_inputs(machine_.network(), machine_.limits);
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
