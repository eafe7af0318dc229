#include "twin/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <iostream>
#include <optional>
#include <string_view>

#include "output/csv.h"
#include "output/dataset_file.h"
#include "output/error.h"
#include "scenarios/experiment.h"
#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "twin/campaign/campaign_description.h"
#include "twin/command_line_campaign.h"
#include "twin/command_line_compensate.h"
#include "twin/command_line_diagnose.h"
#include "twin/command_line_difference.h"
#include "twin/command_line_error_model.h"
#include "twin/command_line_figure.h"
#include "twin/command_line_mistake.h"
#include "twin/command_line_place.h"
#include "twin/command_line_run.h"
#include "twin/command_line_study.h"
#include "twin/command_line_view.h"
#include "twin/command_line_volumetric.h"
#include "twin/diagnosis/measurement_file.h"
#include "twin/effect_page.h"
#include "twin/error_model_file.h"
#include "twin/file/output_path.h"
#include "twin/file_check.h"
#include "twin/file_kind.h"
#include "twin/known_names.h"
#include "twin/machine.h"
#include "twin/machine_tables.h"
#include "twin/needed_solution.h"
#include "twin/placement/candidate_sites.h"
#include "twin/progress.h"
#include "twin/report/report_files.h"
#include "twin/run.h"
#include "twin/study/study_description.h"
#include "twin/version.h"

namespace thermotwin::twin {
namespace {

std::atomic<bool> stop_requested = false;

int fail(int code, std::string_view message) {
  tell(fmt::format("thermotwin: {}\n", message));
  return code;
}

/// The exit code of a command that has done its work: 2 when what it printed did not all get out.
int printed() {
  std::cout.flush();
  bool const whole = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
  return whole ? 0 : fail(2, "cannot write to standard output; not all of it is there");
}

/// Ends the program with 2 when there is a mistake in one of the files.
void print_checks(std::vector<std::string> const& names) {
  std::vector<std::filesystem::path> files;
  for (auto const& name : names) files.push_back(file_to_check(name));
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

/// Where to look for a name that has no page of its own: an effect's, a table's of a machine, a key's of a file.
std::string page_with(std::string const& name, std::vector<TableRecord> const& files) {
  for (auto const& effect : effect_catalogue())
    if (effect.name == name) return fmt::format("it is an effect: thermotwin effects {}", name);
  for (auto const& table : describe_machine())
    if (table.name == name) return "it is a table of a machine: thermotwin describe machine";
  for (auto const& file : files)
    for (auto const& field : file.fields)
      if (field.key == name) return fmt::format("it is a key of {0}: thermotwin describe {0}", file.name);
  return "";
}

void describe(std::string const& what) {
  std::vector<TableRecord> const files = {
      {"experiment", "what a machine is put through; the keys of its file", list_fields<scenarios::Experiment>()},
      {"model", "an error model, as `fit` writes it", error_model_fields()},
      {"study", "selections and models on the same runs", list_fields<StudyDescription>()},
      {"campaign", "many runs: grid x samples x cases x experiments x repetitions", list_fields<CampaignDescription>()},
      {"candidates", "where sensors may sit, for `place`", list_fields<CandidateRules>()},
      {"measurement", "what the columns of measured tables are", list_fields<MeasurementFile>()}};
  if (what == "materials") return fmt::print("{}", material_list());
  if (what == "channels") return fmt::print("{}", channel_list());
  std::vector<std::string> known = {"machine", "materials", "channels"};
  for (auto const& file : files) {
    if (file.name == what) {
      fmt::print("{}", table_page(file));
      return;
    }
    known.push_back(file.name);
  }
  if (what != "machine") {
    auto const page = page_with(what, files);
    throw thermal::InputError(
        fmt::format("describe: there is no '{}'; {}", what, page.empty() ? thermal::did_you_mean(what, known) : page));
  }
  for (auto const& table : describe_machine()) fmt::print("{}\n", table_page(table));
}

void add_other_commands(CLI::App& app) {
  auto* describe_command = app.add_subcommand("describe", "print every key of a kind of file, or what it may name");
  auto what = std::make_shared<std::string>();
  describe_command
      ->add_option("what", *what,
                   "machine, experiment, measurement, model, study, campaign or candidates; materials or channels")
      ->required();
  describe_command->callback([what] { describe(*what); });

  auto* check_command =
      app.add_subcommand("check", "look for mistakes in the files that the program reads, of whatever kind");
  auto files = std::make_shared<std::vector<std::string>>();
  check_command
      ->add_option("files", *files,
                   "files, or names of what comes with the program; an experiment is checked together with a machine "
                   "among them")
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
    refuse_to_replace_other_table(*output, "table of these channels",
                                  [&](auto const& line) { return output::is_header_of(data, line); });
    if (!data.complete)
      tell(fmt::format(
          "warning: the run of '{}' did not end: instruments have shown nothing yet; --truth has what is\n", *input));
    if (auto const left_out = output::left_out_of_csv(data); !left_out.empty())
      tell(fmt::format("note: a table has no place for {} of '{}'\n", fmt::join(left_out, ", "), *input));
    if (output->empty())
      output::export_csv(data, std::cout, *groups);
    else
      output::export_csv(data, std::filesystem::path(*output), *groups);
  });

  auto* weights_command = app.add_subcommand(
      "weights",
      "compute the influence weights of a machine's blocks with CalculiX, and write them beside its file (.weights)");
  auto machine = std::make_shared<std::string>();
  weights_command->add_option("machine", *machine, "machine file")->required();
  weights_command->callback([machine] { static_cast<void>(write_weights(machine_file(*machine), std::cerr)); });
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
  for (char const* name :
       {"run", "replay", "calibrate", "diagnose", "campaign", "place", "study", "compensate", "play", "view"})
    app.get_subcommand(name)->preparse_callback([](std::size_t) {
      std::signal(SIGINT, [](int) { stop_requested = true; });
      std::signal(SIGTERM, [](int) { stop_requested = true; });
    });
}

/// CLI11 would take -1, and whatever is too large, for 18446744073709551615.
void check_seeds(CLI::App& app) {
  for (auto* command : app.get_subcommands({}))
    if (auto* seed = command->get_option_no_throw("--seed"))
      seed->check([](std::string const& text) {
        std::uint64_t number = 0;
        if (text.starts_with('-')) return fmt::format("{} is negative; a whole number from 0 on is due", text);
        auto const error = std::from_chars(text.data(), text.data() + text.size(), number).ec;
        return error == std::errc::result_out_of_range ? fmt::format("{} is more than 18446744073709551615", text) : "";
      });
}

/// An empty word is a variable of a script that was never set, and no name, file or quantity.
void refuse_empty_words(CLI::App& app) {
  for (auto* option : app.get_options())
    if (option->get_items_expected_max() > 0)
      option->check([](std::string const& text) { return text.empty() ? "an empty text; a value is due" : ""; });
  for (auto* part : app.get_subcommands({})) refuse_empty_words(*part);  // commands, and groups of their options
}

/// What CLI11 "could not convert".
void refuse_other_than_numbers(CLI::App& app) {
  auto const check = [](CLI::Option& option, auto number, std::string const& due) {
    option.check([=](std::string const& text) mutable {
      return CLI::detail::lexical_cast(text, number) ? "" : fmt::format("'{}' is no {}; one is due", text, due);
    });
  };
  for (auto* option : app.get_options()) {
    auto const type = option->get_type_name();
    if (type.starts_with("FLOAT")) check(*option, 0.0, "number");
    if (type.starts_with("INT")) check(*option, std::int64_t(0), "whole number");
    if (type.starts_with("UINT")) check(*option, std::uint64_t(0), "whole number from 0 on");
  }
  for (auto* part : app.get_subcommands({})) refuse_other_than_numbers(*part);
}

/// Before any work: of text files (TOML), only measurement files are measured runs. What is wrong in one its reader
/// tells.
std::string other_than_measurement(std::string const& file) {
  std::error_code ignored;
  if (!file.ends_with(".toml") || !std::filesystem::is_regular_file(file, ignored)) return {};
  std::optional<Value> document;
  try {
    document = read_toml(file);
  } catch (FileError const&) {
    return {};
  }
  refuse_other_kind(*document, FileKind::measurement);
  return {};
}

void refuse_other_than_measurements(CLI::App& app) {
  for (auto* command : app.get_subcommands({}))
    for (std::string const name : {"data", "runs", "first", "--hold-out"}) {
      auto* option = command->get_option_no_throw(name);
      bool const is_experiment = name == "--hold-out" && !command->get_option_no_throw("data");  // of `place`
      if (option && !is_experiment) option->check(other_than_measurement);
    }
}

/// CLI11's help, with a sentence above options of which one is due.
class HelpText : public CLI::Formatter {
 public:
  std::string make_expanded(CLI::App const* part) const override {
    bool const one_is_due = part->get_require_option_min() == 1 && part->get_require_option_max() == 1;
    if (!part->get_name().empty() || !one_is_due) return CLI::Formatter::make_expanded(part);
    std::string text = "\nOne of these is due:\n";
    for (auto const* option : part->get_options())
      if (option != part->get_help_ptr()) text += make_option(option, false);
    return text;
  }
};

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
  app.formatter(std::make_shared<HelpText>());
  app.set_version_flag("--version,-v", fmt::format("thermotwin {} ({})", version(), commit()));
  app.require_subcommand(1);
  add_run_command(app, stop_requested);
  add_other_commands(app);
  add_calibrate_command(app, stop_requested);
  add_diagnose_command(app, stop_requested);
  add_compare_command(app);
  add_replay_command(app, stop_requested);
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
  check_seeds(app);
  refuse_empty_words(app);
  refuse_other_than_numbers(app);
  refuse_other_than_measurements(app);
  try {
    app.parse(reversed_words(argc, argv));
    return printed();
  } catch (CLI::ParseError const& error) {
    if (error.get_exit_code() == 0) {
      app.exit(error);  // help, or the version
      return printed();
    }
    if (dynamic_cast<CLI::RuntimeError const*>(&error)) return error.get_exit_code();  // all is said
    return fail(2, command_line_mistake(app, error));
  } catch (Interrupted const& error) {
    return fail(130, error.what());
  } catch (thermal::InputError const& error) {
    return fail(2, error.what());
  } catch (output::OutputError const& error) {
    return fail(2, error.what());
  } catch (std::filesystem::filesystem_error const& error) {
    return fail(2, fmt::format("'{}': {}", error.path1().string(), error.code().message()));
  } catch (std::exception const& error) {
    if (std::ferror(stdout) != 0) return printed();
    return fail(1, error.what());
  }
}

}  // namespace thermotwin::twin
