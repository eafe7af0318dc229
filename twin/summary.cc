#include "twin/summary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

#include "output/json_text.h"
#include "twin/drift_test.h"

namespace thermotwin::twin {
namespace {

struct Extremes {
  double first = 0.0, last = 0.0, lowest = 0.0, highest = 0.0;
};

/// Of what is there: a reading may be missing.
Extremes extremes(Eigen::VectorXd const& values) {
  Extremes e{NAN, NAN, INFINITY, -INFINITY};
  for (double v : values) {
    if (std::isnan(v)) continue;
    if (std::isnan(e.first)) e.first = v;
    e.last = v;
    e.lowest = std::min(e.lowest, v);
    e.highest = std::max(e.highest, v);
  }
  return e;
}

/// Letters, of UTF-8.
std::size_t width_of(std::string const& text) {
  return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Missing: a dead sensor.
std::string in_table(double value, int width) {
  return std::isfinite(value) ? fmt::format("{:>{}.2f}", value, width) : fmt::format("{:>{}}", "-", width);
}

}  // namespace

ChannelWidths channel_widths(std::vector<output::Channel> const& channels) {
  ChannelWidths widths;
  for (auto const& channel : channels) {
    widths.name = std::max(widths.name, width_of(channel.name));
    widths.title = std::max(widths.title, width_of(channel.long_name));
  }
  return widths;
}

nlohmann::ordered_json extremes_json(std::vector<output::Channel> const& channels) {
  auto json = nlohmann::ordered_json::array();
  for (auto const& channel : channels) {
    auto const e = extremes(channel.values);
    json.push_back({{"name", channel.name},
                    {"unit", channel.unit},
                    {"start", e.first},
                    {"end", e.last},
                    {"lowest", e.lowest},
                    {"highest", e.highest}});
  }
  return json;
}

std::string summary_table(Machine const& machine, RunResult const& result) {
  auto const& data = result.dataset;
  auto const& s = result.summary;
  std::string text = fmt::format("\n{}, {:.2f} h, {} nodes\n\n", data.title,
                                 data.time_s[data.time_s.size() - 1] / 3600.0, machine.network().nodes());
  auto const sensors = channel_widths(data.readings), displacements = channel_widths(data.displacements);
  text += fmt::format("  {:<{}} {:<{}} {:>9} {:>9} {:>14}\n", "sensor", sensors.name, "", sensors.title, "start °C",
                      "end °C", "largest rise K");
  for (auto const& channel : data.readings) {
    auto const e = extremes(channel.values);
    text += fmt::format("  {:<{}} {:<{}} {} {} {}\n", channel.name, sensors.name, channel.long_name, sensors.title,
                        in_table(e.first, 9), in_table(e.last, 9), in_table(e.highest - e.first, 14));
  }
  text += fmt::format("\n  {:<{}} {:<{}} {:>9} {:>9} {:>9}\n", "displacement", displacements.name, "",
                      displacements.title, "end", "lowest", "highest");
  for (auto const& channel : data.displacements) {
    auto const e = extremes(channel.values);
    text += fmt::format("  {:<{}} {:<{}} {} {} {} {}\n", channel.name, displacements.name, channel.long_name,
                        displacements.title, in_table(e.last, 9), in_table(e.lowest, 9), in_table(e.highest, 9),
                        channel.unit == "um" ? "µm" : "µrad");
  }
  if (auto const test = drift_test(data, result.jumps)) text += "\n" + drift_table(*test);
  text += fmt::format(
      "\n  energy     {:.4g} kJ supplied = {:.4g} stored + {:.4g} to the surroundings + {:.4g} withdrawn; balance "
      "to {:.1e}\n",
      s.energy.supplied / 1e3, s.stored / 1e3, s.energy.lost / 1e3, s.energy.withdrawn / 1e3, s.energy_imbalance());
  text += fmt::format("  solver     {} steps, {} right-hand sides, {} Jacobians, {} restarts, {}, {:.2f} s\n", s.steps,
                      s.rate_evaluations, s.jacobian_evaluations, s.restarts, name_of(s.solver), s.wall_time);
  for (auto const& extrapolated : result.extrapolated) text += fmt::format("  beyond     {}\n", text_of(extrapolated));
  return text;
}

std::string summary_json(Machine const& machine, RunResult const& result) {
  using Json = nlohmann::ordered_json;
  auto const& data = result.dataset;
  auto const& s = result.summary;
  Json json;
  json["title"] = data.title;
  json["nodes"] = machine.network().nodes();
  json["duration_s"] = data.time_s[data.time_s.size() - 1];
  json["readings"] = extremes_json(data.readings);
  json["displacements"] = extremes_json(data.displacements);
  if (auto const test = drift_test(data, result.jumps)) json["drift_test"] = drift_json(*test);
  json["energy"] = {{"supplied_J", s.energy.supplied},
                    {"withdrawn_J", s.energy.withdrawn},
                    {"lost_J", s.energy.lost},
                    {"stored_J", s.stored},
                    {"imbalance", s.energy_imbalance()}};
  json["solver"] = {{"linear", name_of(s.solver)},
                    {"steps", s.steps},
                    {"rate_evaluations", s.rate_evaluations},
                    {"jacobian_evaluations", s.jacobian_evaluations},
                    {"restarts", s.restarts},
                    {"wall_time_s", s.wall_time}};
  json["extrapolated"] = Json::array();
  for (auto const& e : result.extrapolated)
    json["extrapolated"].push_back({{"part", e.part},
                                    {"number", e.range->number},
                                    {"value", e.number},
                                    {"lower", e.range->lower},
                                    {"upper", e.range->upper},
                                    {"share_of_heat", e.share}});
  return output::json_text(std::move(json));
}

}  // namespace thermotwin::twin
