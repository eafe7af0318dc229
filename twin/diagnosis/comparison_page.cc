#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

#include "output/json_text.h"
#include "twin/diagnosis/comparison.h"

namespace thermotwin::twin {
namespace {

std::string pair(GapPair const& gap) {
  return gap.samples == 0 ? "-" : fmt::format("{:.3g} → {:.3g}", gap.before, gap.after);
}

/// Of the column of channels.
std::size_t width_of_channels(Comparison const& comparison) {
  std::size_t width = 14;
  for (auto const& run : comparison.runs)
    for (auto const& channel : run.channels) width = std::max(width, channel.name.size());
  return width;
}

std::string run_table(ComparedRun const& run, std::size_t width) {
  auto const with_unit = width + 6;
  std::string text = fmt::format("\n{}\n", run.name);
  for (auto const& remark : run.remarks) text += fmt::format("  note: {}\n", remark);
  text += fmt::format("\n  {:<{}} {:>17}  {:>17} ", "", with_unit, "error, RMS", "offset taken off");
  for (auto const& regime : run.regimes) text += fmt::format(" {:>16}", regime);
  text +=
      fmt::format("\n  {:<{}} {:>8} {:>8}  {:>8} {:>8} ", "channel", with_unit, "before", "after", "before", "after");
  for (std::size_t i = 0; i < run.regimes.size(); ++i) text += fmt::format(" {:>16}", "before → after");
  text += "\n";
  for (auto const& channel : run.channels) {
    if (channel.whole.samples == 0) continue;
    text += fmt::format("  {:<{}} {:>5} {:>8.3g} {:>8.3g}  {:>8.3g} {:>8.3g} ", channel.name, width, channel.unit,
                        channel.whole.before, channel.whole.after, channel.offset_before, channel.offset_after);
    for (auto const& part : channel.parts) text += fmt::format(" {:>16}", pair(part));
    text += "\n";
  }
  return text;
}

using Json = nlohmann::ordered_json;

Json to_json(GapPair const& gap) {
  return {{"before", gap.before}, {"after", gap.after}, {"samples", gap.samples}};  // NaN becomes null
}

Json to_json(ComparedRun const& run) {
  Json channels = Json::array();
  for (auto const& channel : run.channels) {
    Json regimes = Json::object();
    for (std::size_t i = 0; i < run.regimes.size(); ++i) regimes[run.regimes[i]] = to_json(channel.parts[i]);
    channels.push_back({{"name", channel.name},
                        {"unit", channel.unit},
                        {"rms", to_json(channel.whole)},
                        {"offset_before", channel.offset_before},
                        {"offset_after", channel.offset_after},
                        {"regimes", regimes}});
  }
  return {{"name", run.name}, {"remarks", run.remarks}, {"channels", channels}};
}

constexpr char const* units[] = {"K", "um", "urad"};

}  // namespace

std::string comparison_table(Comparison const& comparison) {
  auto const width = width_of_channels(comparison);
  std::string text = fmt::format(
      "before: {}\nafter:  {}\nroot mean square of measured minus predicted; of each channel and run one constant is "
      "taken off\n",
      comparison.before, comparison.after);
  for (auto const& run : comparison.runs) text += run_table(run, width);
  text += "\nall channels and runs\n";
  for (auto const* unit : units)
    if (auto const gap = total(comparison, unit); gap.samples > 0)
      text += fmt::format("  {:<{}} {:>5} {:>8.3g} {:>8.3g}  {:+.1f} %\n", "", width, unit, gap.before, gap.after,
                          100.0 * (gap.after / gap.before - 1.0));
  return text;
}

std::string comparison_json(Comparison const& comparison) {
  Json json = {{"before", comparison.before},
               {"after", comparison.after},
               {"alignment", "one constant per channel and run is taken off, for each machine its own"}};
  json["runs"] = Json::array();
  for (auto const& run : comparison.runs) json["runs"].push_back(to_json(run));
  for (auto const* unit : units)
    if (auto const gap = total(comparison, unit); gap.samples > 0) json["total"][unit] = to_json(gap);
  return output::json_text(std::move(json));
}

}  // namespace thermotwin::twin
