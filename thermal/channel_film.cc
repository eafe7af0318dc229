#include "thermal/channel_film.h"

#include <algorithm>
#include <cmath>

#include "thermal/nearest_name.h"

namespace thermotwin::thermal {

Fluid const& fluid_of_number(double number) {
  static std::vector<Fluid> const all = [] {
    std::vector<Fluid> fluids;
    for (auto const& name : fluid_names()) fluids.push_back(fluid(name));
    return fluids;
  }();
  return all.at(std::size_t(std::lround(number)));
}

double number_of_fluid(std::string_view name) {
  (void)fluid(name);  // the rejection of an unknown one
  auto const& names = fluid_names();
  auto const same = [&](std::string const& known) { return edit_distance(known, name) == 0; };
  return double(std::find_if(names.begin(), names.end(), same) - names.begin());
}

}  // namespace thermotwin::thermal
