#include "twin/command_line_figure.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

#include "thermal/error.h"
#include "twin/command_line_list.h"
#include "twin/command_line_number.h"
#include "twin/report/figure_files.h"

namespace thermotwin::twin {
namespace {

struct FigureCommand {
  FigureFiles files;
  int columns = 1;

  void operator()();
};

void FigureCommand::operator()() {
  if (files.output.empty() != files.panel.empty())
    throw thermal::InputError("a figure needs both, --panel and --output; without either the panels are listed");
  if (columns == 2) files.width = output::Figure::two_columns;
  fmt::print("{}", write_figure_files(files));
}

}  // namespace

void add_figure_command(CLI::App& app) {
  auto command = std::make_shared<FigureCommand>();
  auto& files = command->files;
  auto* added = app.add_subcommand("figure", "one panel of the report page as SVG or PDF for a paper");
  added->add_option("data", files.data, "data sets and answers (.json), as for a report")->required();
  added->add_option("--panel,-p", files.panel, "by the name of its CSV on the page; default: list the panels");
  take_list(*added->add_option("--only", files.only, "curves of it: T1,T4"));
  added->add_option("--output,-o", files.output, "file to write: .svg, or .pdf with its fonts embedded");
  auto* columns = added->add_option("--columns", command->columns, "width of one (84 mm) or two (174 mm) columns")
                      ->capture_default_str()
                      ->check(CLI::IsMember({1, 2}));
  added->add_option("--width", files.width, "[mm], 30 to 1000, in place of columns")
      ->check(number_between(30.0, 1000.0, "mm"))
      ->excludes(columns);
  added->add_option("--height", files.height, "[mm], 20 to 1000")
      ->capture_default_str()
      ->check(number_between(20.0, 1000.0, "mm"));
  added->callback([command] { (*command)(); });
}

}  // namespace thermotwin::twin
