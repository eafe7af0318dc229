#include "twin/volumetric/volumetric_machine.h"

#include <algorithm>
#include <fmt/format.h>

#include "thermal/error.h"
#include "twin/file/document.h"
#include "twin/file/tables.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

/// Entry i of a list of tables in the file.
Value const& entry(Value const& table, std::string_view list, std::size_t i) {
  return std::get<Value::List>(table.find(list)->content)[i];
}

Workspace workspace_of(VolumetricDescription const& description, Value const& table) {
  Workspace workspace;
  std::string missing = "xyz";
  for (std::size_t i = 0; i < description.axis.size(); ++i)
    located(entry(table, "axis", i), [&] {
      auto const& axis = description.axis[i];
      auto const at = axis.name.size() == 1 ? missing.find(axis.name) : std::string::npos;
      if (at == std::string::npos)
        throw InputError(fmt::format("the axis '{}' is not due; x, y and z are, each once", axis.name));
      if (axis.to <= axis.from)
        throw InputError(
            fmt::format("axis '{}' goes from {} to {} m; `to` must be above `from`", axis.name, axis.from, axis.to));
      if (!axis.screw.empty() && !(axis.screw_from && axis.screw_to && *axis.screw_from != *axis.screw_to))
        throw InputError(fmt::format("axis '{}' needs screw_from and screw_to, the ends of the nut's way on '{}'",
                                     axis.name, axis.screw));
      missing.erase(at, 1);
      int const number = axis.name[0] - 'x';
      workspace.from[number] = axis.from;
      workspace.to[number] = axis.to;
    });
  if (!missing.empty())
    throw FileError(table.where, fmt::format("the volume needs an axis '{}'; write for example axis = [{{ name = "
                                             "\"{}\", from = \"0 mm\", to = \"200 mm\" }}, …]",
                                             missing[0], missing[0]));
  return workspace;
}

void check_table(std::vector<double> const& positions, std::vector<double> const& values, std::string const& name) {
  if (positions.size() != values.size())
    throw InputError(
        fmt::format("'{}' has {} positions and {} values; as many are due", name, positions.size(), values.size()));
  if (std::adjacent_find(positions.begin(), positions.end(), std::greater_equal<>()) != positions.end())
    throw InputError(fmt::format("the positions of '{}' must ascend", name));
}

Eigen::VectorXd as_vector(std::vector<double> const& values) {
  return Eigen::Map<Eigen::VectorXd const>(values.data(), Eigen::Index(values.size()));
}

template <thermal::Dimension of>
ErrorCourse course_of(ElementDescription<of> const& element, ErrorCourse course) {
  course.polynomial = element.polynomial;
  for (auto const& h : element.harmonic) course.harmonics.push_back({h.amplitude, h.period, h.phase});
  check_table(element.positions, element.values, element.name);
  if (!element.values.empty()) course.tables.push_back({as_vector(element.positions), as_vector(element.values)});
  return course;
}

/// Puts given elements in the place of drawn or absent ones.
template <thermal::Dimension of>
void set_elements(std::vector<ElementDescription<of>> const& elements, Value const& table, std::string_view list,
                  GeometricErrors const& none, GeometricErrors& errors) {
  bool const angular = list == "rotation";
  std::vector<std::string> seen;
  for (std::size_t i = 0; i < elements.size(); ++i)
    located(entry(table, list, i), [&] {
      auto const& name = elements[i].name;
      auto const place = element_place(name);
      if ((place.component >= 3) != angular)
        throw InputError(fmt::format("'{}' is {}; it belongs to `{}`", name, angular ? "a length" : "an angle",
                                     angular ? "translation" : "rotation"));
      if (std::find(seen.begin(), seen.end(), name) != seen.end())
        throw InputError(fmt::format("the element '{}' is given twice", name));
      seen.push_back(name);
      auto const axis = std::size_t(place.axis), component = std::size_t(place.component);
      errors.courses[axis][component] = course_of(elements[i], none.courses[axis][component]);
    });
}

constexpr std::array<char const*, 3> squareness_names = {"squareness_xy", "squareness_xz", "squareness_yz"};

bool is_squareness(std::string const& name) {
  return std::find(squareness_names.begin(), squareness_names.end(), name) != squareness_names.end();
}

GeometricErrors errors_of(VolumetricDescription const& description, Workspace const& workspace, Value const& table) {
  GeometricErrors const none = no_errors(workspace);
  GeometricErrors errors = none;
  if (auto const& d = description.drawn)
    errors = draw_errors(workspace, {d->linear, d->straightness, d->angular, d->squareness}, d->seed);
  set_elements(description.translation, table, "translation", none, errors);
  set_elements(description.rotation, table, "rotation", none, errors);
  std::array const given = {description.squareness_xy, description.squareness_xz, description.squareness_yz};
  for (int i = 0; i < 3; ++i)
    if (given[std::size_t(i)]) errors.squareness[i] = *given[std::size_t(i)];
  return errors;
}

/// Whether a table of that kind, [[displacement]] or [[rotation]], has the name.
bool has_channel(Value const& document, std::string const& kind, std::string const& name) {
  auto const& tables = Tables(document).of(kind);
  return std::any_of(tables.begin(), tables.end(), [&](Value const& table) { return name_in(table) == name; });
}

/// Of a channel that the machine's file makes.
void check_unit(Value const& document, GrowthDescription const& growth, bool angle) {
  if (has_channel(document, angle ? "displacement" : "rotation", growth.channel))
    throw InputError(fmt::format("'{}' is {}; {} is due for '{}', which it moves", growth.channel,
                                 angle ? "a length" : "an angle", angle ? "an angle" : "a length", growth.element));
}

void check_growth(VolumetricDescription const& description, Value const& table, Value const& document) {
  for (std::size_t i = 0; i < description.growth.size(); ++i)
    located(entry(table, "growth", i), [&] {
      auto const& growth = description.growth[i];
      check_unit(document, growth, is_squareness(growth.element) || element_place(growth.element).component >= 3);
    });
}

}  // namespace

VolumetricModel VolumetricMachine::model(GeometricErrors errors) const {
  return {chain_of(description.chain), convention_of(description.convention), description.tool_offset,
          std::move(errors)};
}

VolumetricMachine read_volumetric(Value const& document) {
  Value const* table = document.find("volumetric");
  if (!table)
    throw FileError(document.where,
                    "the machine has no table [volumetric]; `thermotwin describe machine` shows what it holds");
  VolumetricMachine machine;
  read_fields(*table, machine.description);
  if (Value const* laser = document.find("laser")) read_fields(*laser, machine.laser);
  machine.workspace = workspace_of(machine.description, *table);
  machine.cold = errors_of(machine.description, machine.workspace, *table);
  check_growth(machine.description, *table, document);
  return machine;
}

}  // namespace thermotwin::twin
