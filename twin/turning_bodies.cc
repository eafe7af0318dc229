#include "twin/turning_bodies.h"

#include <set>
#include <string_view>
#include <utility>

#include "twin/assembly.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

/// Those that turn with a speed whose name begins so.
std::vector<std::string> bodies_turning_with(std::string_view speed_begins, Value const& document) {
  constexpr char const* solids[] = {"lump", "bar", "hollow_cylinder", "block"};
  Value copy = document;
  std::set<std::string> turning;
  auto const add = [&](Value const& table, std::string const& key, std::string const& usual_speed) {
    auto const speed = texts_of(table, "speed");
    if (!(speed.empty() ? usual_speed : speed[0]).starts_with(speed_begins)) return;
    for (auto const& place : texts_of(table, key)) turning.insert(body_of(place));
  };
  for (auto const* table : tables_of(copy, "bearing")) add(*table, "inner", "spindle.speed");
  for (auto const& [kind, key] :
       {std::pair("skf_bearing", "shaft"), std::pair("ball_nut", "screw"), std::pair("support_bearing", "shaft")})
    for (auto const* table : tables_of(copy, kind)) add(*table, key, "z.speed");
  for (auto const* film : tables_of(copy, "film"))
    for (auto const& correlation : texts_of(*film, "correlation"))
      if (correlation.starts_with("rotating")) add(*film, "on", "spindle.speed");
  for (auto const* kind : solids)
    for (auto const* table : tables_of(copy, kind))
      if (Value const* turns = table->find("turns"); turns && std::get<bool>(turns->content))
        turning.insert(name_in(*table));
  for (std::size_t before = 0; before != turning.size();) {
    before = turning.size();
    for (auto const* kind : solids)
      for (auto const* table : tables_of(copy, kind))
        for (auto const& carrier : texts_of(*table, "carried_by"))
          if (turning.contains(carrier)) turning.insert(name_in(*table));
  }
  return {turning.begin(), turning.end()};
}

}  // namespace

std::vector<std::string> turning_bodies(Value const& document) { return bodies_turning_with("", document); }

std::vector<std::string> bodies_on_spindle(Value const& document) { return bodies_turning_with("spindle.", document); }

}  // namespace thermotwin::twin
