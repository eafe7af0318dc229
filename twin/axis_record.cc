#include "twin/axis_record.h"

#include <algorithm>
#include <fmt/format.h>

#include "thermal/error.h"

namespace thermotwin::twin {

output::Positioning const& laser_of(std::vector<output::Positioning> const& lasers, std::string const& axis,
                                    std::string const& run) {
  auto const it = std::find_if(lasers.begin(), lasers.end(), [&](auto const& laser) { return laser.axis == axis; });
  if (it == lasers.end()) throw thermal::InputError(fmt::format("{} has no laser measurement of axis '{}'", run, axis));
  return *it;
}

models::AxisRecord axis_record(models::Batch const& readings, output::Positioning const& laser, double from,
                               double to) {
  auto const& time = readings.time;
  std::vector<Eigen::Index> rows, targets;
  for (Eigen::Index i = 0, row = 0; i < laser.time_s.size(); ++i) {
    while (row + 1 < time.size() && time[row + 1] <= laser.time_s[i] + 1e-6) ++row;
    rows.push_back(row);
  }
  for (Eigen::Index q = 0; q < laser.position_mm.size(); ++q)
    if (1e-3 * laser.position_mm[q] >= from - 1e-9 && 1e-3 * laser.position_mm[q] <= to + 1e-9) targets.push_back(q);
  Eigen::MatrixXd const mean = 0.5 * (laser.forward_um + laser.backward_um);
  return {readings.name,
          laser.time_s,
          readings.sensors,
          readings.components,
          readings.temperature_rise(rows, Eigen::all),
          1e-3 * laser.position_mm(targets),
          mean(Eigen::all, targets)};
}

}  // namespace thermotwin::twin
