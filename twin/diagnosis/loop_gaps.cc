#include "twin/diagnosis/loop_gaps.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <string>

#include "thermal/bounding_box.h"
#include "twin/file/document.h"

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

/// `{ of = "bed", length = "24 mm" }`: so much of it [m], with its sign.
std::string step_text(std::string const& body, double length) {
  return fmt::format(R"({{ of = "{}", length = "{:.4g} mm"{} }})", body, 1e3 * std::abs(length),
                     length < 0.0 ? ", weight = -1" : "");
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
      LoopGap gap{fmt::format("{} by {}", channel.name, drawn->name), channel.name, drawn->name, length, {}};
      gap.growth.resize(machine.linear_channels.size());
      gap.growth[d] = free_growth(solid, length);
      gaps.push_back(std::move(gap));
    }
  }
  return gaps;
}

std::vector<LoopBeyond> loops_beyond(Value document, std::vector<LoopGap> const& gaps, std::vector<double> const& x) {
  std::vector<LoopBeyond> loops;
  for (std::string const kind : {"rotation", "displacement"})
    for (auto const* channel : tables_of(document, kind)) {
      double const base = kind == "rotation" ? number_in(*channel, "base", dimension::length).value_or(1.0) : 1.0;
      std::vector<std::string> steps;
      for (std::size_t g = 0; g < gaps.size(); ++g)
        if (x[g] != 0.0 && gaps[g].displacement == name_in(*channel))
          steps.push_back(step_text(gaps[g].body, base * x[g] * gaps[g].length));
      if (steps.empty()) continue;
      Value const* before = channel->find("beyond");
      if (before && before->is_list())
        for (auto const& step : std::get<Value::List>(before->content)) steps.push_back(step.text());
      loops.push_back({kind + '.' + name_in(*channel), fmt::format("[{}]", fmt::join(steps, ", "))});
    }
  return loops;
}

}  // namespace thermotwin::twin
