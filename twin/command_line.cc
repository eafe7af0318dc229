// The only file that knows CLI11.
#include "twin/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <fmt/format.h>
#include <iostream>

#include "output/atomic_file.h"
#include "output/csv.h"
#include "output/dataset_file.h"
#include "output/error.h"
#include "thermal/error.h"
#include "twin/challenge/challenge.h"
#include "twin/checkpoint.h"
#include "twin/command_line_campaign.h"
#include "twin/command_line_compensate.h"
#include "twin/command_line_difference.h"
#include "twin/command_line_error_model.h"
#include "twin/command_line_figure.h"
#include "twin/command_line_mistake.h"
#include "twin/command_line_place.h"
#include "twin/command_line_study.h"
#include "twin/command_line_view.h"
#include "twin/command_line_volumetric.h"
#include "twin/diagnosis/calibration.h"
#include "twin/diagnosis/comparison.h"
#include "twin/diagnosis/diagnose_files.h"
#include "twin/diagnosis/plan.h"
#include "twin/effect_page.h"
#include "twin/experiment_file.h"
#include "twin/file/output_path.h"
#include "twin/file_check.h"
#include "twin/needed_solution.h"
#include "twin/progress.h"
#include "twin/progress_file.h"
#include "twin/reduced_summary.h"
#include "twin/reduction_store.h"
#include "twin/replay.h"
#include "twin/report/report_files.h"
#include "twin/run.h"
#include "twin/setting.h"
#include "twin/summary.h"
#include "twin/version.h"

namespace thermotwin::twin {
namespace {

std::atomic<bool> stop_requested = false;

constexpr double finest_tolerance = 1e-12, coarsest_tolerance = 0.01;

int fail(int code, std::string_view message) {
  fmt::print(stderr, "thermotwin: {}\n", message);
  return code;
}

struct RunCommand {
  std::string experiment, machine, dataset, fields, picture, field_interval = "15 min", checkpoint;
  std::vector<std::string> settings;
  double tolerance = 1e-6;
  bool nodes = false, json = false, quiet = false, resume = false, reduced = false;

  void add_to(CLI::App& app);
  void operator()() const;

 private:
  void check_outputs(std::filesystem::path const& machine_path, std::filesystem::path const& experiment_path,
                     scenarios::Experiment const& programme) const;
  void set_checkpoint(RunOptions& options) const;
  void run_reduced(Machine const& machine, scenarios::Experiment const& programme, RunOptions const& options) const;
};

void RunCommand::add_to(CLI::App& app) {
  auto* command = app.add_subcommand("run", "run an experiment on a machine");
  command->add_option("experiment", experiment, "experiment file, or the name of one of the catalogue")->required();
  command->add_option("--machine,-m", machine, "machine file or name; default: the one that the experiment names");
  command->add_option("--output,-o", dataset, "data set to write (HDF5)");
  command->add_option("--fields", fields, "folder for the fields (VTK), one frame per --field-interval");
  command->add_option("--field-interval", field_interval, "time between two frames")->capture_default_str();
  command->add_option("--picture", picture, "PNG of the last frame; needs a display, or xvfb-run");
  command->add_option("--set", settings,
                      "change a parameter: bearing.front.grease_factor=0.8, experiment.duration=\"2 h\"");
  command->add_option("--tolerance", tolerance, "relative tolerance of the integration")->capture_default_str();
  command->add_option("--checkpoint", checkpoint,
                      "simulated time after which a killed run can be taken up: \"2 h\"; needs --output");
  command->add_flag("--resume", resume, "go on from the checkpoint beside the output");
  command->add_flag("--nodes", nodes, "keep every node's temperature in the data set");
  command->add_flag("--reduced", reduced, "through a reduced model of the machine, with a bound of what it errs by");
  command->add_flag("--json", json, "print the summary as JSON");
  command->add_flag("--quiet,-q", quiet, "print nothing but errors");
  command->callback([this] { (*this)(); });
}

void RunCommand::check_outputs(std::filesystem::path const& machine_path, std::filesystem::path const& experiment_path,
                               scenarios::Experiment const& programme) const {
  check_suffix(dataset, "a data set", {".h5"});
  check_suffix(picture, "a picture", {".png"});
  std::vector<std::filesystem::path> read = {experiment_path};
  for (auto const& recording : programme.recorded)
    read.push_back(scenarios::resolved_path(recording.file, programme.directory));
  for (auto const& output : {dataset, picture}) refuse_to_overwrite(output, machine_path, read);
}

void RunCommand::set_checkpoint(RunOptions& options) const {
  if (checkpoint.empty() && !resume) return;
  if (dataset.empty()) throw thermal::InputError("--checkpoint and --resume stand beside the output; give --output");
  options.checkpoint = dataset + ".checkpoint";
  options.resume = resume;
  options.checkpoint_interval = checkpoint.empty() ? checkpoint_interval(*options.checkpoint)
                                                   : thermal::parse_value(checkpoint, thermal::dimension::time);
  if (options.checkpoint_interval <= 0.0) throw thermal::InputError("--checkpoint is a time above 0");
}

void RunCommand::run_reduced(Machine const& machine, scenarios::Experiment const& programme,
                             RunOptions const& options) const {
  if (options.fields || options.picture || options.node_temperatures || options.checkpoint)
    throw thermal::InputError("--reduced gives readings and displacements: no fields, picture, nodes or checkpoint");
  ReducedTwin const twin(machine, {}, cache_folder());
  auto result = twin.run(programme);
  for (auto const& [key, text] : options.provenance) result.dataset.provenance[key] = text;
  if (options.dataset) output::write(result.dataset, *options.dataset);
  if (!quiet) fmt::print("{}", reduced_table(twin, result));
}

void RunCommand::operator()() const {
  if (!(tolerance >= finest_tolerance && tolerance <= coarsest_tolerance))
    throw thermal::InputError(
        fmt::format("--tolerance {}: allowed is {} to {}", tolerance, finest_tolerance, coarsest_tolerance));
  auto const experiment_path = experiment_file(experiment);
  Value experiment_document = read_toml(experiment_path);
  Value machine_document{{}, Value::Table{}};
  auto const preliminary = read_experiment(experiment_document, experiment_path);
  auto const path = machine.empty() ? machine_of(preliminary, experiment_path) : machine_file(machine);
  machine_document = read_toml(path);
  for (auto const& text : settings) apply(setting(text), machine_document, experiment_document);
  auto const programme = read_experiment(experiment_document, experiment_path);
  check_outputs(path, experiment_path, programme);
  Machine const built = Machine::build(machine_document);

  RunOptions options;
  options.integration.relative_tolerance = tolerance;
  options.integration.absolute_tolerance = tolerance;
  if (!dataset.empty()) options.dataset = dataset;
  if (!fields.empty()) options.fields = fields;
  if (!picture.empty()) options.picture = picture;
  options.field_interval = thermal::parse_value(field_interval, thermal::dimension::time);
  options.node_temperatures = nodes;
  options.provenance = origin(path, experiment_path, fmt::format("{}", fmt::join(settings, "\n")), programme);
  set_checkpoint(options);
  if (reduced) {
    try {
      return run_reduced(built, programme, options);
    } catch (FileError const&) {
      throw;
    } catch (thermal::InputError const& error) {
      throw located_in(experiment_document, error);
    }
  }
  options.stop = &stop_requested;
  std::optional<Progress> progress;
  if (!quiet) {
    progress.emplace(fmt::format("{} on {}", experiment_path.stem().string(), built.name));
    options.progress = [&](double share) { progress->show(share); };
  }
  auto const result = [&] {
    try {
      return run(built, programme, options);
    } catch (FileError const&) {
      throw;
    } catch (thermal::InputError const& error) {
      throw located_in(experiment_document, error);
    }
  }();
  progress.reset();
  if (json)
    fmt::print("{}", summary_json(built, result));
  else if (!quiet)
    fmt::print("{}", summary_table(built, result));
}

/// Ends the program with 2 when there is a mistake in one of the files.
void print_checks(std::vector<std::filesystem::path> const& files) {
  auto const checks = check_files(files);
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (auto const& warning : checks[i].warnings) fmt::print("warning: {}\n", warning);
    if (checks[i].mistake.empty())
      fmt::print("{}: {}; no mistake found\n", files[i].string(), checks[i].text);
    else
      fail(2, checks[i].mistake);
  }
  bool const right = std::all_of(checks.begin(), checks.end(), [](auto const& check) { return check.mistake.empty(); });
  if (!right) throw CLI::RuntimeError(2);
}

void describe(std::string const& what) {
  if (what == "experiment") {
    fmt::print("{}", table_page({"experiment", "what a machine is put through; the keys of its file",
                                 list_fields<scenarios::Experiment>()}));
    return;
  }
  for (auto const& table : describe_machine()) fmt::print("{}\n", table_page(table));
}

void add_challenge_command(CLI::App& app) {
  auto* command = app.add_subcommand("challenge",
                                     "write measurements in which an effect is hidden, and the truth in a sealed file");
  auto options = std::make_shared<ChallengeOptions>();
  auto folder = std::make_shared<std::string>(), kind = std::make_shared<std::string>();
  auto further = std::make_shared<std::string>();
  command->add_option("--machine,-m", options->machine, "the nominal machine, file or name")->capture_default_str();
  command->add_option("--seed", options->seed, "the same seed draws the same challenge")->capture_default_str();
  command->add_option("--kind", *kind, "one, none, outside, two or sensor; default: what the seed stands for");
  auto* to = command->add_option_group("to");
  to->add_option("--output,-o", *folder, "folder to write; it must be empty or absent");
  auto key = std::make_shared<bool>(false);
  to->add_flag("--key", *key, "write nothing, and print what would be hidden");
  to->require_option(1);
  command->add_option("--run", *further, "experiment file: one more run of the challenge that is in the folder");
  command->callback([options, folder, kind, further, key] {
    options->folder = *folder;
    if (!further->empty()) options->further_run = *further;
    if (!kind->empty()) options->kind = case_kind(*kind);
    fmt::print("{}", *key ? challenge_key(*options) : write_challenge(*options));
  });
}

void add_other_commands(CLI::App& app) {
  auto* describe_command = app.add_subcommand("describe", "print every key of a machine or experiment file");
  auto what = std::make_shared<std::string>();
  describe_command->add_option("what", *what, "machine or experiment")
      ->required()
      ->check(CLI::IsMember({"machine", "experiment"}));
  describe_command->callback([what] { describe(*what); });

  auto* check_command = app.add_subcommand("check", "look for mistakes in machine and experiment files");
  auto files = std::make_shared<std::vector<std::filesystem::path>>();
  check_command->add_option("files", *files, "files; an experiment is checked together with a machine among them")
      ->required();
  check_command->callback([files] { print_checks(*files); });

  auto* effects_command = app.add_subcommand("effects", "list the effects that the twin knows, or show one");
  auto name = std::make_shared<std::string>();
  auto markdown = std::make_shared<bool>(false);
  effects_command->add_option("name", *name, "of an effect");
  effects_command->add_flag("--markdown", *markdown, "all pages, for the documentation");
  effects_command->callback([name, markdown] {
    if (*markdown)
      fmt::print("{}", effects_markdown());
    else
      fmt::print("{}", name->empty() ? effect_list() : effect_page(effect(*name)));
  });

  auto* export_command = app.add_subcommand("export", "write a data set as CSV");
  auto input = std::make_shared<std::string>(), output = std::make_shared<std::string>();
  auto groups = std::make_shared<output::CsvGroups>();
  export_command->add_option("dataset", *input, "data set (HDF5)")->required();
  export_command->add_option("--output,-o", *output, "CSV file; default: standard output");
  export_command->add_flag("--truth", groups->truth, "noise-free readings and displacements, too");
  export_command->add_flag("--heat", groups->heat, "heat of every part, too");
  export_command->callback([input, output, groups] {
    check_suffix(*output, "a table", {".csv"});
    refuse_to_overwrite(*output, {}, {*input});
    auto const data = output::read(*input);
    if (output->empty())
      output::export_csv(data, std::cout, *groups);
    else
      output::export_csv(data, std::filesystem::path(*output), *groups);
  });

  auto* weights_command =
      app.add_subcommand("weights", "compute the influence weights of a machine's blocks with CalculiX");
  auto machine = std::make_shared<std::string>();
  weights_command->add_option("machine", *machine, "machine file")->required();
  weights_command->callback([machine] {
    int const solved = write_weights(machine_file(*machine), std::cerr);
    fmt::print("{} solved; the others were there already\n", solved);
  });
}

void add_calibrate_command(CLI::App& app) {
  auto* command = app.add_subcommand("calibrate", "fit the uncertain numbers of a machine to measurements");
  auto files = std::make_shared<CalibrateFiles>();
  auto json = std::make_shared<bool>(false);
  auto machine = std::make_shared<std::string>();
  command->add_option("machine", *machine, "machine file or name")->required();
  command->add_option("data", files->data, "measured runs: .h5, .csv, or a measurement file .toml")->required();
  command->add_option("--output,-o", files->output, "machine file to write: the same with the numbers identified");
  command->add_flag("--json", *json, "print everything as JSON");
  command->callback([files, json, machine] {
    files->machine = machine_file(*machine);
    check_suffix(files->output, "a machine", {".toml"});
    auto const calibration = calibrate_files(*files);
    fmt::print("{}", *json ? calibration_json(calibration) : calibration_table(calibration));
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

void add_replay_command(CLI::App& app) {
  auto* command = app.add_subcommand("replay", "make a run anew from its own output, and compare byte for byte");
  auto file = std::make_shared<std::string>(), kept = std::make_shared<std::string>();
  command->add_option("dataset", *file, "data set of a run (HDF5)")->required();
  command->add_option("--output,-o", *kept, "keep the new data set");
  command->callback([file, kept] {
    check_suffix(*kept, "a data set", {".h5"});
    refuse_to_overwrite(*kept, {}, {*file});
    std::optional<Progress> progress(*file);
    auto const made = replay(
        *file, *kept, [&](double share) { progress->show(share); }, &stop_requested);
    progress.reset();
    if (!made.same_bytes) throw std::runtime_error(made.text);
    fmt::print("{}", made.text);
  });
}

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

void add_diagnose_command(CLI::App& app) {
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
  command->add_option("--without", files->without, "effects that are not to be tried")->delimiter(',');
  auto folder = std::make_shared<std::string>();
  auto* page =
      command->add_option("--report", *folder, "folder for a page to look at (report.html) and diagnosis.json");
  command->add_flag("--json", *json, "print everything as JSON");
  auto planned = std::make_shared<std::vector<std::string>>();
  auto* plans =
      command->add_option("--plan", *planned,
                          "before any data: what these experiments (files or names) would show of each effect, "
                          "which could be taken for each other, and what would tell them apart");
  for (auto* other : {data, unseen, amended, page}) plans->excludes(other);
  command->callback([files, json, machine, planned, data, folder] {
    files->machine = machine_file(*machine);
    check_suffix(files->output, "a machine", {".toml"});
    for (auto const& name : files->without) static_cast<void>(effect(name));
    if (!*json) files->progress = [](std::string const& what) { fmt::print(stderr, "{} …\n", what); };
    if (!planned->empty()) return print_plan(*files, *planned, *json);
    if (data->empty()) throw thermal::InputError("diagnose needs measured runs, or --plan with experiments");
    std::optional<ProgressFile> onlookers;
    if (!folder->empty()) {
      output::require_empty(*folder);
      onlookers.emplace(*folder, fmt::format("Diagnosis of {}", files->machine.stem().string()));
      files->progress = [&onlookers, told = files->progress](std::string const& what) {
        onlookers->show(what);
        if (told) told(what);
      };
    }
    auto const report = diagnose_files(*files);
    onlookers.reset();
    if (!folder->empty()) write_folder(*folder, *files, report);
    fmt::print("{}", *json ? report_json(report) : report_text(report));
  });
}

void add_report_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "report", "one page to look at: machine, courses, residuals, diagnosis, study, placement, volume");
  auto files = std::make_shared<ReportFiles>();
  auto machine = std::make_shared<std::string>();
  command->add_option("data", files->data, "data sets .h5, .csv, measurement files .toml, answers of commands .json")
      ->required();
  command->add_option("--output,-o", files->output, "page to write (HTML)")->required();
  command->add_option("--machine,-m", *machine, "machine to draw, file or name; default: the one in a data set");
  command->callback([files, machine] {
    if (!machine->empty()) files->machine = machine_file(*machine);
    check_suffix(files->output, "a page", {".html"});
    fmt::print("{}", write_report(*files));
  });
}

/// Commands that go on for long end in good order when they are told to; the others end at once and have written
/// nothing.
void heed_signals(CLI::App& app) {
  for (char const* name : {"run", "replay", "campaign", "place", "study", "compensate", "play", "view"})
    app.get_subcommand(name)->preparse_callback([](std::size_t) {
      std::signal(SIGINT, [](int) { stop_requested = true; });
      std::signal(SIGTERM, [](int) { stop_requested = true; });
    });
}

/// CLI11 would take -1 for 18446744073709551615.
void refuse_negative_seeds(CLI::App& app) {
  for (auto* command : app.get_subcommands({}))
    if (auto* seed = command->get_option_no_throw("--seed"))
      seed->check([](std::string const& text) {
        return text.starts_with('-') ? fmt::format("{} is negative; a whole number from 0 on is due", text) : "";
      });
}

/// The words of the command line, last one first, as CLI11 takes them; `help run` is `run --help`.
std::vector<std::string> reversed_words(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words[0] == "help") {
    words.erase(words.begin());
    words.emplace_back("--help");
  }
  std::reverse(words.begin(), words.end());
  return words;
}

}  // namespace

int command_line(int argc, char** argv) {
  CLI::App app("ThermoTwin: thermal digital twin of a machine tool, and generator of virtual experiments",
               "thermotwin");
  app.set_version_flag("--version,-v", fmt::format("thermotwin {} ({})", version(), commit()));
  app.require_subcommand(1);
  RunCommand run_command;
  run_command.add_to(app);
  add_other_commands(app);
  add_calibrate_command(app);
  add_diagnose_command(app);
  add_compare_command(app);
  add_replay_command(app);
  add_campaign_command(app, stop_requested);
  add_challenge_command(app);
  add_volumetric_command(app);
  add_place_command(app, stop_requested);
  add_study_command(app, stop_requested);
  add_error_model_commands(app);
  add_compensation_commands(app, stop_requested);
  add_report_command(app);
  add_difference_command(app);
  add_figure_command(app);
  add_view_command(app, stop_requested);
  heed_signals(app);
  refuse_negative_seeds(app);
  try {
    app.parse(reversed_words(argc, argv));
    return 0;
  } catch (CLI::ParseError const& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    if (dynamic_cast<CLI::RuntimeError const*>(&error)) return error.get_exit_code();  // all is said
    return fail(2, command_line_mistake(app, error));
  } catch (Interrupted const& error) {
    return fail(130, error.what());
  } catch (thermal::InputError const& error) {
    return fail(2, error.what());
  } catch (output::OutputError const& error) {
    return fail(2, error.what());
  } catch (std::exception const& error) {
    return fail(1, error.what());
  }
}

}  // namespace thermotwin::twin
