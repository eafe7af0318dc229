#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "output/journal.h"
#include "twin/campaign/campaign.h"
#include "twin/campaign/campaign_form.h"
#include "twin/campaign/share.h"

namespace thermotwin::twin {

/// `parts/000012.h5`, relative to the campaign's folder.
[[nodiscard]] std::filesystem::path part_file(std::int64_t part);

/// The runs that are still to be made by one process, and where their results go. Every result goes to the journal of
/// its part at once; when a part is whole it is written as one file, atomically, and its journal goes. What is in a
/// file or a journal is not made again. InputError for a file that is no whole part. Threads share one object.
class CampaignParts {
 public:
  CampaignParts(Campaign const& campaign, CampaignForm const& form, std::filesystem::path folder, Share share);
  ~CampaignParts();

  /// The next run that nobody has; none when all are given out.
  [[nodiscard]] std::optional<std::int64_t> next();
  void put(CampaignResult const& result);

  /// Of this process' share: runs in all, and how many are in files or journals by now.
  [[nodiscard]] std::int64_t runs() const { return runs_; }
  [[nodiscard]] std::int64_t done() const;

 private:
  struct Part;

  [[nodiscard]] std::int64_t first_run(std::int64_t part) const { return part * campaign_.runs_per_part(); }
  [[nodiscard]] std::int64_t size(std::int64_t part) const;
  void check_file(std::int64_t part);
  bool open_next();
  void close(Part& part);

  Campaign const& campaign_;
  CampaignForm const& form_;
  std::filesystem::path folder_;
  Share share_;
  std::int64_t runs_ = 0, done_ = 0, next_part_ = 0;
  mutable std::mutex mutex_;
  std::mutex writing_;  ///< HDF5 is for one thread at a time
  std::map<std::int64_t, std::unique_ptr<Part>> open_;
  Part* current_ = nullptr;
};

}  // namespace thermotwin::twin
