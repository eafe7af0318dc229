#include "twin/file_check.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "scenarios/course.h"
#include "thermal/course_inputs.h"
#include "thermal/error.h"
#include "twin/campaign/campaign.h"
#include "twin/diagnosis/measured_data.h"
#include "twin/diagnosis/measured_run.h"
#include "twin/error_model_file.h"
#include "twin/experiment_file.h"
#include "twin/experiment_remarks.h"
#include "twin/file/document.h"
#include "twin/file/tables.h"
#include "twin/history.h"
#include "twin/machine.h"
#include "twin/placement/candidate_sites.h"
#include "twin/study/study_runs.h"
#include "twin/uncertain_range.h"

namespace thermotwin::twin {
namespace {

constexpr double rounding = 1e-9;  ///< of a bound that is written in another unit

/// The value, or those of the list.
std::vector<Value const*> items_of(Value const& value) {
  std::vector<Value const*> items;
  if (!value.is_list()) return {&value};
  for (auto const& item : std::get<Value::List>(value.content)) items.push_back(&item);
  return items;
}

/// In SI; none for what is no number.
std::optional<double> number_of(Value const& value, thermal::Dimension dimension) {
  Value const table{value.where, Value::Table{{"", value.where, value}}};
  return number_in(table, "", dimension);
}

void find_implausible(Value const& table, std::vector<FieldRecord> const& fields, std::vector<std::string>& found) {
  for (auto const& entry : std::get<Value::Table>(table.content)) {
    auto const field = std::find_if(fields.begin(), fields.end(), [&](auto const& f) { return f.key == entry.key; });
    if (field == fields.end()) continue;
    for (auto const* item : items_of(entry.value)) {
      if (item->is_table()) find_implausible(*item, field->nested, found);
      if (field->range.empty()) continue;
      auto const number = number_of(*item, field->dimension);
      auto const [low, high] = field->plausible;
      if (number && (*number < low - rounding * std::abs(low) || *number > high + rounding * std::abs(high)))
        found.push_back(fmt::format("{}: '{}' is {}; outside what is plausible: {}", item->where.text(), entry.key,
                                    item->text(), field->range));
    }
  }
}

/// Sensitivities may divide what is counted; a file may not.
void check_counts(Value const& machine) {
  for (auto const& [kind, where, value] : std::get<Value::Table>(machine.content))
    for (auto const* table : items_of(value)) {
      Value const* count = table->is_table() ? table->find("count") : nullptr;
      if (!count) continue;
      auto const number = number_of(*count, thermal::dimension::dimensionless);
      if (number && *number != std::round(*number))
        throw FileError(count->where, fmt::format("'count' is {}; a whole number is due", count->text()));
    }
}

/// All tables of a machine file, as the fields of one.
std::vector<FieldRecord> machine_fields() {
  std::vector<FieldRecord> fields;
  for (auto const& table : describe_machine())
    fields.push_back({table.name, "table", "", "", "", table.fields, {}, {}});
  return fields;
}

/// Those keys of a document that no file of another kind has.
bool has_any(Value const& document, std::initializer_list<char const*> keys) {
  return std::any_of(keys.begin(), keys.end(), [&](char const* key) { return document.find(key); });
}

std::string counted(std::size_t count, std::string const& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string checked_error_model(std::filesystem::path const& file) {
  auto const saved = read_error_model(file);
  if (saved.twin) static_cast<void>(twin_of(*saved.twin));
  return fmt::format("an error model: {} of {} [{}] on {}, fitted to {}", saved.method(), saved.error, saved.unit,
                     counted(saved.inputs().size(), "input"),
                     saved.runs.empty() ? "nobody knows what" : counted(saved.runs.size(), "run"));
}

std::string checked_campaign(std::filesystem::path const& file) {
  auto const campaign = Campaign::read(file);
  return fmt::format("a campaign of {} on {}", counted(std::size_t(campaign.runs()), "run"),
                     campaign.machine_file.stem().string());
}

std::vector<std::string> remarks_on(std::filesystem::path const& file, std::vector<std::string> remarks) {
  for (auto& remark : remarks) remark = file.string() + ": " + remark;
  return remarks;
}

struct CheckedMachine {
  std::filesystem::path file;
  Value document;
  Machine machine;
};

struct CheckedExperiment {
  std::filesystem::path file;
  Value document;
  scenarios::Experiment experiment;
};

struct CheckedRecord {
  std::filesystem::path file;
  std::string machine;  ///< that the file names
};

void check_together(CheckedExperiment const& checked, CheckedMachine const& machine) {
  std::optional<scenarios::ExperimentCourse> course;
  try {
    course.emplace(checked.experiment, machine.machine.limits);
    check_laser(machine.machine, checked.experiment);
  } catch (thermal::InputError const& error) {
    throw located_in(checked.document, error);
  }
  try {
    thermal::CourseInputs const inputs(machine.machine.network(), *course);
  } catch (thermal::InputError const& error) {
    throw FileError(place_of(machine.document, error.what()), error.what());
  }
}

std::string checked_study(std::filesystem::path const& file) {
  auto const study = read_study(file);
  check_worlds(study);
  auto const& description = study.description;
  return fmt::format("a study of {}, {} and {}", counted(description.worlds.size(), "world"),
                     counted(description.selections.size(), "selection"), counted(description.models.size(), "model"));
}

class FileChecker {
 public:
  explicit FileChecker(std::vector<std::filesystem::path> const& files) : checks_(files.size()) {
    for (std::size_t i = 0; i < files.size(); ++i) noting(checks_[i], [&] { read(files[i], i); });
  }
  std::vector<FileCheck> operator()();

 private:
  /// A mistake goes to the file's check.
  template <class Action>
  static void noting(FileCheck& check, Action action) {
    try {
      action();
    } catch (thermal::InputError const& error) {
      check.mistake = error.what();
    }
  }
  void read(std::filesystem::path const& file, std::size_t i);
  void read_machine(std::filesystem::path const& file, Value const& document, FileCheck& check);
  void read_record(std::filesystem::path const& file, std::size_t i);
  void check_experiment(CheckedExperiment const& checked, FileCheck& check) const;
  void check_record(CheckedRecord const& record, FileCheck& check) const;
  void check_candidates(CandidateRules const& rules, FileCheck& check) const;
  [[nodiscard]] CheckedMachine const* machine_among(std::string const& named) const;
  [[nodiscard]] CheckedMachine machine_for(CheckedExperiment const& checked) const;

  std::vector<FileCheck> checks_;
  std::vector<CheckedMachine> machines_;
  std::vector<std::pair<std::size_t, CheckedExperiment>> experiments_;
  std::vector<std::pair<std::size_t, CheckedRecord>> records_;
  std::vector<std::pair<std::size_t, CandidateRules>> candidates_;
};

void FileChecker::read(std::filesystem::path const& file, std::size_t i) {
  auto& check = checks_[i];
  auto const suffix = file.extension();
  if (suffix == ".h5" || suffix == ".csv") return read_record(file, i);
  Value const document = read_toml(file);
  if (document.find("duration")) {
    experiments_.push_back({i, {file, document, read_experiment(document, file)}});
    find_implausible(document, list_fields<scenarios::Experiment>(), check.warnings);
    return;
  }
  if (has_any(document, {"experiments", "grid", "latin_hypercube"}))
    check.text = checked_campaign(file);
  else if (has_any(document, {"predicts", "model"}))
    check.text = checked_error_model(file);
  else if (has_any(document, {"world", "selections", "models"}))
    check.text = checked_study(file);
  else if (has_any(document, {"table"}))
    read_record(file, i);
  else if (has_any(document, {"site", "body", "forbidden", "most", "budget"}))
    candidates_.emplace_back(i, read_candidate_rules(file));
  else
    read_machine(file, document, check);
}

void FileChecker::read_machine(std::filesystem::path const& file, Value const& document, FileCheck& check) {
  auto const machine = Machine::build(document);
  check_counts(document);
  static_cast<void>(ranged_numbers(document));
  find_implausible(document, machine_fields(), check.warnings);
  check.text = fmt::format("the machine {}: {} nodes, {} parts, {} sensors, {} displacement channels", machine.name,
                           machine.network().nodes(), machine.network().parts().size(), machine.sensors.size(),
                           machine.displacements.size());
  machines_.push_back({file, document, machine});
}

void FileChecker::read_record(std::filesystem::path const& file, std::size_t i) {
  auto const data = read_measured_data(file);
  auto remarks = data.remarks;
  static_cast<void>(channels_of(data, remarks));
  checks_[i].warnings = remarks_on(file, remarks);
  for (auto& remark : misspelt_inputs(data)) checks_[i].warnings.push_back(std::move(remark));
  checks_[i].text =
      fmt::format("a record of {:.2f} h: {}, {}, {}, {}", data.time[data.time.size() - 1] / 3600.0,
                  counted(std::size_t(data.time.size()), "row"), counted(data.inputs.size(), "input"),
                  counted(data.readings.size(), "sensor"), counted(data.displacements.size(), "displacement channel"));
  records_.push_back({i, {file, data.machine}});
}

/// The only one, or the one that is named; null where that is not among the files.
CheckedMachine const* FileChecker::machine_among(std::string const& named) const {
  if (machines_.size() == 1) return &machines_[0];
  auto const found = std::find_if(machines_.begin(), machines_.end(), [&](auto const& machine) {
    return machine.machine.name == named || machine.file.filename() == std::filesystem::path(named).filename();
  });
  return found == machines_.end() ? nullptr : &*found;
}

CheckedMachine FileChecker::machine_for(CheckedExperiment const& checked) const {
  if (auto const* machine = machine_among(checked.experiment.machine)) return *machine;
  auto const file = machine_of(checked.experiment, checked.file);
  Value const document = read_toml(file);
  return {file, document, Machine::build(document)};
}

void FileChecker::check_experiment(CheckedExperiment const& checked, FileCheck& check) const {
  auto const machine = machine_for(checked);
  check_together(checked, machine);
  auto const remarks = experiment_remarks(checked.document, checked.experiment, machine.machine);
  check.warnings.insert(check.warnings.end(), remarks.begin(), remarks.end());
  check.text =
      fmt::format("an experiment of {:.2f} h on {}", checked.experiment.duration / 3600.0, machine.machine.name);
}

void FileChecker::check_record(CheckedRecord const& record, FileCheck& check) const {
  auto const* machine = machine_among(record.machine);
  if (!machine) return;
  check.warnings = remarks_on(record.file, read_measured_run(record.file, machine->machine).remarks);
  check.text += ", on " + machine->machine.name;
}

void FileChecker::check_candidates(CandidateRules const& rules, FileCheck& check) const {
  std::string const sites =
      rules.sites.empty() ? fmt::format("a mesh of {} at most", rules.most) : counted(rules.sites.size(), "site");
  if (machines_.size() != 1) {
    check.text =
        fmt::format("candidates of a placement: {}; name a machine beside it to see whether it has them", sites);
    return;
  }
  auto const& machine = machines_[0];
  check.text = fmt::format("candidates of a placement: {}; on {} {}", sites, machine.machine.name,
                           counted(candidate_sites(machine.document, rules).size(), "site"));
}

std::vector<FileCheck> FileChecker::operator()() {
  for (auto const& [i, checked] : experiments_)
    noting(checks_[i], [&, &check = checks_[i], &checked = checked] { check_experiment(checked, check); });
  for (auto const& [i, record] : records_)
    noting(checks_[i], [&, &check = checks_[i], &record = record] { check_record(record, check); });
  for (auto const& [i, rules] : candidates_)
    noting(checks_[i], [&, &check = checks_[i], &rules = rules] { check_candidates(rules, check); });
  return std::move(checks_);
}

}  // namespace

std::filesystem::path file_to_check(std::string const& name_or_path) {
  for (auto const& file_of : {machine_file, experiment_file, study_file, campaign_file}) try {
      return file_of(name_or_path);
    } catch (thermal::InputError const&) {
      continue;  // no name of this kind
    }
  return name_or_path;
}

std::vector<FileCheck> check_files(std::vector<std::filesystem::path> const& files) { return FileChecker(files)(); }

}  // namespace thermotwin::twin
