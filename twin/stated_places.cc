#include "twin/stated_places.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <variant>
#include <vector>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

/// Keys of the two places between which a part carries heat.
struct Ends {
  char const *one, *other;
  bool of_two_bodies = true;
};
constexpr Ends ends[] = {{"from", "to", false}, {"inner", "outer"},  {"shaft", "ring"},
                         {"nut", "screw"},      {"rotor", "stator"}, {"first", "second", false}};

}  // namespace

void check_ends(Value const& table, Assembly const& assembly) {
  for (auto const& [a, b, of_two_bodies] : ends) {
    auto const one = texts_of(table, a), other = texts_of(table, b);
    if (one.empty() || other.empty()) continue;
    Place const here = assembly.place(one[0]), there = assembly.place(other[0]);
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

void refuse_common_places(Value const& table, std::string const& key, Assembly const& assembly) {
  Value const* list = table.find(key);
  if (!list || !list->is_list()) return;
  auto const& items = std::get<Value::List>(list->content);
  if (items.size() < 2) return;
  std::vector<Place> places;
  for (std::size_t i = 0; i < items.size(); ++i) {
    auto const& place = places.emplace_back(assembly.place(std::get<std::string>(items[i].content)));
    for (std::size_t before = 0; before < i; ++before)
      if (have_in_common(places[before], place))
        throw FileError(items[i].where, fmt::format("'{}' and '{}' overlap: what they share would count twice",
                                                    places[before].text, place.text));
  }
}

void check_fluid(Value const& film, Assembly const& assembly, Bodies const& bodies) {
  Value const* to = film.find("to");
  if (!to || std::get<std::string>(to->content) == "ambient") return;
  auto const& place = std::get<std::string>(to->content);
  std::string const body = assembly.place(place, {"ambient"}).body->name;
  auto const* solid = bodies.material_of(body);
  if (!solid) return;
  std::vector<std::string> fluids = {"ambient"};
  for (auto const& name : bodies.order())
    if (!bodies.material_of(name)) fluids.push_back(name);
  throw FileError(to->where,
                  fmt::format("'{}' is a solid of {}; a fluid is due, which has a heat_capacity and no material; {}",
                              place, solid->name, thermal::did_you_mean(place, fluids)));
}

}  // namespace thermotwin::twin
