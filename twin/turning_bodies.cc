#include "twin/turning_bodies.h"

#include <set>

#include "twin/assembly.h"
#include "twin/file/document.h"

namespace thermotwin::twin {

std::vector<std::string> turning_bodies(Value const& document) {
  constexpr char const* solids[] = {"lump", "bar", "hollow_cylinder", "block"};
  Value copy = document;
  std::set<std::string> turning;
  for (auto const& [kind, key] : {std::pair("bearing", "inner"), std::pair("skf_bearing", "shaft"),
                                  std::pair("ball_nut", "screw"), std::pair("support_bearing", "shaft")})
    for (auto const* table : tables_of(copy, kind))
      for (auto const& place : texts_of(*table, key)) turning.insert(body_of(place));
  for (auto const* film : tables_of(copy, "film"))
    for (auto const& correlation : texts_of(*film, "correlation"))
      if (correlation.starts_with("rotating"))
        for (auto const& place : texts_of(*film, "on")) turning.insert(body_of(place));
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

}  // namespace thermotwin::twin
