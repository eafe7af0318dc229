#include "twin/file_kind.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>
#include <string>
#include <string_view>

#include "scenarios/experiment.h"
#include "thermal/error.h"
#include "twin/campaign/campaign_description.h"
#include "twin/diagnosis/measurement_file.h"
#include "twin/error_model_file.h"
#include "twin/machine_tables.h"
#include "twin/placement/candidate_sites.h"
#include "twin/study/study_description.h"

namespace thermotwin::twin {
namespace {

struct KindOfFile {
  FileKind kind;
  std::string_view name;
  std::set<std::string> keys;
};

std::set<std::string> keys_among(std::vector<FieldRecord> const& fields) {
  std::set<std::string> keys;
  for (auto const& field : fields) keys.insert(field.key);
  return keys;
}

constexpr char const* sensor_table = "temperature_sensor";

/// Sensors alone make no machine.
std::set<std::string> keys_of_machine() {
  std::set<std::string> keys(machine_keys().begin(), machine_keys().end());
  keys.erase(sensor_table);
  return keys;
}

/// In the order of FileKind.
std::array<KindOfFile, 8> const& kinds_of_file() {
  static std::array<KindOfFile, 8> const kinds = {{
      {FileKind::experiment, "an experiment", keys_among(list_fields<scenarios::Experiment>())},
      {FileKind::campaign, "a campaign", keys_among(list_fields<CampaignDescription>())},
      {FileKind::error_model, "an error model", keys_among(error_model_fields())},
      {FileKind::study, "a study", keys_among(list_fields<StudyDescription>())},
      {FileKind::measurement, "a measurement file", keys_among(list_fields<MeasurementFile>())},
      {FileKind::candidates, "a file of candidates", keys_among(list_fields<CandidateRules>())},
      {FileKind::machine, "a machine file", keys_of_machine()},
      {FileKind::sensors, "a list of sensors", {sensor_table}},
  }};
  return kinds;
}

std::ptrdiff_t known_keys_in(Value const& document, KindOfFile const& kind) {
  auto const keys = document.keys();
  return std::count_if(keys.begin(), keys.end(), [&](auto const& key) { return kind.keys.contains(key); });
}

KindOfFile const& most_likely_kind(Value const& document) {
  auto const& kinds = kinds_of_file();
  auto const most = std::max_element(kinds.begin(), kinds.end(), [&](auto const& a, auto const& b) {
    return known_keys_in(document, a) < known_keys_in(document, b);
  });
  return known_keys_in(document, *most) > 0 ? *most : kinds[std::size_t(FileKind::machine)];
}

std::string_view name_of_kind(std::filesystem::path const& file) {
  try {
    Value const document = read_toml(file);
    auto const& kind = most_likely_kind(document);
    if (known_keys_in(document, kind) > 0) return kind.name;
  } catch (FileError const&) {  // no TOML
  }
  return "something else";
}

}  // namespace

FileKind file_kind(Value const& document) { return most_likely_kind(document).kind; }

bool may_be(Value const& document, FileKind kind) {
  auto const& kinds = kinds_of_file();
  auto const& likely = most_likely_kind(document);
  auto const most = known_keys_in(document, likely);
  return likely.kind == kind || std::count_if(kinds.begin(), kinds.end(), [&](auto const& other) {
                                  return known_keys_in(document, other) == most;
                                }) > 1;
}

void refuse_other_kind(Value const& document, FileKind due) {
  if (may_be(document, due)) return;
  throw FileError({document.where.file, 0, 0}, fmt::format("is {}; {} is due", most_likely_kind(document).name,
                                                           kinds_of_file()[std::size_t(due)].name));
}

void refuse_to_replace(std::filesystem::path const& output, FileKind written) {
  if (!std::filesystem::is_regular_file(output) || std::filesystem::is_empty(output)) return;
  auto const there = name_of_kind(output), due = kinds_of_file()[std::size_t(written)].name;
  if (there != due)
    throw thermal::InputError(
        fmt::format("{}: is {}, whose place {} does not take; name another output", output.string(), there, due));
}

}  // namespace thermotwin::twin
