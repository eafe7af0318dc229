#include "twin/diagnosis/regimes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

#include "thermal/units.h"
#include "twin/diagnosis/linearised_run.h"

namespace thermotwin::twin {
namespace {

constexpr double distinct_speed = 10.0;  // rpm
constexpr std::size_t most_speeds = 8;

constexpr double least_slope = 0.5 / 3600.0;  // [K/s]
constexpr int windows = 12;

std::vector<double> speeds_of(MeasuredRun const& run, Eigen::VectorXd const& time) {
  Eigen::VectorXd const speed = run.input("spindle.speed", time);
  std::vector<double> speeds(std::size_t(time.size()), 0.0);
  for (Eigen::Index i = 0; i < speed.size(); ++i)
    speeds[std::size_t(i)] = distinct_speed * std::round(thermal::to_unit(speed[i], "rpm") / distinct_speed);
  return speeds;
}

/// Mean slope of the sensors about a row [K/s].
double slope_at(BinnedRun const& run, Eigen::Index row) {
  auto const from = std::max<Eigen::Index>(0, row - 1), to = std::min(run.time.size() - 1, row + 1);
  double sum = 0.0;
  int count = 0;
  for (std::size_t c = 0; c < run.run->channels.size(); ++c) {
    double const rise = run.values(to, Eigen::Index(c)) - run.values(from, Eigen::Index(c));
    if (run.run->channels[c].displacement || std::isnan(rise)) continue;
    sum += rise / (run.time[to] - run.time[from]);
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

}  // namespace

Regimes speed_regimes(MeasuredRun const& run, Eigen::VectorXd const& time) {
  auto speeds = speeds_of(run, time);
  double const fastest = *std::max_element(speeds.begin(), speeds.end());
  std::map<double, std::size_t> order;
  for (double const speed : speeds) order[speed] = 0;
  bool const quarters = order.size() > most_speeds;
  if (quarters) {
    order.clear();
    for (double& speed : speeds) {
      speed = fastest / 4.0 * std::ceil(4.0 * speed / fastest);
      order[speed] = 0;
    }
  }
  Regimes regimes;
  for (auto& [speed, index] : order) {
    index = regimes.names.size();
    regimes.names.push_back(speed == 0.0 ? "idle"
                            : quarters   ? fmt::format("to {:.0f} rpm", speed)
                                         : fmt::format("{:.0f} rpm", speed));
  }
  for (double const speed : speeds) regimes.of_row.push_back(order.at(speed));
  return regimes;
}

Regimes thermal_regimes(BinnedRun const& run) {
  Regimes regimes{{"warm-up", "steady", "cool-down", "idle"}, {}};
  for (Eigen::Index row = 0; row < run.time.size(); ++row) {
    bool const moving = is_moving(*run.run->course, run.time[row]);
    double const slope = slope_at(run, row);
    regimes.of_row.push_back(slope < -least_slope ? 2 : !moving ? 3 : slope > least_slope ? 0 : 1);
  }
  return regimes;
}

Regimes time_windows(BinnedRun const& run) {
  double const begin = run.run->time[0], end = run.run->time[run.run->time.size() - 1],
               length = (end - begin) / windows;
  Regimes regimes;
  for (int w = 0; w < windows; ++w)
    regimes.names.push_back(
        fmt::format("{:.3g}-{:.3g} h", (begin + w * length) / 3600.0, (begin + (w + 1) * length) / 3600.0));
  for (double const t : run.time)
    regimes.of_row.push_back(std::size_t(std::clamp(int((t - begin) / length), 0, windows - 1)));
  return regimes;
}

}  // namespace thermotwin::twin
