#include "twin/command_line_volumetric.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <string>

#include "thermal/units.h"
#include "twin/command_line_number.h"
#include "twin/machine.h"
#include "twin/volumetric/volumetric_files.h"
#include "twin/volumetric/volumetric_report.h"

namespace thermotwin::twin {
namespace {

/// As they are typed.
struct VolumetricArguments {
  VolumetricFiles files;
  std::string machine, at = "0 s", resolution = "0.1 um";
  std::vector<std::string> settings;
  bool json = false;
};

void add_options(CLI::App& command, VolumetricArguments& arguments) {
  auto& options = arguments.files.options;
  command.add_option("machine", arguments.machine, "machine file or name, with a table [volumetric]")->required();
  command
      .add_option("--set", arguments.settings, "change a parameter: volumetric.drawn.angular=\"5 urad\"; once for each")
      ->allow_extra_args(false);
  command.add_option("--seed", options.seed, "of the measurement")->capture_default_str();
  command.add_option("--method", options.method, "of prediction: interpolation, ls_svm, ls_svm_chosen, network")
      ->capture_default_str();
  command.add_flag("--plain", options.plain, "compensate by the plain identification");
  command.add_option("--resolution", arguments.resolution, "of the controller")->capture_default_str();
  auto* run = command.add_option("--run", arguments.files.run,
                                 "data set of a run of the machine: how its warming moves the volume");
  command.add_option("--at", arguments.at, "instant of that run at which the machine is measured")
      ->capture_default_str()
      ->needs(run);
  command.add_option("--output,-o", arguments.files.output,
                     "folder for tables (CSV), compensation and field (VTK); it must be empty or absent");
  command.add_option("--picture", arguments.files.picture, "PNG of the error field; needs a display, or xvfb-run");
  command.add_flag("--json", arguments.json, "print everything as JSON");
}

}  // namespace

void add_volumetric_command(CLI::App& app) {
  auto* command = app.add_subcommand("volumetric", "measure, identify, predict and compensate the error in the volume");
  auto arguments = std::make_shared<VolumetricArguments>();
  add_options(*command, *arguments);
  command->callback([arguments] {
    auto& files = arguments->files;
    files.machine = machine_file(arguments->machine);
    for (auto const& text : arguments->settings) files.settings.push_back(setting(text));
    files.options.measured_at = option_quantity("--at", arguments->at, thermal::dimension::time);
    files.options.resolution = option_quantity("--resolution", arguments->resolution, thermal::dimension::length);
    auto const study = volumetric_files(files);
    fmt::print("{}", arguments->json ? volumetric_json(study) : volumetric_text(study));
  });
}

}  // namespace thermotwin::twin
