#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "twin/study/study_file.h"

namespace thermotwin::twin {

/// What a study combines: each selection once, and each single model once, whatever it is a part of.
struct Combinations {
  /// A selection, and the models whose mean is taken on it.
  struct One {
    std::size_t selection;
    std::vector<std::size_t> models;
    std::string model_name;
  };

  explicit Combinations(StudyDescription const& study);

  std::vector<std::string> selection_names;  ///< as the study writes them
  std::vector<NamedSelection> selections;
  std::vector<NamedModel> models;
  std::vector<One> all;

  [[nodiscard]] std::string const& selection_name(One const& one) const { return selection_names[one.selection]; }
  /// Those that some combination takes on what the selection chooses, ascending.
  [[nodiscard]] std::vector<std::size_t> models_on(std::size_t selection) const;
};

}  // namespace thermotwin::twin
