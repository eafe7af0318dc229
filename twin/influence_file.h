#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace thermotwin::twin {

/// Elastic solutions that a machine's displacements rest on: `v450.weights` beside `v450.toml`. Text; each solution is
/// a line that begins with `#` and says what it is, and a line with its key and ∫ tr σ̂ φᵢ dV of every cell, in the
/// order of the body's nodes, separated by commas [m for a unit force, 1 for a unit moment].
struct InfluenceFile {
  struct Entry {
    std::string remark;  ///< "column: force_z on z_max, held at z_min"
    std::vector<double> sums;
  };
  std::map<std::string, Entry> entries;  ///< by key

  [[nodiscard]] static std::filesystem::path beside(std::filesystem::path const& machine_file);
  /// Empty if there is no such file; InputError if it is damaged.
  [[nodiscard]] static InfluenceFile read(std::filesystem::path const& path);
  void write(std::filesystem::path const& path) const;
};

/// The solution of this key from the file beside the machine's, or from that of a neighbour: a machine file that was
/// copied or amended in the same folder needs no new solution.
[[nodiscard]] std::optional<std::vector<double>> find_solution(std::filesystem::path const& machine_file,
                                                               std::string const& key);

}  // namespace thermotwin::twin
