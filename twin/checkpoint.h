#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "output/journal.h"
#include "thermal/integrate.h"

namespace thermotwin::twin {

/// The file from which a killed run is taken up. Its first record says which run it is of; each further one holds what
/// the integrator showed since the one before, and where it stood. What a run records is made of these samples alone,
/// so that replaying them restores its records, its instruments' included.
class Checkpoint {
 public:
  using Identity = std::map<std::string, std::string>;

  /// Opens or makes the file. InputError when it is of a run of another `identity`, and says what was asked for then;
  /// when it holds a run and `resume` is not asked for; or when it is no journal (output/journal.h), and is left as it
  /// is.
  Checkpoint(std::filesystem::path const& path, Identity const& identity, bool resume);

  /// Shows every sample that is in the file and sets the state to the last; returns how many they were.
  std::size_t replay(thermal::Network const& network, thermal::IntegrationState& state,
                     thermal::Observer const& observe);

  /// Remembers a sample until the next write.
  void keep(thermal::Sample const& sample);
  void write(thermal::IntegrationState const& state);
  /// The run is done.
  void remove() const { journal_.remove(); }

 private:
  output::Journal journal_;
  std::vector<std::string> records_;  ///< of the run so far
  std::string samples_;               ///< since the last write
  std::size_t kept_ = 0;              ///< their number
};

/// Where the integrator starts anew: for each stretch of the output times the number of times up to its end, which is
/// the first time at or after a multiple of `interval` (0: one stretch). The last is all of them.
[[nodiscard]] std::vector<std::size_t> stretches(std::span<double const> times, double interval);

/// Beside the data set of its run.
[[nodiscard]] std::filesystem::path checkpoint_of(std::filesystem::path dataset);

/// The interval of the run that a checkpoint is of [s]; it is read only. InputError when there is none.
[[nodiscard]] double checkpoint_interval(std::filesystem::path const& path);

/// For a run that is to go on, if it was begun. InputError when its data set is there and no checkpoint: it is done,
/// or another one is.
void refuse_to_resume_finished(std::filesystem::path const& dataset);

/// Removes what a stopped run left whose data set another one has made. No checkpoint, or one that another process
/// writes, stays.
void remove_stale_checkpoint(std::filesystem::path const& dataset);

}  // namespace thermotwin::twin
