#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "twin/assembly.h"
#include "twin/bodies.h"
#include "twin/description.h"

namespace thermotwin::twin {

/// Weights over the nodes of the network.
using NodeWeights = std::vector<std::pair<int, double>>;

/// A channel of displacement [m] or rotation [rad]: Σ wᵢ (Tᵢ(t) − Tᵢ(0)) + Σ c (u(t)^p − u(0)^p).
struct Displacement {
  std::string name, title;
  bool rotation = false;
  NodeWeights weights;
  std::vector<InputTerm> input_terms;
};

/// Adds factor · (mean temperature of a place).
void add_growth(NodeWeights& weights, Place const& place, double factor);

/// The structural loop from the table to the tool: turns the segments that a file lists into channels. Rotations come
/// first, since displacements refer to them.
class StructuralLoop {
 public:
  StructuralLoop(Assembly const& assembly, Bodies const& bodies, std::filesystem::path machine_file)
      : assembly_(assembly), bodies_(bodies), machine_file_(std::move(machine_file)) {}

  /// InputError for an unknown place or rotation, a missing length, a loop that does not close.
  void add(DisplacementDescription const& description, bool rotation);
  /// What a channel that was added does beyond its loop; once all rotations have served displacements.
  void add_beyond(DisplacementDescription const& description);

  [[nodiscard]] std::vector<Displacement> const& channels() const { return channels_; }

  [[nodiscard]] double expansion_at(Place const& place, std::optional<double> given) const;

 private:
  void add_segment(Displacement& channel, DisplacementDescription const& description, LoopSegment const& segment) const;
  void add_rotation(Displacement& channel, LoopSegment const& segment) const;
  void check_closure(DisplacementDescription const& description) const;
  [[nodiscard]] double segment_length(LoopSegment const& segment) const;

  Assembly const& assembly_;
  Bodies const& bodies_;
  std::filesystem::path machine_file_;
  std::vector<Displacement> channels_;
};

}  // namespace thermotwin::twin
