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

Effect const& effect_of(Json const& finding) {
  auto const& catalogue = effect_catalogue();
  auto const entry = std::find_if(catalogue.begin(), catalogue.end(),
                                  [&](auto const& effect) { return effect.name == finding["effect"]; });
  if (entry == catalogue.end())
    throw thermal::InputError(
        fmt::format("the effect '{}' is not in the catalogue of this program", finding["effect"].get<std::string>()));
  return *entry;
}

/// "-0.892 um", "-1.19 um", "-0.595 um": these keys of a finding in the unit in which people say its amplitude.
std::vector<std::string> amplitude_texts(Json const& finding, std::vector<std::string> const& keys, int digits) {
  auto const& parameters = effect_of(finding).parameters;
  auto const parameter =
      std::find_if(parameters.begin(), parameters.end(), [&](auto const& p) { return p.key == finding["parameter"]; });
  std::string unit = finding["unit"].get<std::string>();
  if (parameter != parameters.end()) unit = readable_unit(finding["amplitude"].get<double>(), parameter->dimension);
  std::vector<std::string> texts;
  for (auto const& key : keys) texts.push_back(written_value(finding[key].get<double>(), unit, digits));
  return texts;
}

void explain(Json& finding) {
  auto const& effect = effect_of(finding);
  finding["meaning"] = effect.meaning;
  finding["separated_by"] = effect.separated_by;
  auto const texts = amplitude_texts(finding, {"amplitude", "low", "high"}, 3);
  finding["text"] = fmt::format("{} ({} to {})", texts[0], texts[1], texts[2]);
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
  if (diagnosis.contains("could_hide"))
    for (auto& limit : diagnosis["could_hide"]) limit["text"] = amplitude_texts(limit, {"amplitude"}, 2)[0];
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
