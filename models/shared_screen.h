#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "models/candidates.h"
#include "models/fuzzy_c_means.h"
#include "models/information_screen.h"
#include "models/ordered_clustering.h"
#include "models/selection.h"
#include "models/time_ranked_clusters.h"

namespace thermotwin::models {

/// Candidates by rising temperature, and their partitions into contiguous classes.
struct OrderedCandidates {
  std::vector<Eigen::Index> order;
  OrderedPartitions partitions;
};

/// What the methods of papers 000 and 001 share when they are asked about the same batches with the same options. Each
/// part is made when it is first asked for, by whichever thread asks, and only once.
class SharedScreen {
 public:
  InformationScreen const& screen(Candidates const& from, SelectionOptions const& options);

  /// Of the candidates that the screen keeps, or of all.
  OrderedCandidates const& ordered(Candidates const& from, SelectionOptions const& options, bool all);

  /// Of the candidates' courses.
  FuzzyPartitions& fuzzy(Candidates const& from, std::uint64_t seed, ClusterScale scale);

  /// Screens and clusterings that were made so far.
  [[nodiscard]] int made() const;

 private:
  std::atomic<int> made_{0};  ///< but for the fuzzy ones
  std::once_flag screened_;
  InformationScreen screen_;
  std::array<std::once_flag, 2> parted_;
  std::array<std::optional<OrderedCandidates>, 2> ordered_;
  std::array<std::once_flag, 2> scaled_;
  std::array<std::optional<FuzzyPartitions>, 2> fuzzy_;
};

/// That of the options, or one for this method alone.
[[nodiscard]] std::shared_ptr<SharedScreen> shared_screen(SelectionOptions const& options);

}  // namespace thermotwin::models
