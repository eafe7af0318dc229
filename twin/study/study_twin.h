#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "models/batch.h"
#include "twin/study/question.h"
#include "twin/study/study_data.h"

namespace thermotwin::twin {

/// What a calibrated twin says of a world's runs, or why it says nothing.
struct TwinCourses {
  std::vector<models::Batch> runs;  ///< those of 'train', then those of 'test': rises and error without noise
  std::string refused;              ///< empty if it was calibrated
};

/// A twin of a simulated world's machine, calibrated on what the instruments showed of a question's training runs, all
/// channels of them, and then driven by the inputs alone through every run of the world.
///
/// It starts from the file that a user would have: without what the study added to the machine or set in it, and with
/// coefficients that are 20 %, capacities and weights of the structural loop that are 10 % off (vary_parameters, drawn
/// anew for each repetition). The estimate is the maximum a posteriori of estimation.h, for all numbers at once.
[[nodiscard]] TwinCourses twin_courses(StudyWorld const& world, WorldData const& data, int repetition,
                                       Question const& question);

/// The question for a model that has a twin to help it: readings and errors to learn from are what the machine shows
/// less what the twin says; what it predicts is added to what the twin says.
[[nodiscard]] Question less_twin(Question question, TwinCourses const& twin);

}  // namespace thermotwin::twin
