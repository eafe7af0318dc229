#include "twin/file_kind.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>
#include <string>

#include "scenarios/experiment.h"
#include "twin/campaign/campaign_description.h"
#include "twin/diagnosis/measurement_file.h"
#include "twin/error_model_file.h"
#include "twin/machine.h"
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

/// The tables of a machine, and what stands above them.
std::set<std::string> keys_of_machine() {
  auto const tables = describe_machine();
  auto keys = keys_among(tables.front().fields);
  for (std::size_t t = 1; t < tables.size(); ++t) keys.insert(tables[t].name);
  return keys;
}

/// In the order of FileKind.
std::array<KindOfFile, 7> const& kinds_of_file() {
  static std::array<KindOfFile, 7> const kinds = {{
      {FileKind::experiment, "an experiment", keys_among(list_fields<scenarios::Experiment>())},
      {FileKind::campaign, "a campaign", keys_among(list_fields<CampaignDescription>())},
      {FileKind::error_model, "an error model", keys_among(error_model_fields())},
      {FileKind::study, "a study", keys_among(list_fields<StudyDescription>())},
      {FileKind::measurement, "a measurement file", keys_among(list_fields<MeasurementFile>())},
      {FileKind::candidates, "a file of candidates", keys_among(list_fields<CandidateRules>())},
      {FileKind::machine, "a machine file", keys_of_machine()},
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
  return known_keys_in(document, *most) > 0 ? *most : kinds.back();
}

}  // namespace

FileKind file_kind(Value const& document) { return most_likely_kind(document).kind; }

void refuse_other_kind(Value const& document, FileKind due) {
  auto const& kinds = kinds_of_file();
  auto const& kind = most_likely_kind(document);
  auto const most = known_keys_in(document, kind);
  auto const as_many = std::count_if(kinds.begin(), kinds.end(),
                                     [&](auto const& other) { return known_keys_in(document, other) == most; });
  if (kind.kind == due || as_many > 1) return;
  throw FileError({document.where.file, 0, 0},
                  fmt::format("is {}; {} is due", kind.name, kinds[std::size_t(due)].name));
}

}  // namespace thermotwin::twin
