#include "twin/reduced_summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

#include "output/json_text.h"
#include "twin/summary.h"

namespace thermotwin::twin {
namespace {

std::string line(output::Channel const& channel, ChannelWidths const& widths, double bound, std::string const& unit) {
  auto const& values = channel.values;
  return fmt::format("  {:<{}} {:<{}} {:>9.2f} {:>9.2f} {:>9.2f}   ± {:.4f} {}\n", channel.name, widths.name,
                     channel.long_name, widths.title, values[0], values[values.size() - 1], values.maxCoeff(), bound,
                     unit);
}

}  // namespace

std::string reduced_table(ReducedTwin const& twin, ReducedResult const& result) {
  auto const& data = result.dataset;
  std::string text = fmt::format("\n{}, {:.2f} h, {} nodes through {} shapes and {} laws\n\n", data.title,
                                 data.time_s[data.time_s.size() - 1] / 3600.0, twin.machine().network().nodes(),
                                 twin.network().size(), twin.network().elements().size());
  auto channels = data.truth_readings;
  channels.insert(channels.end(), data.truth_displacements.begin(), data.truth_displacements.end());
  auto const widths = channel_widths(channels);
  text += fmt::format("  {:<{}} {:>9} {:>9} {:>9}   against the full model\n", "without the instruments' errors",
                      widths.name + 1 + widths.title, "start", "end", "highest");
  for (std::size_t s = 0; s < data.truth_readings.size(); ++s)
    text += line(data.truth_readings[s], widths, result.bound.readings[s], "K");
  for (std::size_t c = 0; c < std::size_t(result.bound.displacements.size()); ++c)
    text += line(data.truth_displacements[c], widths, result.bound.displacements[Eigen::Index(c)],
                 data.truth_displacements[c].unit == "um" ? "µm" : "µrad");
  text += fmt::format("\n  solver     {} steps, {} right-hand sides, of both models\n", result.steps,
                      result.rate_evaluations);
  return text;
}

std::string reduced_json(ReducedTwin const& twin, ReducedResult const& result) {
  auto const& data = result.dataset;
  nlohmann::ordered_json json;
  json["title"] = data.title;
  json["nodes"] = twin.machine().network().nodes();
  json["shapes"] = twin.network().size();
  json["laws"] = twin.network().elements().size();
  json["duration_s"] = data.time_s[data.time_s.size() - 1];
  json["readings"] = extremes_json(data.readings);
  for (std::size_t s = 0; s < data.readings.size(); ++s) json["readings"][s]["bound"] = result.bound.readings[s];
  json["displacements"] = extremes_json(data.displacements);
  for (Eigen::Index c = 0; c < result.bound.displacements.size(); ++c)
    json["displacements"][std::size_t(c)]["bound"] = result.bound.displacements[c];
  json["solver"] = {{"steps", result.steps}, {"rate_evaluations", result.rate_evaluations}};
  return output::json_text(std::move(json));
}

}  // namespace thermotwin::twin
