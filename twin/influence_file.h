#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace thermotwin::twin {

/// One elastic solution as the file holds it.
struct Solution {
  std::string remark;  ///< for people: "column: force_z on face 'z_max', held at face 'z_min'"
  std::vector<double> sums;  ///< ∫ tr σ̂ φᵢ dV of every cell, in the order of the body's nodes [m], or [1] for a moment
};

/// The elastic solutions that a machine's displacements rest on: `v450.weights` beside `v450.toml`.
[[nodiscard]] std::filesystem::path weights_file(std::filesystem::path const& machine_file);

/// Solutions by their keys as text: for each a line `# remark` and a line with its key and its sums to nine digits,
/// separated by commas.
[[nodiscard]] std::string text_of(std::map<std::string, Solution> const& solutions);
void write_solutions(std::filesystem::path const& path, std::map<std::string, Solution> const& solutions);

/// The solution of this key from the file beside the machine's, or from that of a neighbour: a machine file that was
/// copied or amended in the same folder needs no new solution.
[[nodiscard]] std::optional<std::vector<double>> find_solution(std::filesystem::path const& machine_file,
                                                               std::string const& key);

}  // namespace thermotwin::twin
