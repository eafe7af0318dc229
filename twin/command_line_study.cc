#include "twin/command_line_study.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <optional>

#include "output/atomic_file.h"
#include "twin/progress.h"
#include "twin/progress_file.h"
#include "twin/study/study.h"
#include "twin/study/study_page.h"

namespace thermotwin::twin {
namespace {

struct StudyCommand {
  std::string study, folder;
  bool json = false;

  void operator()(std::atomic<bool> const& stop) const;
};

/// A bar per stage.
class Stages {
 public:
  void operator()(std::string const& what, double share) {
    if (what != what_) {
      bar_.reset();
      bar_.emplace(what);
      what_ = what;
    }
    bar_->show(share);
  }

 private:
  std::string what_;
  std::optional<Progress> bar_;
};

void StudyCommand::operator()(std::atomic<bool> const& stop) const {
  auto const file = study_file(study);
  auto const read = read_study(file);
  std::filesystem::path const target = folder;
  std::optional<ProgressFile> onlookers(std::in_place, target, fmt::format("Study {}", file.stem().string()));
  auto stages = std::make_shared<Stages>();
  StudyOptions options{{}, &stop};
  options.progress = [&, stages](std::string const& what, double share) {
    onlookers->show(what, share);
    if (!json) (*stages)(what, share);
  };
  auto const report = told_if_stopped(onlookers, [&] { return run_study(read, options); });
  options.progress = {};
  stages.reset();
  onlookers.reset();
  output::write_atomically(target / "table.csv", study_csv(report));
  output::write_atomically(target / "study.json", study_json(report));
  fmt::print("{}", json ? study_json(report) : study_text(report));
}

}  // namespace

void add_study_command(CLI::App& app, std::atomic<bool> const& stop) {
  auto command = std::make_shared<StudyCommand>();
  auto* added = app.add_subcommand("study", "selections and models on the same data, in one table, with a verdict");
  added->add_option("study", command->study, "study file, or the name of a shipped one")->required();
  added->add_option("--output,-o", command->folder, "folder for table.csv and study.json; it must be empty or absent")
      ->required();
  added->add_flag("--json", command->json, "print everything as JSON");
  added->callback([command, &stop] { (*command)(stop); });
}

}  // namespace thermotwin::twin
