#include "twin/diagnosis/loop_gaps.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

#include "thermal/bounding_box.h"

namespace thermotwin::twin {
namespace {

/// α L of a solid, and where its nodes are.
NodeWeights free_growth(thermal::GrowingBody const& solid, double length) {
  double const sum = std::accumulate(solid.weights.begin(), solid.weights.end(), 0.0);
  NodeWeights weights;
  for (std::size_t n = 0; n < solid.weights.size(); ++n)
    weights.emplace_back(solid.first_node + int(n), solid.expansion * length * solid.weights[n] / sum);
  return weights;
}

}  // namespace

std::vector<LoopGap> loop_gaps(Machine const& machine) {
  std::vector<LoopGap> gaps;
  for (std::size_t d = 0; d < machine.displacements.size(); ++d) {
    auto const& loop = machine.displacements[d].weights;
    if (std::any_of(loop.begin(), loop.end(), [](auto const& step) { return step.second == 0.0; })) continue;
    for (auto const& solid : machine.growing) {
      auto const drawn = std::find_if(machine.geometry.begin(), machine.geometry.end(),
                                      [&](auto const& body) { return body.first_node == solid.first_node; });
      if (drawn == machine.geometry.end() || solid.expansion == 0.0) continue;
      auto const& channel = machine.displacements[d];
      double const length = channel.rotation ? 1.0 : thermal::bounding_box(drawn->cells).sizes().maxCoeff();
      LoopGap gap{fmt::format("{} by {}", channel.name, drawn->name), {}};
      gap.growth.resize(machine.displacements.size());
      gap.growth[d] = free_growth(solid, length);
      gaps.push_back(std::move(gap));
    }
  }
  return gaps;
}

}  // namespace thermotwin::twin
