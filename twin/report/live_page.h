#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace thermotwin::twin {

/// The report page of files that change: built anew when one of them has, and asked for.
///
/// A data set that a run still writes is shown from `<name>.partial`; of a folder everything is shown that a command
/// left or keeps in it: `progress.json`, answers (`.json`) and data sets (`.h5`); of a campaign's folder, how far it
/// is and what its runs show. What is not there yet is waited for, and what cannot be read is said in its place. Safe
/// to be asked from several threads.
///
/// A file is new when its time or size is. File systems tell times in ticks of some milliseconds, so what was written
/// within the last of them is read again when next asked for. The revision counts what is shown, not what was read.
class LivePage {
 public:
  using Paths = std::vector<std::filesystem::path>;

  /// InputError for what can never be shown: a file of another kind, one in a folder that is not there.
  explicit LivePage(Paths watched, std::filesystem::path machine = {});

  /// The page as it is now, HTML.
  [[nodiscard]] std::string html();

  /// What a page of an older revision than the present one needs (ReportPage::news); none when it is as new.
  [[nodiscard]] std::optional<std::string> news(std::uint64_t after);

 private:
  using Stamp = std::vector<std::pair<std::string, std::pair<std::filesystem::file_time_type, std::uintmax_t>>>;

  void renew();

  Paths watched_;
  std::filesystem::path machine_;
  std::mutex asked_;
  Stamp stamp_;
  bool settled_ = false;  ///< the stamp is older than a tick
  std::uint64_t revision_ = 0;
  std::string html_, news_, shown_;
};

}  // namespace thermotwin::twin
