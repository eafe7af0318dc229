#pragma once

#include <filesystem>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "twin/elastic_block.h"
#include "twin/file/value.h"
#include "twin/influence_file.h"

namespace thermotwin::twin {

/// An elastic solution that a displacement or a rotation of a machine file rests on.
struct NeededSolution {
  std::string key;
  ElasticBlock block;
  int load = 0;

  [[nodiscard]] std::string remark() const;  ///< "column: force_z on 'z_max', held at 'z_min'"
};

/// All of them, each once. Only the tables of materials, blocks, displacements and rotations are read, for a machine
/// cannot be built before its weights are there.
[[nodiscard]] std::vector<NeededSolution> needed_solutions(Value const& document);

/// Those of them that stand beside the machine file or in the files of its neighbours, by their keys.
[[nodiscard]] std::map<std::string, Solution> known_solutions(std::filesystem::path const& machine_file,
                                                              Value const& document);

/// Solves with CalculiX what a machine file needs and the files of solutions beside it have not yet, and writes
/// `<machine>.weights` after each; says on `progress` what it does. Returns how many it solved.
int write_weights(std::filesystem::path const& machine_file, std::ostream& progress);

}  // namespace thermotwin::twin
