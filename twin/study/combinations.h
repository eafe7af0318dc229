#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "twin/study/study_file.h"

namespace thermotwin::twin {

/// A selection and a model, or models whose mean is taken, as a study writes them.
struct NamedCombination {
  std::string selection, model;

  [[nodiscard]] std::string name() const { return combination_name(selection, model); }
  /// Whether a world without a machine refuses it.
  [[nodiscard]] bool needs_machine() const;
  /// Selection and model both stand in one of the five papers.
  [[nodiscard]] bool of_papers() const;
};

/// The methods that stand in one of the five papers.
[[nodiscard]] std::vector<std::string> selections_of_papers();
[[nodiscard]] std::vector<std::string> models_of_papers();

/// "selection + model". InputError for anything else, and std::invalid_argument for an unknown method, as
/// named_selection() and named_models() have them.
[[nodiscard]] NamedCombination named_combination(std::string const& text);

/// Each of the study's `selections` with each of its `models`, selection by selection; then those of `also`.
[[nodiscard]] std::vector<NamedCombination> named_combinations(StudyDescription const& study);

/// What a study combines: each selection once, and each single model once, whatever it is a part of.
struct Combinations {
  /// A selection, and the models whose mean is taken on it.
  struct One {
    NamedCombination named;
    std::size_t selection;
    std::vector<std::size_t> models;
  };

  explicit Combinations(StudyDescription const& study);

  std::vector<std::string> selection_names;  ///< as the study writes them
  std::vector<NamedSelection> selections;
  std::vector<NamedModel> models;
  std::vector<One> all;

  /// Those that some combination takes on what the selection chooses, ascending.
  [[nodiscard]] std::vector<std::size_t> models_on(std::size_t selection) const;
};

}  // namespace thermotwin::twin
