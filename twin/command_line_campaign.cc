#include "twin/command_line_campaign.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "thermal/error.h"
#include "twin/campaign/campaign.h"
#include "twin/campaign/run_campaign.h"
#include "twin/progress.h"

namespace thermotwin::twin {
namespace {

struct CampaignCommand {
  std::string file, folder, share;
  std::int64_t show = -1;
  bool quiet = false;

  void operator()(std::atomic<bool> const& stop) const;

 private:
  void show_run(Campaign const& campaign) const;
};

void CampaignCommand::show_run(Campaign const& campaign) const {
  if (show >= campaign.runs())
    throw thermal::InputError(fmt::format("--show {}: the runs are 0 to {}", show, campaign.runs() - 1));
  fmt::print("{}\n", campaign.command(campaign.run(show)));
}

std::string text_of(CampaignReport const& report, Share rank) {
  if (report.made == 0) return "";
  return fmt::format(
      "{} runs{} in {:.1f} s on {} threads: {:.3f} ms of a thread each, and {:.3f} ms for the campaign\n", report.made,
      rank.count > 1 ? fmt::format(" by rank {} of {}", rank.index, rank.count) : "", report.seconds, report.threads,
      1e3 * report.run_seconds / double(report.made), 1e3 * report.overhead());
}

void CampaignCommand::operator()(std::atomic<bool> const& stop) const {
  if (folder.empty() && show < 0) throw thermal::InputError("campaign needs a folder: --output DIR");
  auto const campaign = Campaign::read(campaign_file(file));
  if (show >= 0) return show_run(campaign);
  auto const rank = share_of_rank();
  if (!share.empty() && rank.count > 1)
    throw thermal::InputError("--array and mpirun both share out the runs; use one of them");
  CampaignOptions options{folder, share.empty() ? rank : share_of(share), {}, &stop};
  std::optional<Progress> progress;
  if (!quiet && rank.index == 0) {
    progress.emplace(fmt::format("{} runs", campaign.runs()));
    options.progress = [&](double done) { progress->show(done); };
  }
  auto const report = run_campaign(campaign, options);
  progress.reset();
  bool const whole = finish_campaign(campaign, folder), ended_it = whole && report.made > 0;
  if (rank.index != 0 && !ended_it) return;
  auto const failed = whole ? failed_runs(folder) : 0;
  if (!quiet) {
    fmt::print("{}", text_of(report, rank));
    if (whole)
      fmt::print("{}: {} runs, {} of them failed (failures.csv)\n",
                 (std::filesystem::path(folder) / "campaign.h5").string(), campaign.runs(), failed);
    else
      fmt::print("{}: other shares are still to be made\n", folder);
  }
  if (failed == campaign.runs())
    throw std::runtime_error(fmt::format("no run of the campaign could be made; '{}' says why",
                                         (std::filesystem::path(folder) / "failures.csv").string()));
}

}  // namespace

void add_campaign_command(CLI::App& app, std::atomic<bool> const& stop) {
  auto command = std::make_shared<CampaignCommand>();
  auto* added = app.add_subcommand("campaign", "many runs: experiments x parameters x instruments, in one data set");
  added->add_option("campaign", command->file, "campaign file, or the name of a shipped one")->required();
  added->add_option("--output,-o", command->folder, "folder for the results; what is there already is not made again");
  added->add_option("--array", command->share, "make share I of N only, as I/N with I from 0: for job arrays");
  added->add_option("--show", command->show, "print the command that makes run number N alone, and make nothing")
      ->check(CLI::NonNegativeNumber);
  added->add_flag("--quiet,-q", command->quiet, "print nothing but errors");
  added->callback([command, &stop] { (*command)(stop); });
}

}  // namespace thermotwin::twin
