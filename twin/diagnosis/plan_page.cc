#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

#include "output/json_text.h"
#include "twin/diagnosis/plan.h"
#include "twin/diagnosis/separation.h"

namespace thermotwin::twin {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_lines = 25;

std::string words_of(Remedy const& remedy) {
  std::string text = fmt::format("{} ({:.0f} h)", remedy.schedule, remedy.hours);
  if (!remedy.sensor.empty()) text += fmt::format(" with one more sensor on {}", remedy.sensor);
  return fmt::format("{}: {:.1f} σ", text, remedy.distance);
}

/// The best without a sensor more, and the best with one.
std::vector<Remedy> best_of(std::vector<Remedy> const& remedies) {
  std::vector<Remedy> best;
  for (bool const sensor : {false, true})
    for (auto const& remedy : remedies)
      if (remedy.sensor.empty() != sensor) {
        best.push_back(remedy);
        break;
      }
  return best;
}

std::string effects_text(Plan const& plan) {
  std::size_t clear = 0;
  while (clear < plan.effects.size() && plan.effects[clear].seen >= wanted_distance) ++clear;
  std::string text = fmt::format(
      "{} of {} effects at their sites, each in its clearest shape, would be seen ({:.0f} σ or more at half of the "
      "largest plausible size).\n"
      "Hardly or not, the clearest first; kept: what calibration leaves of the signature\n\n"
      "  {:<22} {:<44} {:>8} {:>7}\n",
      clear, plan.effects.size(), wanted_distance, "effect", "site", "seen", "kept");
  for (std::size_t e = clear; e < std::min(plan.effects.size(), clear + most_lines); ++e)
    text += fmt::format("  {:<22} {:<44} {:>6.2f} σ {:>5.1f} %\n", plan.effects[e].hypothesis.effect->name,
                        plan.effects[e].hypothesis.site, plan.effects[e].seen, 100.0 * plan.effects[e].kept);
  if (plan.effects.size() > clear + most_lines)
    text += fmt::format("  … and {} more\n", plan.effects.size() - clear - most_lines);
  return text;
}

std::string ambiguities_text(Plan const& plan) {
  if (plan.ambiguities.empty()) return "\nEvery effect that is seen can be told from every other.\n";
  std::string text = fmt::format(
      "\n{} pairs of effects would be seen, but could be taken for each other (less than {:.0f} σ apart); the "
      "worst:\n\n",
      plan.ambiguities.size(), wanted_distance);
  for (std::size_t a = 0; a < std::min(plan.ambiguities.size(), most_lines); ++a) {
    auto const& ambiguity = plan.ambiguities[a];
    auto const& one = plan.effects[ambiguity.effect];
    text += fmt::format("  {} | {}: {:.1f} σ apart, cosine {:.3f}\n", one.hypothesis.label(),
                        plan.effects[ambiguity.rival].hypothesis.label(), ambiguity.distance, ambiguity.cosine);
    for (auto const& remedy : best_of(ambiguity.remedies)) text += fmt::format("      {}\n", words_of(remedy));
    if (!ambiguity.remedies.empty() && !one.hypothesis.effect->separated_by.empty())
      text += fmt::format("      in general: {}\n", one.hypothesis.effect->separated_by);
  }
  return text;
}

}  // namespace

std::string plan_text(Plan const& plan) {
  return fmt::format("\nPlanned: {} ({:.0f} h).\n\n", fmt::join(plan.schedules, ", "), plan.hours) +
         effects_text(plan) + ambiguities_text(plan);
}

std::string plan_json(Plan const& plan) {
  Json json = {{"experiments", plan.schedules}, {"hours", plan.hours}, {"effects", Json::array()}};
  for (auto const& effect : plan.effects)
    json["effects"].push_back({{"effect", effect.hypothesis.effect->name},
                               {"site", effect.hypothesis.site},
                               {"amplitude", usual_amplitude * effect.hypothesis.largest},
                               {"seen", effect.seen},
                               {"kept", effect.kept}});
  json["ambiguities"] = Json::array();
  for (auto const& ambiguity : plan.ambiguities) {
    Json remedies = Json::array();
    for (auto const& remedy : ambiguity.remedies) remedies.push_back(json_of(remedy));
    json["ambiguities"].push_back({{"effect", plan.effects[ambiguity.effect].hypothesis.effect->name},
                                   {"site", plan.effects[ambiguity.effect].hypothesis.site},
                                   {"rival", plan.effects[ambiguity.rival].hypothesis.effect->name},
                                   {"rival_site", plan.effects[ambiguity.rival].hypothesis.site},
                                   {"cosine", ambiguity.cosine},
                                   {"distance", ambiguity.distance},
                                   {"remedies", remedies}});
  }
  return output::json_text(std::move(json));
}

}  // namespace thermotwin::twin
