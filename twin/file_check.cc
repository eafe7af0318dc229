#include "twin/file_check.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <utility>

#include "scenarios/course.h"
#include "thermal/course_inputs.h"
#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "twin/campaign/campaign.h"
#include "twin/diagnosis/measured_data.h"
#include "twin/diagnosis/measured_run.h"
#include "twin/error_model_file.h"
#include "twin/experiment_file.h"
#include "twin/experiment_remarks.h"
#include "twin/file/shipped_file.h"
#include "twin/file/tables.h"
#include "twin/file_kind.h"
#include "twin/history.h"
#include "twin/implausible_values.h"
#include "twin/machine.h"
#include "twin/machine_remarks.h"
#include "twin/placement/candidate_sites.h"
#include "twin/study/study_runs.h"

namespace thermotwin::twin {
namespace {

constexpr double shortest_record = 60.0;  ///< in which a machine could warm [s]

/// InputError for what looks like a name, and is that of no file that comes with the program.
void refuse_unknown_name(std::filesystem::path const& file) {
  std::error_code ignored;
  if (file.has_extension() || file.has_parent_path() || std::filesystem::exists(file, ignored)) return;
  std::vector<std::string> names;
  for (auto const* folder : {"twin/machines", "scenarios/catalogue", "scenarios/studies", "scenarios/campaigns"})
    for (auto& name : shipped_names(folder)) names.push_back(std::move(name));
  throw thermal::InputError(
      fmt::format("{0}: there is no such file; {1}", file.string(), thermal::did_you_mean(file.string(), names)));
}

std::string counted(std::size_t count, std::string const& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// What the twin of an observer lacks is told where the model asks for it.
void check_observer(SavedErrorModel const& saved, Machine const& twin, std::filesystem::path const& file) {
  try {
    static_cast<void>(observer_of(saved, twin));
  } catch (thermal::InputError const& error) {
    auto const document = read_toml(file);
    auto const* model = document.find("model");
    throw about(model ? *model : document, error.what());
  }
}

std::string checked_error_model(std::filesystem::path const& file) {
  auto const saved = read_error_model(file);
  if (saved.twin) check_observer(saved, twin_of(*saved.twin), file);
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

/// Whether both messages begin with the same line and column of the same file.
bool is_of_place(std::string const& one, std::string const& other) {
  auto const place = one.substr(0, one.find(": ") + 1);
  return std::count(place.begin(), place.end(), ':') > 2 && other.starts_with(place);
}

struct CheckedMachine {
  std::filesystem::path file;
  Value document;
  Machine machine;

  /// By its own name, or by a file of the name of either.
  [[nodiscard]] bool is_called(std::string const& name) const {
    std::filesystem::path const named = name;
    return is_same_machine(machine.name, name) || file.filename() == named.filename() ||
           (named.extension() == ".toml" && is_same_machine(machine.name, named.stem().string()));
  }
};

struct CheckedExperiment {
  std::filesystem::path file;
  Value document;
  scenarios::Experiment experiment;
};

struct CheckedRecord {
  std::filesystem::path file;
  std::string machine;  ///< that the file names
  double lasts = 0.0;   ///< [s]
};

/// Time that was recorded in another unit.
void doubt_time(CheckedRecord const& record, std::vector<std::string>& warnings) {
  if (record.lasts < shortest_record)
    warnings.push_back(fmt::format("{}: the record lasts {:.3g} s in all; is its unit of time right?",
                                   record.file.string(), record.lasts));
}

std::string checked_study(std::filesystem::path const& file) {
  auto const study = read_study(file);
  check_worlds(study);
  auto const& description = study.description;
  auto const text =
      fmt::format("a study of {}, {} and {}", counted(description.worlds.size(), "world"),
                  counted(description.selections.size(), "selection"), counted(description.models.size(), "model"));
  if (description.also.empty()) return text;
  return text + fmt::format(", and {} beside them", counted(description.also.size(), "combination"));
}

class FileChecker {
 public:
  explicit FileChecker(std::vector<std::filesystem::path> const& files) : files_(files), checks_(files.size()) {
    for (std::size_t i = 0; i < files.size(); ++i) noting(checks_[i], [&] { read(files[i], i); });
  }
  std::vector<FileCheck> operator()();

 private:
  /// A mistake goes to the file's check; of what stands in its place no more is said.
  template <class Action>
  static void noting(FileCheck& check, Action action) {
    try {
      action();
    } catch (thermal::InputError const& error) {
      check.mistake = error.what();
      std::erase_if(check.warnings, [&](auto const& warning) { return is_of_place(warning, check.mistake); });
    }
  }
  void read(std::filesystem::path const& file, std::size_t i);
  void read_machine(std::filesystem::path const& file, Value const& document, FileCheck& check);
  void read_record(std::filesystem::path const& file, std::size_t i);
  void check_experiment(CheckedExperiment const& checked, FileCheck& check) const;
  [[nodiscard]] bool is_found_wrong(std::filesystem::path const& file) const;
  void check_record(CheckedRecord const& record, FileCheck& check) const;
  void check_candidates(CandidateRules const& rules, FileCheck& check) const;
  [[nodiscard]] CheckedMachine const* machine_among(std::string const& named) const;
  [[nodiscard]] CheckedMachine machine_for(CheckedExperiment const& checked) const;

  std::vector<std::filesystem::path> const& files_;
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
  refuse_unknown_name(file);
  Value const document = read_toml(file);
  switch (file_kind(document)) {
    case FileKind::experiment:
      experiments_.push_back({i, {file, document, read_experiment(document, file)}});
      check.warnings = implausible_values(document, list_fields<scenarios::Experiment>());
      return;
    case FileKind::campaign:
      check.text = checked_campaign(file);
      return;
    case FileKind::error_model:
      check.text = checked_error_model(file);
      return;
    case FileKind::study:
      check.text = checked_study(file);
      return;
    case FileKind::measurement:
      return read_record(file, i);
    case FileKind::candidates:
      candidates_.emplace_back(i, read_candidate_rules(file));
      return;
    case FileKind::machine:
    case FileKind::sensors:
      return read_machine(file, document, check);
  }
}

void FileChecker::read_machine(std::filesystem::path const& file, Value const& document, FileCheck& check) {
  auto const machine = Machine::build(document);
  check.warnings = machine_remarks(document, machine);
  check.text = fmt::format("the machine {}: {}, {}, {}, {}", machine.name,
                           counted(std::size_t(machine.network().nodes()), "node"),
                           counted(machine.network().parts().size(), "part"), counted(machine.sensors.size(), "sensor"),
                           counted(machine.displacements.size(), "displacement channel"));
  machines_.push_back({file, document, machine});
}

/// "5 inputs (spindle.speed changes 84 times)": of those that are held, as they are read.
std::string words_of_inputs(std::vector<scenarios::SampledInput> const& inputs) {
  std::vector<std::string> changing;
  for (auto const& input : inputs)
    if (auto const changes = scenarios::held_changes(input); changes && changes->count > 0)
      changing.push_back(fmt::format("{} changes {}{}", input.name, counted(changes->count, "time"),
                                     changes->averaged ? ", noise averaged" : ""));
  auto const count = counted(inputs.size(), "input");
  return changing.empty() ? count : fmt::format("{} ({})", count, fmt::join(changing, "; "));
}

void FileChecker::read_record(std::filesystem::path const& file, std::size_t i) {
  auto const data = read_measured_data(file);
  auto remarks = data.remarks;
  naming(file, [&] { static_cast<void>(channels_of(data, remarks)); });
  checks_[i].warnings = remarks_on(file, remarks);
  for (auto& remark : misspelt_inputs(data)) checks_[i].warnings.push_back(std::move(remark));
  CheckedRecord const record{file, data.machine, data.time[data.time.size() - 1]};
  doubt_time(record, checks_[i].warnings);
  checks_[i].text =
      fmt::format("a record of {:.2f} h: {}, {}, {}, {}", record.lasts / 3600.0,
                  counted(std::size_t(data.time.size()), "row"), words_of_inputs(data.inputs),
                  counted(data.readings.size(), "sensor"), counted(data.displacements.size(), "displacement channel"));
  records_.push_back({i, record});
}

/// The only one, or the one that is named; null where that is not among the files.
CheckedMachine const* FileChecker::machine_among(std::string const& named) const {
  if (machines_.size() == 1) return &machines_[0];
  auto const found =
      std::find_if(machines_.begin(), machines_.end(), [&](auto const& machine) { return machine.is_called(named); });
  return found == machines_.end() ? nullptr : &*found;
}

CheckedMachine FileChecker::machine_for(CheckedExperiment const& checked) const {
  if (auto const* machine = machine_among(checked.experiment.machine)) return *machine;
  auto const file = machine_of(checked.experiment, checked.file);
  Value const document = read_toml(file);
  return {file, document, Machine::build(document)};
}

/// Whether it is one of the files, and has a mistake that is told there.
bool FileChecker::is_found_wrong(std::filesystem::path const& file) const {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    std::error_code ignored;
    if (!checks_[i].mistake.empty() && std::filesystem::equivalent(files_[i], file, ignored)) return true;
  }
  return false;
}

void FileChecker::check_experiment(CheckedExperiment const& checked, FileCheck& check) const {
  auto const& named = checked.experiment.machine;
  if (is_found_wrong(checked.experiment.directory / named)) {
    check.text = fmt::format("an experiment of {:.2f} h, not looked at together with '{}', which has a mistake",
                             checked.experiment.duration / 3600.0, named);
    return;
  }
  auto const machine = machine_for(checked);
  if (!named.empty() && !machine.is_called(named))
    check.warnings.push_back(fmt::format("{}: it is an experiment of '{}', the machine file is '{}'",
                                         checked.file.string(), named, machine.machine.name));
  check_together(checked.document, checked.experiment, machine.document, machine.machine);
  auto const remarks = experiment_remarks(checked.document, checked.experiment, machine.machine);
  check.warnings.insert(check.warnings.end(), remarks.begin(), remarks.end());
  check.text =
      fmt::format("an experiment of {:.2f} h on {}", checked.experiment.duration / 3600.0, machine.machine.name);
}

void FileChecker::check_record(CheckedRecord const& record, FileCheck& check) const {
  auto const* machine = machine_among(record.machine);
  if (!machine) return;
  check.warnings = remarks_on(record.file, read_measured_run(record.file, machine->machine).remarks);
  doubt_time(record, check.warnings);
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

void check_together(Value const& experiment_document, scenarios::Experiment const& experiment,
                    Value const& machine_document, Machine const& machine) {
  std::optional<scenarios::ExperimentCourse> course;
  try {
    course.emplace(experiment, machine.limits);
    check_laser(machine, experiment);
  } catch (thermal::InputError const& error) {
    throw located_in(experiment_document, error);
  }
  try {
    thermal::CourseInputs const inputs(machine.network(), *course);
  } catch (thermal::InputError const& error) {
    std::string const what = error.what();
    throw FileError(place_of(machine_document, what.substr(0, what.find(';'))), what);  // not at what it offers
  }
}

}  // namespace thermotwin::twin
