#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "twin/campaign/campaign.h"
#include "twin/campaign/share.h"

namespace thermotwin::twin {

struct CampaignOptions {
  std::filesystem::path folder;
  Share share;
  std::function<void(double)> progress;  ///< the share of this process' runs that is done
  std::atomic<bool> const* stop = nullptr;
};

/// What a process did.
struct CampaignReport {
  std::int64_t made = 0;  ///< runs, by this process, now
  int threads = 1;
  double seconds = 0.0;      ///< on the clock
  double run_seconds = 0.0;  ///< in the runs themselves, all threads added up

  /// What the campaign adds to each run, in threads' time [s].
  [[nodiscard]] double overhead() const { return made > 0 ? (seconds * threads - run_seconds) / double(made) : 0.0; }
};

/// Makes the runs of a share that are not there yet, on all threads. The folder holds
///
///   manifest.json        what the campaign is made of: files, version; another one is refused
///   parts/000000.h5 …    runs, whole parts only
///   parts/….journal      of parts in work
///
/// A run that fails is recorded with its reason. Interrupted when `stop` is set; OutputError when the disk is full,
/// another process makes the same share, or the folder is not empty and holds no campaign; InputError when its
/// campaign.h5 is something else.
CampaignReport run_campaign(Campaign const& campaign, CampaignOptions const& options);

/// campaign.h5 and failures.csv, once every part is there; false as long as one is missing. Any process may do it, and
/// more than one.
bool finish_campaign(Campaign const& campaign, std::filesystem::path const& folder);

/// Runs that failed, from failures.csv of a finished campaign.
[[nodiscard]] std::int64_t failed_runs(std::filesystem::path const& folder);

}  // namespace thermotwin::twin
