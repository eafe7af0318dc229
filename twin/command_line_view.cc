#include "twin/command_line_view.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "output/page_server.h"
#include "twin/command_line_number.h"
#include "twin/machine.h"
#include "twin/report/live_page.h"

namespace thermotwin::twin {
namespace {

struct ViewCommand {
  std::vector<std::filesystem::path> data;
  std::string machine;
  int port = 0;

  void operator()(std::atomic<bool> const& stop) const;
};

void ViewCommand::operator()(std::atomic<bool> const& stop) const {
  LivePage page(data, machine.empty() ? std::filesystem::path() : machine_file(machine));
  output::PageServer const server(port,
                                  {[&] { return page.html(); }, [&](std::uint64_t after) { return page.news(after); }});
  fmt::print("{}  (for this computer only; Ctrl-C ends it)\n", server.address());
  std::fflush(stdout);
  while (!stop) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}  // namespace

void add_view_command(CLI::App& app, std::atomic<bool> const& stop) {
  auto command = std::make_shared<ViewCommand>();
  auto* added = app.add_subcommand("view", "the report page in a browser, renewed while runs and diagnoses go on");
  added->add_option("data", command->data, "data sets, answers (.json), folders that a command fills")->required();
  added->add_option("--machine,-m", command->machine, "machine to draw, file or name; default: the one in a data set");
  added->add_option("--port", command->port, "of this computer's loopback address; 0: any that is free")
      ->capture_default_str()
      ->check(number_between(0, 65535));
  added->callback([command, &stop] { (*command)(stop); });
}

}  // namespace thermotwin::twin
