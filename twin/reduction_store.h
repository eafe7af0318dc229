#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "thermal/reduction.h"

namespace thermotwin::twin {

/// Everything that thermal::reduce reads: all numbers of the network, what is watched, where the training runs begin
/// and their inputs at every minute; and the program's own sources and compiler.
[[nodiscard]] std::string reduction_key(thermal::Network const& network, thermal::ReductionTask const& task);

/// Reductions kept on disk, each as `<key>.reduction`: its key, a CRC-32, the bytes of its numbers.
///
/// What is damaged, cut short or of another key counts as not there. Of several processes that lack the same one, one
/// makes it and the others wait for it (flock). Where the folder cannot be written, nothing is kept.
class ReductionStore {
 public:
  explicit ReductionStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] thermal::Reduction find_or_make(std::string const& key,
                                                std::function<thermal::Reduction()> const& make) const;
  [[nodiscard]] std::filesystem::path file(std::string const& key) const;

 private:
  [[nodiscard]] std::optional<thermal::Reduction> find(std::string const& key) const;

  std::filesystem::path folder_;
};

/// Where the program keeps what it can make again: $THERMOTWIN_CACHE, or thermotwin in $XDG_CACHE_HOME or ~/.cache;
/// nowhere, if THERMOTWIN_CACHE is set and empty, or nobody has a home.
[[nodiscard]] std::optional<std::filesystem::path> cache_folder();

}  // namespace thermotwin::twin
