#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "models/shared_screen.h"
#include "twin/machine.h"
#include "twin/study/choice.h"
#include "twin/study/combinations.h"
#include "twin/study/judgement.h"
#include "twin/study/question.h"
#include "twin/study/study_modes.h"

namespace thermotwin::twin {

/// A question, and what selections and models make of it.
struct StudyTrial {
  Question question;
  StudyTrial const* trained_alike = nullptr;  ///< the first, of a world before: what is learnt there is learnt here
  StudyTrial const* read_alike = nullptr;     ///< ... but for the errors, which may be others
  ModeShapes const* modes = nullptr;          ///< where a selection asks for them
  std::shared_ptr<models::SharedScreen> screen = std::make_shared<models::SharedScreen>();  ///< for all selections
  std::vector<Choice> choices{};                                                            ///< per selection
  std::vector<std::map<std::vector<Eigen::Index>, FittedModel>> fits{};                     ///< per single model
  std::string twin_refused{};                                                               ///< empty: it was not
  std::shared_ptr<Machine const> twin{};                                                    ///< calibrated
  Question less_twin{};                                                                     ///< where there is one

  /// What a model is asked: beside a twin, what that errs by.
  [[nodiscard]] Question const& asked(NamedModel const& model) const { return model.twin ? less_twin : question; }
  /// Where the selection chose before from all that it sees here; none: it is to choose.
  [[nodiscard]] StudyTrial const* choice_before(NamedSelection const& selection) const {
    return sees_error(selection) ? trained_alike : read_alike;
  }
};

/// One draw of a world's instruments and of random starts.
struct Repetition {
  int number;                        ///< within its world
  std::vector<std::string> remarks;  ///< of its questions
  std::vector<StudyTrial> trials;    ///< fits, then validations
  std::size_t fits;                  ///< how many of them

  [[nodiscard]] std::uint64_t seed() const { return 1 + std::uint64_t(number); }
};

struct StudiedWorld {
  StudyWorld const& description;
  WorldData data;
  std::vector<Repetition> repetitions{};
  std::map<std::vector<RunPart>, ModeShapes> modes{};  ///< by where the machine is linearised

  /// "in 1 of 5 repetitions, T10 stands still", of what is not so in all.
  [[nodiscard]] std::string in_some(std::string const& what, std::size_t of_repetitions) const;
  /// The first instants of each run that one of its models does not claim: a model that skips the start of a run is
  /// compared with others on the rest alone.
  [[nodiscard]] int unclaimed_instants() const;
};

/// The worlds of a study with all that is asked in them. What is learnt in one of them from the same readings, errors
/// and random numbers as in one before is found there: what is tested changes nothing of what is learnt.
[[nodiscard]] std::vector<StudiedWorld> studied_worlds(StudyDescription const& study, std::vector<WorldData> data,
                                                       Combinations const& combinations);

}  // namespace thermotwin::twin
