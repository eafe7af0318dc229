#include "twin/machine_remarks.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <span>

#include "scenarios/course.h"
#include "thermal/bounding_box.h"
#include "thermal/nearest_name.h"
#include "twin/bodies.h"
#include "twin/file/document.h"
#include "twin/file/tables.h"
#include "twin/implausible_values.h"
#include "twin/machine_tables.h"
#include "twin/turning_bodies.h"
#include "twin/uncertain_range.h"

namespace thermotwin::twin {
namespace {

/// Sensors from which a signal hardly gets out.
void doubt_turning_sensors(Value const& document, std::vector<std::string>& found) {
  auto const turning = bodies_on_spindle(document);
  Tables const tables(document);
  for (auto const& sensor : tables.of("temperature_sensor"))
    for (auto const* place : items_of(*sensor.find("at"))) {
      auto const body = body_of(std::get<std::string>(place->content));
      if (std::find(turning.begin(), turning.end(), body) != turning.end())
        found.push_back(fmt::format("{}: sensor '{}' sits on '{}', which turns; its signal needs a way out",
                                    place->where.text(), name_in(sensor), body));
    }
}

/// Masses that do not fit the box that is stated with them. Boxes are drawn for the picture, and castings are hollow.
void doubt_masses(Value const& document, std::vector<std::string>& found) {
  constexpr double least_solid = 0.002, most_solid = 2.0;
  Tables tables(document);
  Bodies const bodies(tables);
  for (auto const& lump : tables.of("lump")) {
    auto const name = name_in(lump);
    auto const mass = number_in(lump, "mass", dimension::mass);
    auto const* material = bodies.material_of(name);
    if (!mass || !material || !lump.find("size")) continue;
    double const full = material->density * thermal::bounding_box(bodies.all().at(name).cells).volume();
    if (*mass < least_solid * full || *mass > most_solid * full)
      found.push_back(fmt::format("{}: 'mass' is {}; full of {}, the box of its 'size' has {:.3g} kg",
                                  lump.find("mass")->where.text(), lump.find("mass")->text(), material->name, full));
  }
}

/// A nut and its axis tell the same screw's lead: the axis' turns it, the nut's takes part in its friction.
void doubt_leads(Value const& document, std::vector<std::string>& found) {
  Tables const tables(document);
  for (auto const& axis : tables.of("axis"))
    for (auto const& nut : tables.of("ball_nut")) {
      auto const driven_by = texts_of(nut, "axis");
      if (name_in(axis) != (driven_by.empty() ? "z" : driven_by[0])) continue;
      double const of_axis = number_in(axis, "lead", dimension::length).value();
      double const of_nut = number_in(nut, "lead", dimension::length).value();
      if (std::abs(of_nut - of_axis) > 1e-6 * of_axis)
        found.push_back(fmt::format("{}: 'lead' is {}; axis '{}', whose screw it runs on, has a lead of {}",
                                    nut.find("lead")->where.text(), nut.find("lead")->text(), name_in(axis),
                                    axis.find("lead")->text()));
    }
}

/// Sensitivities may divide what is counted; a file may not.
void check_counts(Value const& machine) {
  for (auto const& [kind, where, value] : std::get<Value::Table>(machine.content))
    for (auto const* table : items_of(value)) {
      Value const* count = table->is_table() ? table->find("count") : nullptr;
      if (!count) continue;
      auto const number = number_in(*table, "count", dimension::dimensionless);
      if (number && *number != std::round(*number))
        throw FileError(count->where, fmt::format("'count' is {}; a whole number is due", count->text()));
    }
}

/// All tables of a machine file, as the fields of one.
std::vector<FieldRecord> machine_fields() {
  std::vector<FieldRecord> fields;
  for (auto const& table : describe_machine())
    fields.push_back({table.name, "table", "", "", "", table.fields, {}, {}});
  return fields;
}

/// An input that an experiment would have to give, and that nearly has the name of one that all have.
void find_misspelt_inputs(Value const& document, Machine const& machine, std::vector<std::string>& found) {
  std::vector<std::string> own;
  for (auto const& channel : scenarios::own_channels(machine.limits)) own.push_back(channel.name);
  auto const& names = machine.network().channel_names();
  for (auto const& name : std::span(names).first(std::size_t(machine.network().external_channels()))) {
    bool const is_own = std::find(own.begin(), own.end(), name) != own.end();
    if (auto const meant = is_own ? "" : thermal::meant_name(name, own); !meant.empty())
      found.push_back(
          fmt::format("{}: input '{}': did you mean '{}'?", place_of(document, "'" + name + "'").text(), name, meant));
  }
}

}  // namespace

std::vector<std::string> machine_remarks(Value const& document, Machine const& machine) {
  check_counts(document);
  static_cast<void>(ranged_numbers(document));
  auto found = implausible_values(document, machine_fields());
  find_misspelt_inputs(document, machine, found);
  doubt_turning_sensors(document, found);
  doubt_masses(document, found);
  doubt_leads(document, found);
  return found;
}

}  // namespace thermotwin::twin
