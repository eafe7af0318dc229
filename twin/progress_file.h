#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/descriptor.h"
#include "twin/run.h"

namespace thermotwin::twin {

/// What a long command has done so far, for those who look on: `progress.json` in the folder that it will fill,
/// {"title", "steps": [{"what", "at_s", "share"}], "done"}. It is there while the object is, and when the user stopped
/// the command; `thermotwin view FOLDER` shows it. A file that cannot be written is no reason to stop: onlookers see
/// less.
class ProgressFile {
 public:
  /// Makes the folder. What a job that was killed left of its progress goes; OutputError when the folder holds anything
  /// else, another job is filling it, or it cannot be made.
  ProgressFile(std::filesystem::path const& folder, std::string title);
  ~ProgressFile();
  ProgressFile(ProgressFile const&) = delete;
  ProgressFile& operator=(ProgressFile const&) = delete;

  /// Whether a job is filling that folder. One that was killed is not, whatever its file says.
  [[nodiscard]] static bool is_running(std::filesystem::path const& folder);

  /// A new step when `what` differs from the last one, or the share that is done of the last. Written at most every
  /// half second, but for new steps.
  void show(std::string const& what, std::optional<double> share = {});
  /// The file stays and says so; another job may take the folder.
  void stopped();

 private:
  using Clock = std::chrono::steady_clock;
  struct Step {
    std::string what;
    double at_s;
    std::optional<double> share;
  };

  void write() const;

  std::filesystem::path path_;
  output::Descriptor folder_;  ///< locked (flock): the system frees it however this process ends
  std::string title_;
  std::vector<Step> steps_;
  bool stopped_ = false;
  Clock::time_point start_ = Clock::now(), next_ = start_;
};

inline constexpr char const* progress_file = "progress.json";

/// What `work` gives; onlookers, if there are any, see when the user stopped it.
template <class Work>
auto told_if_stopped(std::optional<ProgressFile>& onlookers, Work work) {
  try {
    return work();
  } catch (Interrupted const&) {
    if (onlookers) onlookers->stopped();
    throw;
  }
}

}  // namespace thermotwin::twin
