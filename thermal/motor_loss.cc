#include "thermal/motor_loss.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

bool rises(std::vector<double> const& grid) {
  return grid.size() >= 2 && std::adjacent_find(grid.begin(), grid.end(), std::greater_equal<>()) == grid.end();
}

}  // namespace

EfficiencyMap::EfficiencyMap(std::vector<double> speeds, std::vector<double> torques, std::vector<double> efficiency)
    : speeds_(std::move(speeds)), torques_(std::move(torques)), efficiency_(std::move(efficiency)) {
  if (!rises(speeds_) || !rises(torques_))
    throw InputError("an efficiency map needs at least two speeds and two torques, each rising");
  if (efficiency_.size() != speeds_.size() * torques_.size())
    throw InputError("an efficiency map of " + std::to_string(speeds_.size()) + " speeds and " +
                     std::to_string(torques_.size()) + " torques has " + std::to_string(efficiency_.size()) +
                     " values");
  for (double const eta : efficiency_)
    if (!(eta > 0.0 && eta <= 1.0))
      throw InputError("efficiency " + std::to_string(eta) + " is not above 0 and at most 1");
}

std::size_t EfficiencyMap::cell(std::vector<double> const& grid, double x) {
  return static_cast<std::size_t>(std::upper_bound(grid.begin() + 1, grid.end() - 1, x) - grid.begin()) - 1;
}

}  // namespace thermotwin::thermal
