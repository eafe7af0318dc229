#include "twin/report/answer_section.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "thermal/error.h"
#include "twin/file/text_file.h"
#include "twin/progress_file.h"
#include "twin/report/campaign_progress.h"
#include "twin/report/campaign_section.h"
#include "twin/report/diagnosis_section.h"
#include "twin/report/machine_section.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;
using output::Json;
using output::ReportPage;

std::string_view kind_of(Json const& answer) {
  struct Kind {
    std::string_view name;
    std::vector<char const*> keys;
  };
  static std::vector<Kind> const kinds = {{"diagnosis", {"verdict", "effects", "gaps"}},
                                          {"study", {"combinations", "worlds", "claims"}},
                                          {"placement", {"recommended", "candidates"}},
                                          {"volumetric", {"predictions", "compensated_by"}},
                                          {"progress", {"steps", "title"}}};
  for (auto const& [name, keys] : kinds)
    if (answer.is_object() && std::all_of(keys.begin(), keys.end(), [&](auto key) { return answer.contains(key); }))
      return name;
  return "";
}

Json study_json(Json study) {
  for (char const* list : {"selections", "combinations"})
    for (auto& row : study[list])
      for (auto& figure : row["figures"]) figure.erase("values");
  return study;
}

/// A map over the nodes: nothing is to be had where no sensor may sit.
Eigen::VectorXd map_of(Json const& list) {
  Eigen::VectorXd values(Eigen::Index(list.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values[i] = list[std::size_t(i)].is_null() ? 0.0 : list[std::size_t(i)].get<double>();
  return values;
}

/// The recommended sensors by their numbers; those in the air have no place.
std::vector<MarkedPlace> marks_of(Json const& sensors) {
  std::vector<MarkedPlace> marks;
  int number = 0;
  for (auto const& sensor : sensors) {
    ++number;
    auto const p = sensor["position_m"].get<std::array<double, 3>>();
    if (sensor["at"] != Json::array({"ambient"}))
      marks.push_back({std::to_string(number), sensor["name"].get<std::string>(), {p[0], p[1], p[2]}});
  }
  return marks;
}

/// Without a machine or a map the section says why nothing is drawn.
Json placement_json(Json placement, fs::path const& machine, ReportPage& page) {
  if (!placement.contains("remarks")) placement["remarks"] = Json::array();
  if (!placement.contains("map")) {
    placement["remarks"].push_back(
        "No map is drawn: this answer holds none. `thermotwin place … --report DIR` has it.");
    return placement;
  }
  try {
    auto const built = Machine::read(machine.empty() ? machine_file(placement["machine"].get<std::string>()) : machine);
    auto const& map = placement["map"];
    placement["shape"] = painted_machine_json(built, map_of(map["alone_um"]), map_of(map["beside_um"]),
                                              marks_of(placement["recommended"]["sensors"]), page);
  } catch (thermal::InputError const& error) {
    placement["remarks"].push_back(fmt::format("No map is drawn: {} Name the machine with --machine.", error.what()));
  }
  placement.erase("map");
  return placement;
}

/// Of a job that was killed nobody else says so.
Json progress_json(Json progress, fs::path const& file) {
  if (progress.value("done", false) || ProgressFile::is_running(fs::absolute(file).parent_path())) return progress;
  auto& steps = progress["steps"];
  double const last = steps.empty() ? 0.0 : steps.back()["at_s"].get<double>();
  steps.push_back({{"what", "ended without a word: it was killed"}, {"at_s", last}});
  progress["done"] = true;
  return progress;
}

std::string title_of(std::string_view kind, Json const& answer, fs::path const& file) {
  if (kind == "study" || kind == "progress") return answer["title"].get<std::string>();
  if (kind == "placement") return fmt::format("Sensors on {}", answer["machine"].get<std::string>());
  if (kind == "volumetric") {
    auto const travel = answer["travel_mm"].get<std::array<double, 3>>();
    return fmt::format("Volume of {:.0f} × {:.0f} × {:.0f} mm", travel[0], travel[1], travel[2]);
  }
  return file.stem().string();
}

}  // namespace

Json read_json(fs::path const& file) {
  auto const text = text_of_file(file);
  try {
    return Json::parse(text);
  } catch (Json::parse_error const& error) {
    auto const before = std::string_view(text).substr(0, std::max<std::size_t>(error.byte, 1) - 1);
    auto const line = 1 + std::count(before.begin(), before.end(), '\n');
    auto const column = before.size() - before.rfind('\n');  // npos + 1 is 0
    throw thermal::InputError(fmt::format("{}: damaged at line {}, column {}: not JSON", file.string(), line, column));
  }
}

/// Without the library's name for what it complains of, which stands in brackets.
thermal::InputError no_answer(fs::path const& file, std::exception const& error) {
  std::string const what = error.what();
  auto const end = what.starts_with('[') ? what.find("] ") : std::string::npos;
  return thermal::InputError(fmt::format("{}: damaged, or no answer of thermotwin: {}", file.string(),
                                         end == std::string::npos ? what : what.substr(end + 2)));
}

bool is_answer(fs::path const& path) { return path.extension() == ".json" || is_campaign(path); }

void refuse_folder(fs::path const& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return;
  for (auto const* kind : {"study", "diagnosis", "placement"})
    if (auto const answer = path / fmt::format("{}.json", kind); fs::exists(answer, ignored))
      throw thermal::InputError(
          fmt::format("'{}' is the folder of a {}; its answer is '{}'", path.string(), kind, answer.string()));
  throw thermal::InputError(fmt::format(
      "'{0}' is a folder; data sets and answers (.json) are due; `thermotwin view {0}` shows what comes into it",
      path.string()));
}

std::string add_answer(fs::path const& file, fs::path const& machine, ReportPage& page) {
  try {
    if (is_campaign(file)) {
      auto const progress = campaign_progress(file), shown = campaign_json(file, page);
      bool const done = progress["done"].get<bool>();
      if (!done) page.add_section("progress", progress);
      if (!shown.is_null()) page.add_section("campaign", shown);
      if (done) page.add_section("progress", progress);
      return (shown.is_null() ? progress : shown)["title"].get<std::string>();
    }
    Json const answer = read_json(file);
    auto const kind = kind_of(answer);
    if (kind == "diagnosis")
      page.add_section(kind, diagnosis_json(answer, file.stem().string()));
    else if (kind == "study")
      page.add_section(kind, study_json(answer));
    else if (kind == "placement")
      page.add_section(kind, placement_json(answer, machine, page));
    else if (kind == "progress")
      page.add_section(kind, progress_json(answer, file));
    else if (!kind.empty())
      page.add_section(kind, answer);
    else
      throw thermal::InputError(
          fmt::format("{}: a report takes data sets, and what `diagnose --json`, `study`, `place --json` and "
                      "`volumetric --json` write; this is none of them",
                      file.string()));
    return title_of(kind, answer, file);
  } catch (Json::exception const& error) {
    throw no_answer(file, error);
  } catch (std::logic_error const&) {  // of std::stoll
    throw thermal::InputError(fmt::format("{}: damaged: a number is none", file.string()));
  }
}

}  // namespace thermotwin::twin
