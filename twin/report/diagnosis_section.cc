#include "twin/report/diagnosis_section.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vector>

#include "thermal/error.h"
#include "twin/diagnosis/diagnosis_report.h"
#include "twin/diagnosis/estimate_text.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

using output::Json;

/// "-0.892 um (-1.19 um to -0.595 um)", to three digits, in the unit in which people say the amplitude.
std::string amplitude_text(Json const& finding, Effect const& effect) {
  auto const parameter = std::find_if(effect.parameters.begin(), effect.parameters.end(),
                                      [&](auto const& p) { return p.key == finding["parameter"]; });
  auto const amplitude = finding["amplitude"].get<double>();
  if (parameter == effect.parameters.end())
    return fmt::format("{:.4g} {}", amplitude, finding["unit"].get<std::string>());
  std::string const unit = readable_unit(amplitude, parameter->dimension);
  auto const text = [&](char const* key) { return written_value(finding[key].get<double>(), unit, 3); };
  return fmt::format("{} ({} to {})", text("amplitude"), text("low"), text("high"));
}

void explain(Json& finding) {
  auto const& catalogue = effect_catalogue();
  auto const entry = std::find_if(catalogue.begin(), catalogue.end(),
                                  [&](auto const& effect) { return effect.name == finding["effect"]; });
  if (entry == catalogue.end())
    throw thermal::InputError(
        fmt::format("the effect '{}' is not in the catalogue of this program", finding["effect"].get<std::string>()));
  finding["meaning"] = entry->meaning;
  finding["separated_by"] = entry->separated_by;
  finding["text"] = amplitude_text(finding, *entry);
}

std::string name_of(Json const& finding) {
  auto name = finding["effect"].get<std::string>();
  std::replace(name.begin(), name.end(), '_', ' ');
  return fmt::format("{} at {}", name, finding["site"].get<std::string>());
}

/// Each group is one missing thing; its members exclude one another.
std::string missing_things(Json const& effects) {
  if (effects.size() == 1) return fmt::format("{}: {}", name_of(effects[0]), effects[0]["meaning"].get<std::string>());
  std::vector<std::vector<std::string>> groups;
  for (auto const& finding : effects) {
    auto const group = finding["group"].get<std::size_t>();
    if (groups.size() <= group) groups.resize(group + 1);
    groups[group].push_back(name_of(finding));
  }
  std::vector<std::string> things;
  for (auto const& group : groups) things.push_back(fmt::format("{}", fmt::join(group, ", or ")));
  return fmt::format("{}", fmt::join(things, "; and "));
}

/// "−4.2 ± 8.5 W", with a minus and no hyphen, and half of the 95 % interval.
std::string watts_text(Json const& heat) {
  auto const watts = heat["watts"].get<double>();
  double const half = two_sided_95 * heat.value("standard_error", 0.0);  // not told by earlier versions
  return fmt::format("{}{:.1f}{} W", watts < 0.0 ? "−" : "", std::abs(watts),
                     half > 0.0 ? fmt::format(" ± {:.1f}", half) : "");
}

std::string sentence(Json const& diagnosis) {
  auto const verdict = diagnosis["verdict"].get<std::string>();
  auto const& effects = diagnosis["effects"];
  if (verdict == "nothing") return diagnosis.value("headline", std::string("Nothing is missing."));
  if (verdict == "sensor" && diagnosis.contains("sensor"))
    return fmt::format("The sensor {} is at fault, not the machine.", diagnosis["sensor"]["name"].get<std::string>());
  if (verdict == "none_known" && diagnosis.contains("heat") && diagnosis["heat"].contains("watts_per_kelvin_of_air"))
    return fmt::format(
        "The air at the machine is not as warm as its record says, and none of the effects tried explains it: {} on "
        "average into {}.",
        watts_text(diagnosis["heat"]), diagnosis["heat"]["body"].get<std::string>());
  if (verdict == "none_known" && diagnosis.contains("heat"))
    return fmt::format("Heat of {} on average into {} is missing, and none of the effects tried explains it.",
                       watts_text(diagnosis["heat"]), diagnosis["heat"]["body"].get<std::string>());
  if (effects.empty()) return no_name;
  if (verdict == "none_known") return fmt::format("{} What stands in for it: {}.", no_name, missing_things(effects));
  return fmt::format("The machine file lacks {}.", missing_things(effects));
}

}  // namespace

Json diagnosis_json(Json diagnosis, std::string const& name) {
  for (auto& finding : diagnosis["effects"]) explain(finding);
  if (diagnosis.contains("suspicion"))
    for (auto& finding : diagnosis["suspicion"]["effects"]) explain(finding);
  if (diagnosis.contains("cautions")) {
    Json remarks = diagnosis["cautions"];
    for (auto const& remark : diagnosis["remarks"]) remarks.push_back(remark);
    diagnosis["remarks"] = std::move(remarks);
  }
  diagnosis["name"] = name;
  diagnosis["sentence"] = sentence(diagnosis);
  return diagnosis;
}

}  // namespace thermotwin::twin
