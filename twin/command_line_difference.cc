#include "twin/command_line_difference.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

#include "output/atomic_file.h"
#include "thermal/dimension.h"
#include "twin/command_line_number.h"
#include "twin/machine.h"
#include "twin/report/difference.h"

namespace thermotwin::twin {
namespace {

struct DifferenceCommand {
  DifferenceFiles files;
  std::string machine, interval = "15 min";

  void operator()();
};

void DifferenceCommand::operator()() {
  if (!machine.empty()) files.machine = machine_file(machine);
  files.interval = positive_quantity("--interval", interval, thermal::dimension::time);
  output::require_empty(files.folder);
  fmt::print("{}", write_difference(files));
}

}  // namespace

void add_difference_command(CLI::App& app) {
  auto command = std::make_shared<DifferenceCommand>();
  auto& files = command->files;
  auto* added =
      app.add_subcommand("difference", "one run minus another, or a measurement minus its twin, as fields (VTK)");
  added->add_option("first", files.first, "data set .h5, .csv, or a measurement file .toml")->required();
  added->add_option("second", files.second, "what is taken off: data set .h5 or .csv, or a machine, file or name")
      ->required();
  added->add_option("--output,-o", files.folder, "folder for the fields; it must be empty or absent")->required();
  added->add_option("--interval", command->interval, "time between two frames, at least")->capture_default_str();
  added->add_option("--machine,-m", command->machine, "machine to draw, file or name; default: the one in a data set");
  added->callback([command] { (*command)(); });
}

}  // namespace thermotwin::twin
