#include "twin/command_line_run.h"

#include <CLI/CLI.hpp>
#include <csignal>
#include <fmt/format.h>
#include <memory>

#include "output/atomic_file.h"
#include "output/dataset_file.h"
#include "thermal/error.h"
#include "twin/checkpoint.h"
#include "twin/command_line_number.h"
#include "twin/experiment_file.h"
#include "twin/experiment_remarks.h"
#include "twin/file/output_path.h"
#include "twin/file_check.h"
#include "twin/progress.h"
#include "twin/reduced_summary.h"
#include "twin/reduction_store.h"
#include "twin/replay.h"
#include "twin/run.h"
#include "twin/setting.h"
#include "twin/summary.h"
#include "twin/uncertain_range.h"

namespace thermotwin::twin {
namespace {

struct RunCommand {
  std::string experiment, machine, dataset, fields, picture, field_interval = "15 min", checkpoint;
  std::vector<std::string> settings;
  double tolerance = 1e-6;
  bool nodes = false, json = false, quiet = false, resume = false, reduced = false;

  void add_to(CLI::App& command);
  void operator()(std::atomic<bool> const& stop) const;

 private:
  void check_outputs(std::filesystem::path const& machine_path, std::filesystem::path const& experiment_path,
                     scenarios::Experiment const& programme) const;
  void set_checkpoint(RunOptions& options) const;
  void run_reduced(Machine const& machine, scenarios::Experiment const& programme, RunOptions const& options) const;
};

void RunCommand::add_to(CLI::App& command) {
  command.add_option("experiment", experiment, "experiment file, or the name of one of the catalogue")->required();
  command.add_option("--machine,-m", machine, "machine file or name; default: the one that the experiment names");
  command.add_option("--output,-o", dataset, "data set to write (HDF5)");
  command.add_option("--fields", fields,
                     "folder for the fields (VTK), empty or absent; one frame per --field-interval");
  command.add_option("--field-interval", field_interval, "time between two frames")->capture_default_str();
  command.add_option("--picture", picture, "PNG of the last frame; needs a display, or xvfb-run");
  command
      .add_option("--set", settings,
                  "change a parameter: bearing.front.grease_factor=0.8, experiment.duration=\"2 h\"; once for each")
      ->allow_extra_args(false);
  command.add_option("--tolerance", tolerance, "relative tolerance of the integration; --reduced has its own")
      ->capture_default_str()
      ->check(number_between(finest_tolerance, coarsest_tolerance));
  command.add_option("--checkpoint", checkpoint,
                     "simulated time after which a killed run can be taken up: \"2 h\"; needs --output");
  command.add_flag("--resume", resume, "go on from the checkpoint beside the output");
  command.add_flag("--nodes", nodes, "keep every node's temperature in the data set");
  command.add_flag("--reduced", reduced, "through a reduced model of the machine, with a bound of what it errs by");
  command.add_flag("--json", json, "print the summary as JSON");
  command.add_flag("--quiet,-q", quiet, "print nothing but errors");
}

void RunCommand::check_outputs(std::filesystem::path const& machine_path, std::filesystem::path const& experiment_path,
                               scenarios::Experiment const& programme) const {
  check_suffix(dataset, "a data set", {".h5"});
  std::vector<std::filesystem::path> read = {experiment_path};
  for (auto const& recording : programme.recorded)
    read.push_back(scenarios::resolved_path(recording.file, programme.directory));
  for (auto const& output : {dataset, picture}) refuse_to_overwrite(output, machine_path, read, fields);
  refuse_to_replace_other_than_run(dataset);
  check_picture(picture);
  if (!fields.empty() && !resume) output::require_empty(fields);
}

void RunCommand::set_checkpoint(RunOptions& options) const {
  if (checkpoint.empty() && !resume) return;
  if (dataset.empty()) throw thermal::InputError("--checkpoint and --resume stand beside the output; give --output");
  if (resume) refuse_to_resume_finished(dataset);
  options.checkpoint = checkpoint_of(dataset);
  options.resume = resume;
  options.checkpoint_interval = checkpoint.empty()
                                    ? checkpoint_interval(*options.checkpoint)
                                    : positive_quantity("--checkpoint", checkpoint, thermal::dimension::time);
}

void RunCommand::run_reduced(Machine const& machine, scenarios::Experiment const& programme,
                             RunOptions const& options) const {
  if (options.fields || options.picture || options.node_temperatures || options.checkpoint)
    throw thermal::InputError("--reduced gives readings and displacements: no fields, picture, nodes or checkpoint");
  std::function<void(std::string const&)> progress;
  if (!quiet) progress = [](std::string const& what) { tell(what + " …\n"); };
  ReducedTwin const twin(machine, {}, cache_folder(), progress);
  auto result = twin.run(programme);
  for (auto const& [key, text] : options.provenance) result.dataset.provenance[key] = text;
  if (options.dataset) output::write(result.dataset, *options.dataset);
  if (options.dataset) remove_stale_checkpoint(*options.dataset);
  if (json)
    fmt::print("{}", reduced_json(twin, result));
  else if (!quiet)
    fmt::print("{}", reduced_table(twin, result));
}

/// For what is whole or not there at all, and looks at no flag on its way.
void let_signals_end_it(std::atomic<bool> const& stop) {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  if (stop) throw Interrupted("stopped; nothing was written");
}

void RunCommand::operator()(std::atomic<bool> const& stop) const {
  auto const experiment_path = experiment_file(experiment);
  Value experiment_document = read_toml(experiment_path);
  Value machine_document{{}, Value::Table{}};
  auto const preliminary = read_experiment(experiment_document, experiment_path);
  auto const path = machine.empty() ? machine_of(preliminary, experiment_path) : machine_file(machine);
  machine_document = read_toml(path);
  Value const as_written = machine_document;
  refuse_repeated(settings_in(fmt::format("{}", fmt::join(settings, "\n"))));
  for (auto const& text : settings) apply(setting(text), machine_document, experiment_document);
  auto const programme = read_experiment(experiment_document, experiment_path);
  for (auto const& text : settings) refuse_replaced(setting(text), programme);
  check_outputs(path, experiment_path, programme);
  Machine const built = Machine::build(machine_document);
  static_cast<void>(ranged_numbers(as_written));  // a setting may leave its range
  auto const in_files = [&](auto action) {        // what it complains of gets its place in one of the two
    try {
      return action();
    } catch (FileError const&) {
      throw;
    } catch (thermal::InputError const& error) {
      check_together(experiment_document, programme, machine_document, built);
      throw located_in(experiment_document, error);
    }
  };
  if (!quiet) {
    auto const remarks = in_files([&] { return experiment_remarks(experiment_document, programme, built); });
    for (auto const& remark : remarks) tell(fmt::format("warning: {}\n", remark));
  }

  RunOptions options;
  options.integration.relative_tolerance = tolerance;
  options.integration.absolute_tolerance = tolerance;
  if (!dataset.empty()) options.dataset = dataset;
  if (!fields.empty()) options.fields = fields;
  if (!picture.empty()) options.picture = picture;
  options.field_interval = positive_quantity("--field-interval", field_interval, thermal::dimension::time);
  options.node_temperatures = nodes;
  options.watch_ranges = true;
  options.provenance =
      origin(path, machine_document, experiment_path, fmt::format("{}", fmt::join(settings, "\n")), programme);
  set_checkpoint(options);
  if (reduced) {
    let_signals_end_it(stop);
    return in_files([&] { run_reduced(built, programme, options); });
  }
  options.stop = &stop;
  std::optional<Progress> progress;
  if (!quiet) {
    progress.emplace(fmt::format("{} on {}", experiment_path.stem().string(), built.name));
    options.progress = [&](double share) { progress->show(share); };
  }
  auto const result = in_files([&] { return run(built, programme, options); });
  progress.reset();
  if (auto const remark = balance_remark(result.summary); !quiet && !remark.empty())
    tell(fmt::format("warning: {}\n", remark));
  if (options.dataset) remove_stale_checkpoint(*options.dataset);
  if (json)
    fmt::print("{}", summary_json(built, result));
  else if (!quiet)
    fmt::print("{}", summary_table(built, result));
}

}  // namespace

void add_run_command(CLI::App& app, std::atomic<bool> const& stop) {
  auto command = std::make_shared<RunCommand>();
  auto* added = app.add_subcommand("run", "run an experiment on a machine");
  command->add_to(*added);
  added->callback([command, &stop] { (*command)(stop); });
}

void add_replay_command(CLI::App& app, std::atomic<bool> const& stop) {
  auto* command = app.add_subcommand("replay", "make a run anew from its own output, and compare byte for byte");
  auto file = std::make_shared<std::string>(), kept = std::make_shared<std::string>();
  command->add_option("dataset", *file, "data set of a run (HDF5)")->required();
  command->add_option("--output,-o", *kept, "keep the new data set");
  command->callback([file, kept, &stop] {
    check_suffix(*kept, "a data set", {".h5"});
    refuse_to_overwrite(*kept, {}, {*file});
    refuse_to_replace_other_than_run(*kept);
    std::optional<Progress> progress(*file);
    auto const made = replay(
        *file, *kept, [&](double share) { progress->show(share); }, &stop);
    progress.reset();
    if (!made.same_bytes) throw std::runtime_error(made.text);
    fmt::print("{}", made.text);
  });
}

}  // namespace thermotwin::twin
