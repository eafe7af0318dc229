#include "twin/diagnosis/hypothesis.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "thermal/bounding_box.h"
#include "thermal/error.h"
#include "twin/assembly.h"
#include "twin/diagnosis/estimate_text.h"
#include "twin/file/document.h"
#include "twin/turning_bodies.h"

namespace thermotwin::twin {
namespace {

/// 2 ln of the odds against an effect that says otherwise than the file in so many words.
constexpr double against_statement = 30.0;

constexpr std::string_view of_spindle = "spindle.";

using Shapes = std::vector<std::vector<std::pair<std::string, std::string>>>;

/// Values for keys, and what they act on first.
struct Spot {
  std::vector<std::pair<std::string, std::string>> keys;
  std::string site, body;
  std::string axis = {};  ///< whose feed drive it is part of; empty: of none
};

/// Something that a machine has: one place, or two that belong together.
struct Candidate {
  std::string text, body;
  std::string other = {};  ///< second place
  std::string axis = {};   ///< that moves it
};

/// That moves a part of a feed drive.
std::string axis_of(Value const& table) {
  auto const axis = texts_of(table, "axis");
  return axis.empty() ? "z" : axis[0];
}

/// The names of a machine that a hypothesis may point to, by kind of site.
class Sites {
 public:
  Sites(Value const& document, Machine const& machine);
  [[nodiscard]] std::vector<Spot> at(Trial::Site const& site) const;

 private:
  void add(std::string const& kind, Candidate candidate);
  void add_bodies();
  void add_bearings();
  void add_motors();
  void add_nuts();
  void find_feed_drives();
  void add_films();
  void add_channels();
  void add_pairs();
  void for_tables(std::string_view kind, std::function<void(Value const&)> const& action) const;
  [[nodiscard]] std::string feed_drive(std::string const& body) const;

  Value const& document_;
  std::map<std::string, std::vector<Candidate>> candidates_;  ///< per kind
  std::vector<std::string> solids_;
  std::map<std::string, std::string> feed_drives_;  ///< axis of each body that is part of one
};

Sites::Sites(Value const& document, Machine const& machine) : document_(document) {
  find_feed_drives();
  add_motors();
  add_bodies();
  add_bearings();
  add_nuts();
  add_films();
  add_channels();
  add_pairs();
  for (auto const& sensor : machine.sensors) add("sensor", {sensor.description.name, sensor.description.name});
  auto const add_error = [&](std::string const& kind, std::string const& name) {
    add(kind, {name, name});
    add("displacement or screw", {name, name});
  };
  for (auto const& channel : machine.displacements)
    if (!channel.rotation) add_error("displacement", channel.name);
  for (auto const& screw : machine.screws)
    if (screw.is_linear() && !screw.description.positions.empty()) add_error("screw", screw.description.name);
}

void Sites::add(std::string const& kind, Candidate candidate) {
  auto& known = candidates_[kind];
  if (std::none_of(known.begin(), known.end(),
                   [&](auto const& c) { return c.text == candidate.text && c.other == candidate.other; }))
    known.push_back(std::move(candidate));
}

void Sites::for_tables(std::string_view kind, std::function<void(Value const&)> const& action) const {
  Value const* tables = document_.find(kind);
  if (!tables || !tables->is_list()) return;
  for (auto const& table : std::get<Value::List>(tables->content)) action(table);
}

void Sites::add_bodies() {
  constexpr double longest_single = 0.15;
  auto const turning = turning_bodies(document_);
  auto const add_solid = [&](Value const& table, std::string const& place, std::string const& body) {
    add("solid", {place, body});
    auto const& motors = candidates_["motor"];
    if (std::none_of(motors.begin(), motors.end(), [&](auto const& motor) { return motor.body == body; }))
      add("solid but no motor", {place, body});
    if (std::find(turning.begin(), turning.end(), body) != turning.end()) return;
    add("resting solid", {place, body});
    if (table.find("material") && feed_drive(body).empty()) add("casting", {place, body});
  };
  for (std::string const kind : {"lump", "bar", "hollow_cylinder", "block"})
    for_tables(kind, [&](Value const& table) {
      std::string const name = texts_of(table, "name").at(0);
      solids_.push_back(name);
      if (!table.find("carried_by")) add("base", {name, name});
      auto const lengths = texts_of(table, "length");
      double const length = lengths.empty() ? 0.0 : thermal::parse_value(lengths[0], dimension::length);
      if (kind != "bar" || length <= longest_single) return add_solid(table, name, name);
      for (int third = 0; third < 3; ++third)
        add_solid(table,
                  fmt::format("{}[{:.4g} mm .. {:.4g} mm]", name, 1e3 * length * third / 3.0,
                              1e3 * length * (third + 1) / 3.0),
                  name);
    });
}

void Sites::add_bearings() {
  for_tables("bearing", [&](Value const& table) {
    for (auto const& inner : texts_of(table, "inner"))
      for (auto const& outer : texts_of(table, "outer")) {
        add("shaft", {inner, body_of(inner)});
        add("ring", {outer, body_of(outer)});
        add("bearing", {inner, body_of(outer), outer});
      }
  });
  for_tables("support_bearing", [&](Value const& table) {
    for (auto const& shaft : texts_of(table, "shaft"))
      for (auto const& ring : texts_of(table, "ring")) add("support", {shaft, body_of(ring), ring, axis_of(table)});
  });
}

void Sites::add_motors() {
  for (std::string const kind : {"motor_loss", "copper_loss", "loss_curve", "motor_load", "feed_motor"})
    for_tables(kind, [&](Value const& table) {
      for (auto const* key : {"at", "slots", "stator", "rotor"})
        for (auto const& place : texts_of(table, key)) add("motor", {place, body_of(place)});
    });
}

/// What turns or rubs with the feed of an axis, and not with the spindle.
void Sites::find_feed_drives() {
  for (auto const& [kind, keys] : {std::pair<std::string, std::vector<std::string>>("feed_motor", {"at"}),
                                   {"ball_nut", {"nut", "screw"}},
                                   {"support_bearing", {"shaft", "ring"}}})
    for_tables(kind, [&, &keys = keys](Value const& table) {
      for (auto const& key : keys)
        for (auto const& place : texts_of(table, key)) feed_drives_[body_of(place)] = axis_of(table);
    });
}

std::string Sites::feed_drive(std::string const& body) const {
  auto const drive = feed_drives_.find(body);
  return drive == feed_drives_.end() ? "" : drive->second;
}

void Sites::add_nuts() {
  for_tables("ball_nut", [&](Value const& table) {
    for (auto const& nut : texts_of(table, "nut"))
      for (auto const& screw : texts_of(table, "screw")) add("nut", {nut, body_of(nut), screw, axis_of(table)});
  });
}

void Sites::add_films() {
  for_tables("film", [&](Value const& table) {
    auto const to = texts_of(table, "to");
    auto const correlation = texts_of(table, "correlation");
    bool const turns = !correlation.empty() && correlation[0].starts_with("rotating");
    bool const radiates = correlation.empty() || correlation[0] == "room";
    if (!to.empty() && to[0] != "ambient") return;
    for (auto const& place : texts_of(table, "on")) {
      add(turns ? "shaft" : "room surface", {place, body_of(place)});
      if (!turns && !radiates) add("bare surface", {place, body_of(place)});
    }
  });
}

void Sites::add_channels() {
  for_tables("channel", [&](Value const& table) {
    std::string const name = texts_of(table, "name").at(0);
    add("channel", {name, name});
    add("wetted wall", {name + ".wall", name});
  });
}

void Sites::add_pairs() {
  std::set<std::pair<std::string, std::string>> joined;
  for (std::string const kind : {"joint", "contact_joint", "fit", "radiation"})
    for_tables(kind, [&](Value const& table) {
      for (auto const* key : {"from", "on", "inner"})
        for (auto const* other : {"to", "outer"})
          for (auto const& from : texts_of(table, key))
            for (auto const& to : texts_of(table, other)) {
              joined.insert({body_of(from), body_of(to)});
              joined.insert({body_of(to), body_of(from)});
            }
    });
  for (std::size_t i = 0; i < solids_.size(); ++i)
    for (std::size_t j = i + 1; j < solids_.size(); ++j)
      if (!joined.contains({solids_[i], solids_[j]})) add("pair", {solids_[i], solids_[i], solids_[j]});
}

std::vector<Spot> Sites::at(Trial::Site const& site) const {
  std::vector<Spot> result;
  auto const it = candidates_.find(site.kind);
  if (it == candidates_.end()) return result;
  for (auto const& candidate : it->second) {
    Spot spot{{{site.key, candidate.text}}, candidate.text, candidate.body, feed_drive(candidate.body)};
    if (!site.other.empty()) {
      spot.keys.emplace_back(site.other, candidate.other);
      bool const of_bearing = site.kind == "bearing" || site.kind == "support";
      spot.site = of_bearing ? candidate.other : candidate.text + " to " + candidate.other;
    }
    if (site.kind == "support")
      spot.keys.emplace_back("speed", candidate.axis + ".speed");
    else if (!candidate.axis.empty())
      spot.keys.emplace_back("axis", candidate.axis);
    result.push_back(std::move(spot));
  }
  return result;
}

/// Every combination of the spots of all keys that a trial asks for.
std::vector<Spot> spots_of(Trial const& trial, Sites const& sites) {
  std::vector<Spot> combined = {{{}, "", ""}};
  for (auto const& site : trial.sites) {
    std::vector<Spot> next;
    for (auto const& before : combined)
      for (auto const& spot : sites.at(site)) {
        Spot both = before;
        both.keys.insert(both.keys.end(), spot.keys.begin(), spot.keys.end());
        both.site += (both.site.empty() ? "" : " by ") + spot.site;
        if (both.body.empty()) both.body = spot.body;
        if (both.axis.empty()) both.axis = spot.axis;
        next.push_back(std::move(both));
      }
    combined = std::move(next);
  }
  for (auto& spot : combined)
    if (spot.site.empty()) spot.site = spot.body = "machine";
  return combined;
}

/// Of the cylinder that its rings make, or of a box around its cells [m²].
double outer_surface(thermal::BodyGeometry const& body) {
  double mantle = 0.0, end = 0.0;
  for (auto const& cell : body.cells)
    if (auto const* ring = std::get_if<thermal::RingCell>(&cell)) {
      mantle += 2.0 * std::numbers::pi * ring->outer_radius * ring->height;
      end = std::max(end, std::numbers::pi * ring->outer_radius * ring->outer_radius);
    }
  if (mantle > 0.0) return mantle + 2.0 * end;
  Eigen::Vector3d const a = thermal::bounding_box(body.cells).sizes();
  return 2.0 * (a[0] * a[1] + a[1] * a[2] + a[2] * a[0]);
}

/// Of a trial at a spot of this machine. What follows the spindle follows the axis of which the spot is a feed drive;
/// where no spindle turns, each axis.
Shapes shapes_of(Effect const& effect, Trial const& trial, Spot const& spot, scenarios::MachineLimits const& limits) {
  Shapes const shapes = trial.shapes.empty() ? Shapes{{}} : trial.shapes;
  bool const turns = limits.max_spindle_speed > 0.0;
  if (turns && spot.axis.empty()) return shapes;
  if (trial.needs_spindle) return {};
  auto const has = [&](std::string_view key) {
    return std::any_of(effect.parameters.begin(), effect.parameters.end(),
                       [&](FieldRecord const& field) { return field.key == key; });
  };
  bool const has_speed = has("speed") && has("rated_speed");
  Shapes result;
  for (auto const& shape : shapes) {
    bool follows = has_speed;
    for (auto const& [key, text] : shape) follows = follows || text.starts_with(of_spindle);
    if (!follows) result.push_back(shape);
    if (!follows) continue;
    for (auto const& axis : limits.axes) {
      if (turns && axis.name != spot.axis) continue;
      auto& own = result.emplace_back(shape);
      for (auto& [key, text] : own)
        if (text.starts_with(of_spindle)) text = axis.name + "." + text.substr(of_spindle.size());
      if (!has_speed) continue;
      own.emplace_back("speed", axis.name + ".speed");
      own.emplace_back("rated_speed", thermal::format_quantity(2.0 * std::numbers::pi * axis.rapid_feed / axis.lead,
                                                               dimension::angular_speed));
    }
  }
  return result;
}

/// A table of the file that does the same at the same place.
bool stands_already(Value const& document, Hypothesis const& hypothesis) {
  Value const* tables = document.find(hypothesis.effect->name);
  if (!tables || !tables->is_list()) return false;
  auto const& list = std::get<Value::List>(tables->content);
  return std::any_of(list.begin(), list.end(), [&](Value const& table) {
    return std::all_of(hypothesis.keys.begin(), hypothesis.keys.end(), [&](auto const& key) {
      Value const* value = table.find(key.first);
      return value && value->is_text() && std::get<std::string>(value->content) == key.second;
    });
  });
}

FieldRecord const& field(Effect const& effect, std::string const& key) {
  for (auto const& record : effect.parameters)
    if (record.key == key) return record;
  throw thermal::InputError(fmt::format("the effect '{}' has no parameter '{}'", effect.name, key));
}

/// Another lag of a sensor whose lag the file states.
bool contradicts(Machine const& machine, Hypothesis const& hypothesis) {
  return hypothesis.effect->name == "sensor_lag" &&
         std::any_of(machine.sensors.begin(), machine.sensors.end(), [&](Sensor const& sensor) {
           return sensor.description.name == hypothesis.site && sensor.description.lag.has_value();
         });
}

}  // namespace

thermal::Dimension Hypothesis::dimension() const { return field(*effect, trial->amplitude).dimension; }

bool Hypothesis::is_ordinary(double amplitude, double standard_error) const {
  if (trial->ordinary <= 0.0) return false;
  return std::abs(amplitude) - two_sided_95 * standard_error < trial->ordinary / largest;
}

std::vector<Hypothesis> hypotheses(Value const& document, Machine const& machine,
                                   std::vector<std::string> const& without) {
  Sites const sites(document, machine);
  std::map<std::string, double> surfaces;
  for (auto const& body : machine.geometry) surfaces[body.name] = outer_surface(body);
  std::vector<Hypothesis> result;
  for (auto const& entry : effect_catalogue()) {
    if (std::find(without.begin(), without.end(), entry.name) != without.end()) continue;
    for (auto const& trial : entry.trials)
      for (auto const& spot : spots_of(trial, sites)) {
        for (auto const& shape : shapes_of(entry, trial, spot, machine.limits)) {
          Hypothesis hypothesis{&entry, &trial, spot.site, spot.body, spot.keys};
          hypothesis.keys.insert(hypothesis.keys.end(), shape.begin(), shape.end());
          hypothesis.largest = trial.largest;
          if (hypothesis.dimension() == thermal::dimension::area)
            for (auto const& [key, place] : spot.keys)
              if (auto const body = surfaces.find(body_of(place)); body != surfaces.end() && body->second > 0.0)
                hypothesis.largest = std::min(hypothesis.largest, body->second);
          hypothesis.stands = stands_already(document, hypothesis);
          result.push_back(std::move(hypothesis));
        }
      }
  }
  share_probability(result, machine);
  return result;
}

void share_probability(std::vector<Hypothesis>& hypotheses, Machine const& machine) {
  std::map<Effect const*, int> count;
  for (auto const& hypothesis : hypotheses) ++count[hypothesis.effect];
  for (auto& hypothesis : hypotheses) {
    hypothesis.choice = 2.0 * std::log(count[hypothesis.effect]) + hypothesis.trial->against;
    if (contradicts(machine, hypothesis)) hypothesis.choice += against_statement;
  }
}

std::vector<Hypothesis> with_those_of_some_size(std::vector<Hypothesis> hypotheses) {
  std::size_t const count = hypotheses.size();
  for (std::size_t h = 0; h < count; ++h) {
    if (hypotheses[h].trial->also_about == 0.0) continue;
    hypotheses.push_back(hypotheses[h]);
    hypotheses.back().about = hypotheses[h].trial->also_about;
  }
  return hypotheses;
}

std::vector<std::pair<std::string, std::string>> table_of(Hypothesis const& hypothesis, std::string const& name,
                                                          double amplitude) {
  std::vector<std::pair<std::string, std::string>> keys = {{"name", name}};
  keys.insert(keys.end(), hypothesis.keys.begin(), hypothesis.keys.end());
  auto const add = [&](std::string const& key, double value) {
    keys.emplace_back(key, thermal::format_quantity(value, field(*hypothesis.effect, key).dimension));
  };
  add(hypothesis.trial->amplitude, amplitude);
  for (auto const& [key, factor] : hypothesis.trial->proportional) add(key, factor * amplitude);
  return keys;
}

Value with_hypothesis(Value document, Hypothesis const& hypothesis, std::string const& name, double amplitude) {
  Location const where{document.where.file, 1'000'000, 1};  // after everything that the file has
  append_table(document, hypothesis.effect->name, make_table(where, table_of(hypothesis, name, amplitude)));
  return document;
}

}  // namespace thermotwin::twin
