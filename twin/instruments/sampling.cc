#include "twin/instruments/sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "twin/instruments/random_stream.h"

namespace thermotwin::twin {
namespace {

constexpr double closest_looks = 0.5;                       ///< apart [s]; what happens between such two happens at one
constexpr double shortest_look = 5.0, longest_look = 60.0;  ///< [s]
constexpr double look_growth = 0.4;                         ///< of the time since something happened

/// First time after t at which an input jumps or bends.
double next_event(thermal::Course const& course, double t) {
  return std::min(course.next_jump(t), course.next_bend(t));
}

}  // namespace

std::vector<double> looks(std::span<double const> sample_times, thermal::Course const& course) {
  std::vector<double> times{sample_times.front()};
  double since = times.front(), event = next_event(course, since);
  for (double const sample : sample_times.subspan(1)) {
    for (;;) {
      double const from = times.back();
      for (; event < from + closest_looks; event = next_event(course, event)) since = event;
      double const to = std::min(from + std::clamp(look_growth * (from - since), shortest_look, longest_look), event);
      if (to > sample - closest_looks) break;
      times.push_back(to);
    }
    times.push_back(sample);
  }
  return times;
}

std::vector<bool> due(Eigen::VectorXd const& sample_times, double interval) {
  std::vector<bool> result;
  double passed = -1.0;
  for (double const t : sample_times) {
    double const instant = interval > 0.0 ? std::floor((t - sample_times[0]) / interval + 1e-9) : passed + 1.0;
    result.push_back(instant > passed);
    passed = instant;
  }
  return result;
}

void drop_out(Eigen::VectorXd& values, Eigen::VectorXd const& sample_times, InstrumentChannel const& channel,
              double dropout, double dead_from) {
  RandomStream chance(channel.seed, channel.name + "/dropout");
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    bool const lost = chance.uniform() < dropout;
    if (lost || sample_times[k] >= dead_from) values[k] = std::numeric_limits<double>::quiet_NaN();
  }
}

double quantised(double x, double resolution) { return resolution > 0.0 ? resolution * std::round(x / resolution) : x; }

}  // namespace thermotwin::twin
