#pragma once

#include <memory>
#include <string>
#include <vector>

#include "output/dataset.h"
#include "twin/machine.h"
#include "twin/study/judgement.h"
#include "twin/study/question.h"
#include "twin/study/study_data.h"

namespace thermotwin::twin {

/// What a calibrated twin says of a world's runs, all channels, or why it says nothing.
struct TwinRuns {
  std::vector<output::Dataset> runs;         ///< those of 'train', then those of 'test'; what it says is their truth
  std::string refused;                       ///< empty if it was calibrated
  std::shared_ptr<Machine const> machine{};  ///< the calibrated one
};

/// A twin of a world's machine, calibrated on what the instruments showed of a question's training rows, all channels
/// of them, and then driven by the inputs alone through every run of the world.
///
/// In a simulated world it starts from the file that a user would have: without what the study added to the machine or
/// set in it, and with coefficients that are 20 %, capacities and weights of the structural loop that are 10 % off
/// (vary_parameters, drawn anew for each repetition). Where all runs were measured it starts from the file as the study
/// has it. The estimate is the maximum a posteriori of estimation.h, for all numbers at once, first with the noise that
/// is expected and then with what is heard in the residuals; of several starts (start.h), noise counted, the likeliest.
[[nodiscard]] TwinRuns twin_runs(StudyWorld const& world, WorldData const& data, int repetition,
                                 Question const& question);

/// Worlds that differ by what they ask of the same runs share a twin: it is the same for questions of one key.
[[nodiscard]] std::string twin_key(StudyWorld const& world, WorldData const& data, int repetition,
                                   Question const& question);

/// The question for a model that has a twin to help it: readings and errors to learn from are what the machine shows
/// less what the twin says; what it predicts is added to what the twin says. A measured displacement has a zero of its
/// own in each run, of those trained on too: it is that of the training rows, or of the first instant where a run has
/// none.
[[nodiscard]] Question less_twin(Question question, StudyWorld const& world, WorldData const& data, int repetition,
                                 TwinRuns const& twin);

/// The calibrated twin with its state corrected by these sensors (columns of the world's), an extended Kalman filter
/// (twin_observer.h), through every run that a question asks about. Each reading errs by 0.1 K; what each node errs by
/// is the one of three values with which the displacement of the training rows is met best. A measured run has no past
/// here: the twin begins with the first readings, as warm as the air or as they tell.
[[nodiscard]] FittedModel observed(StudyWorld const& world, WorldData const& data, int repetition,
                                   Question const& question, Machine const& twin,
                                   std::vector<Eigen::Index> const& columns);

/// What is to be said of a world's measured runs where an observer follows them, under their names.
[[nodiscard]] std::vector<std::string> observer_remarks(StudyWorld const& world, WorldRuns const& runs);

}  // namespace thermotwin::twin
