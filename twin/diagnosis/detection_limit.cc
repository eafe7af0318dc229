#include "twin/diagnosis/detection_limit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "twin/diagnosis/gap.h"

namespace thermotwin::twin {
namespace {

/// Highest less lowest value in rows where the channel was read.
double swing_of(Eigen::VectorXd const& response, Eigen::VectorXd const& read) {
  double least = INFINITY, most = -INFINITY;
  for (Eigen::Index i = 0; i < read.size(); ++i) {
    if (std::isnan(read[i])) continue;
    least = std::min(least, response[i]);
    most = std::max(most, response[i]);
  }
  return std::max(0.0, most - least);
}

/// What one signature moves most, per unit of its amplitude: unit, channel and swing of a limit.
void find_most_moved(DetectionLimit& limit, Estimation const& estimation, Machine const& machine,
                     std::string const& unit, Eigen::VectorXd const& signature) {
  limit.unit = unit;
  for (std::size_t r = 0; r < estimation.data().size(); ++r) {
    auto const& run = estimation.data()[r];
    for (std::size_t c = 0; c < run.run->channels.size(); ++c) {
      auto const& channel = run.run->channels[c];
      if (unit_of(channel, machine) != unit) continue;
      auto const rows = run.values.rows();
      double const swing = swing_of(signature.segment(estimation.first_row(r) + Eigen::Index(c) * rows, rows),
                                    run.values.col(Eigen::Index(c)));
      if (swing <= limit.swing) continue;
      limit.swing = swing;
      limit.channel = channel.name;
    }
  }
}

}  // namespace

std::vector<DetectionLimit> detection_limits(Estimation const& estimation, Fit const& fit,
                                             std::vector<Hypothesis> const& hypotheses,
                                             Eigen::MatrixXd const& signatures, std::vector<Score> const& scores,
                                             double asked) {
  Machine const machine = estimation.machine_at(fit.x);
  auto const& runs = estimation.data();
  bool const has_displacement = std::any_of(runs.begin(), runs.end(), [&](BinnedRun const& run) {
    return std::any_of(run.run->channels.begin(), run.run->channels.end(),
                       [&](auto const& channel) { return unit_of(channel, machine) == "um"; });
  });
  std::map<std::string, DetectionLimit> widest;
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    if (hypotheses[h].is_about("sensor")) continue;
    DetectionLimit limit{.hypothesis = hypotheses[h]};
    double const least = detectable(scores[h].information, hypotheses[h], asked);
    limit.any_size = least > 1.0;
    limit.amplitude = std::min(least, 1.0) * hypotheses[h].largest;
    find_most_moved(limit, estimation, machine, has_displacement ? "um" : "K", signatures.col(Eigen::Index(h)));
    limit.swing *= std::min(least, 1.0);
    if (limit.channel.empty()) continue;
    auto const [it, fresh] = widest.emplace(hypotheses[h].label(), limit);
    if (!fresh && limit.swing > it->second.swing) it->second = std::move(limit);
  }
  std::vector<DetectionLimit> limits;
  for (auto& [label, limit] : widest) limits.push_back(std::move(limit));
  std::stable_sort(limits.begin(), limits.end(), [](auto const& a, auto const& b) { return a.swing > b.swing; });
  return limits;
}

}  // namespace thermotwin::twin
