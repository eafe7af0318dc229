#include "twin/command_line_diagnose.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <optional>

#include "output/atomic_file.h"
#include "thermal/error.h"
#include "twin/challenge/challenge.h"
#include "twin/command_line_list.h"
#include "twin/diagnosis/calibration.h"
#include "twin/diagnosis/comparison.h"
#include "twin/diagnosis/diagnose_files.h"
#include "twin/diagnosis/diagnosis_json.h"
#include "twin/diagnosis/plan.h"
#include "twin/experiment_file.h"
#include "twin/file/output_path.h"
#include "twin/machine.h"
#include "twin/progress.h"
#include "twin/progress_file.h"
#include "twin/report/report_files.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

/// How a long search goes, for people (not with --json), who may stop it.
class SearchWatch {
 public:
  SearchWatch(bool tells, std::atomic<bool> const& stop)
      : narration_(tells ? std::make_shared<Narration>() : nullptr), stop_(&stop) {}

  [[nodiscard]] std::function<void(std::string const&)> stages() const {
    return [*this](std::string const& what) {
      heed_stop();
      if (narration_) narration_->begin(what);
    };
  }
  [[nodiscard]] FitWatch steps() const {
    return [*this](int step, double misfit) {
      heed_stop();
      if (narration_) narration_->go_on(fmt::format("step {} of a fit, misfit {:.3g}", step, misfit));
    };
  }

 private:
  void heed_stop() const {
    if (*stop_) throw Interrupted("stopped; nothing was written");
  }

  std::shared_ptr<Narration> narration_;
  std::atomic<bool> const* stop_;
};

void print_plan(DiagnoseFiles const& files, std::vector<std::string> const& experiments, bool json) {
  std::vector<Schedule> schedules;
  for (auto const& name : experiments) schedules.push_back(read_schedule(experiment_file(name)));
  auto const made = plan(read_toml(files.machine), schedules, {.without = files.without, .progress = files.progress});
  fmt::print("{}", json ? plan_json(made) : plan_text(made));
}

void write_folder(std::filesystem::path const& folder, DiagnoseFiles const& files, DiagnosisReport const& report) {
  output::make_directory(folder);
  output::write_atomically(folder / "diagnosis.json", report_json(report));
  ReportFiles page{files.data, files.machine, folder / "report.html"};
  page.data.insert(page.data.end(), files.held_out.begin(), files.held_out.end());
  page.data.push_back(folder / "diagnosis.json");
  static_cast<void>(write_report(page));
}

}  // namespace

void add_calibrate_command(CLI::App& app, std::atomic<bool> const& stop) {
  auto* command = app.add_subcommand("calibrate", "fit the uncertain numbers of a machine to measurements");
  auto files = std::make_shared<CalibrateFiles>();
  auto json = std::make_shared<bool>(false);
  auto machine = std::make_shared<std::string>();
  command->add_option("machine", *machine, "machine file or name")->required();
  command->add_option("data", files->data, "measured runs: .h5, .csv, or a measurement file .toml")->required();
  command->add_option("--output,-o", files->output, "machine file to write: the same with the numbers identified");
  command->add_flag("--json", *json, "print everything as JSON");
  command->callback([files, json, machine, &stop] {
    files->machine = machine_file(*machine);
    check_machine_suffix(files->output);
    files->watch = SearchWatch(!*json, stop).steps();
    files->show = [json](Calibration const& calibration) {
      fmt::print("{}", *json ? calibration_json(calibration) : calibration_table(calibration));
    };
    static_cast<void>(calibrate_files(*files));
  });
}

void add_diagnose_command(CLI::App& app, std::atomic<bool> const& stop) {
  auto* command =
      app.add_subcommand("diagnose", "find where machine and measurement disagree, and name what is missing");
  auto files = std::make_shared<DiagnoseFiles>();
  auto json = std::make_shared<bool>(false);
  auto machine = std::make_shared<std::string>();
  command->add_option("machine", *machine, "machine file or name")->required();
  auto* data = command->add_option("data", files->data, "measured runs: .h5, .csv, or a measurement file .toml");
  auto* unseen = command->add_option("--hold-out", files->held_out, "runs that take no part in the fit");
  auto* amended =
      command->add_option("--output,-o", files->output, "machine file to write: the same with what was missing");
  take_list(*command->add_option("--without", files->without, "effects that are not to be tried: heat,radiation"));
  auto* start =
      command->add_option("--start", files->start,
                          "seed: begin the search from numbers drawn from their priors; the verdict must be the same");
  auto folder = std::make_shared<std::string>();
  auto* page =
      command->add_option("--report", *folder, "folder for a page to look at (report.html) and diagnosis.json");
  command->add_flag("--json", *json, "print everything as JSON");
  auto planned = std::make_shared<std::vector<std::string>>();
  auto* plans =
      command->add_option("--plan", *planned,
                          "before any data: what these experiments (files or names) would show of each effect, "
                          "which could be taken for each other, and what would tell them apart");
  for (auto* other : {data, unseen, amended, start, page}) plans->excludes(other);
  command->callback([files, json, machine, planned, data, folder, &stop] {
    files->machine = machine_file(*machine);
    check_machine_suffix(files->output);
    for (auto const& name : files->without) static_cast<void>(effect(name));
    SearchWatch const watch(!*json, stop);
    files->progress = watch.stages();
    files->watch = watch.steps();
    if (!planned->empty()) return print_plan(*files, *planned, *json);
    if (data->empty())
      throw thermal::InputError(files->held_out.empty() ? "diagnose needs measured runs, or --plan with experiments"
                                                        : "diagnose needs measured runs, and --hold-out took all words "
                                                          "up to the next option: name them before it");
    std::optional<ProgressFile> onlookers;
    if (!folder->empty()) {
      onlookers.emplace(*folder, fmt::format("Diagnosis of {}", files->machine.stem().string()));
      files->progress = [&onlookers, told = files->progress](std::string const& what) {
        onlookers->show(what);
        told(what);
      };
    }
    files->show = [&, json](DiagnosisReport const& report) {
      onlookers.reset();
      fmt::print("{}", *json ? report_json(report) : report_text(report));
      std::fflush(stdout);  // whether or not there is room for what is written
    };
    auto const report = told_if_stopped(onlookers, [&] { return diagnose_files(*files); });
    if (!folder->empty()) write_folder(*folder, *files, report);
  });
}

void add_compare_command(CLI::App& app) {
  auto* command = app.add_subcommand("compare", "two machines against the same measurements, side by side");
  auto before = std::make_shared<std::string>(), after = std::make_shared<std::string>();
  auto data = std::make_shared<std::vector<std::filesystem::path>>();
  auto json = std::make_shared<bool>(false);
  command->add_option("machine", *before, "machine file or name")->required();
  command->add_option("amended", *after, "the other one")->required();
  command->add_option("data", *data, "measured runs: .h5, .csv, or a measurement file .toml")->required();
  command->add_flag("--json", *json, "print everything as JSON");
  command->callback([before, after, data, json] {
    auto const comparison = compare_files(machine_file(*before), machine_file(*after), *data);
    fmt::print("{}", *json ? comparison_json(comparison) : comparison_table(comparison));
  });
}

void add_challenge_command(CLI::App& app) {
  auto* command = app.add_subcommand("challenge",
                                     "write measurements in which an effect is hidden, and the truth in a sealed file");
  auto options = std::make_shared<ChallengeOptions>();
  auto folder = std::make_shared<std::string>(), kind = std::make_shared<std::string>();
  auto further = std::make_shared<std::string>();
  command->add_option("--machine,-m", options->machine,
                      "the nominal machine, file or name; default: v450, with --run the folder's");
  command->add_option("--seed", options->seed,
                      "the same seed draws the same challenge; default: 1, with --run the folder's");
  command->add_option("--kind", *kind, "one, none, outside, two or sensor; default: what the seed stands for");
  auto* to = command->add_option_group("to");
  to->add_option("--output,-o", *folder, "folder to write; it must be empty or absent");
  auto key = std::make_shared<bool>(false);
  auto* sealed = to->add_flag("--key", *key, "write nothing, and print what would be hidden");
  to->require_option(1);
  command
      ->add_option("--run", *further,
                   "experiment file, or the name of a shipped one: one more run of the challenge that is in the folder")
      ->excludes(sealed);
  command->callback([options, folder, kind, further, key] {
    options->folder = *folder;
    if (!further->empty()) options->further_run = experiment_file(*further);
    if (!kind->empty()) options->kind = case_kind(*kind);
    fmt::print("{}", *key ? challenge_key(*options) : write_challenge(*options));
  });
}

}  // namespace thermotwin::twin
