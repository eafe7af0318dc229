#include "twin/reduced_summary.h"

#include <fmt/format.h>

namespace thermotwin::twin {
namespace {

std::string line(output::Channel const& channel, double bound, std::string const& unit) {
  auto const& values = channel.values;
  return fmt::format("  {:<14} {:<34} {:>9.2f} {:>9.2f} {:>9.2f}   ± {:.4f} {}\n", channel.name, channel.long_name,
                     values[0], values[values.size() - 1], values.maxCoeff(), bound, unit);
}

}  // namespace

std::string reduced_table(ReducedTwin const& twin, ReducedResult const& result) {
  auto const& data = result.dataset;
  std::string text = fmt::format("\n{}, {:.2f} h, {} nodes through {} shapes and {} laws\n\n", data.title,
                                 data.time_s[data.time_s.size() - 1] / 3600.0, twin.machine().network().nodes(),
                                 twin.network().size(), twin.network().elements().size());
  text += fmt::format("  {:<49} {:>9} {:>9} {:>9}   against the full model\n", "without the instruments' errors",
                      "start", "end", "highest");
  for (std::size_t s = 0; s < data.truth_readings.size(); ++s)
    text += line(data.truth_readings[s], result.bound.readings[s], "K");
  for (std::size_t c = 0; c < std::size_t(result.bound.displacements.size()); ++c)
    text += line(data.truth_displacements[c], result.bound.displacements[Eigen::Index(c)],
                 data.truth_displacements[c].unit == "um" ? "µm" : "µrad");
  text += fmt::format("\n  solver     {} steps, {} right-hand sides, of both models\n", result.steps,
                      result.rate_evaluations);
  return text;
}

}  // namespace thermotwin::twin
