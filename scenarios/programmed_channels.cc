#include "scenarios/programmed_channels.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace thermotwin::scenarios {
namespace {

struct Programmed {
  std::string_view field;
  std::vector<std::string> channels;
};

/// See ExperimentCourse, which makes them.
std::vector<Programmed> const& programmed() {
  static std::vector<Programmed> const all = {
      {"spindle", {"spindle.speed"}},
      {"ambient.mean", {"ambient.temperature"}},
      {"ambient.drift", {"ambient.temperature"}},
      {"ambient.daily_cycle", {"ambient.temperature"}},
      {"ambient.air_conditioning", {"ambient.temperature"}},
      {"ambient.door_openings", {"ambient.temperature", "ambient.door"}},
      {"ambient.stratification", {"ambient.gradient"}},
      {"ambient.reference_height", {"ambient.reference_height"}},
      {"coolant.on", {"coolant.on"}},
      {"coolant.blocks", {"coolant.on"}},
      {"coolant.temperature", {"coolant.temperature"}},
      {"chiller.on", {"chiller.on"}},
      {"chiller.blocks", {"chiller.on"}},
      {"chiller.offset", {"chiller.offset"}},
      {"power", {"machine.on"}},
      {"servo", {"servo.on"}},
  };
  return all;
}

/// The field itself, or one within it.
bool within(std::string_view field, std::string_view outer) {
  return field == outer || (field.starts_with(outer) && field[outer.size()] == '.');
}

/// Of a nut that is followed, the programme says where it is besides how fast.
std::vector<std::string> channels_of_axis(Experiment const& experiment, std::string_view field) {
  std::size_t axis = 0;
  auto const [end, error] = std::from_chars(field.data(), field.data() + field.size(), axis);
  if (error != std::errc() || axis >= experiment.axes.size() || experiment.axes[axis].resolved) return {};
  field.remove_prefix(static_cast<std::size_t>(end - field.data()));
  constexpr std::array<std::string_view, 4> of_feed = {".blocks", ".cycles", ".duty", ".dwell"};
  bool const acts_by_feed =
      std::any_of(of_feed.begin(), of_feed.end(), [&](std::string_view key) { return within(field, key); });
  return acts_by_feed ? std::vector<std::string>{experiment.axes[axis].axis + ".feed"} : std::vector<std::string>{};
}

}  // namespace

std::vector<std::string> programmed_channels(Experiment const& experiment, std::string_view field) {
  constexpr std::string_view axes = "axes.";
  if (field.starts_with(axes)) return channels_of_axis(experiment, field.substr(axes.size()));
  auto const found = std::find_if(programmed().begin(), programmed().end(),
                                  [&](Programmed const& one) { return within(field, one.field); });
  return found == programmed().end() ? std::vector<std::string>{} : found->channels;
}

}  // namespace thermotwin::scenarios
