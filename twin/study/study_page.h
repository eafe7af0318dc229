#pragma once

#include <string>

#include "twin/study/study.h"

namespace thermotwin::twin {

/// For the terminal: per world the selections and the combinations, best first, then the verdict.
[[nodiscard]] std::string study_text(StudyReport const& report);

/// One line per combination: world, selection, model, refused, sensors, remark, then every figure as mean and
/// half-width of its 95 % interval over the repetitions. Cells without a value are empty.
[[nodiscard]] std::string study_csv(StudyReport const& report);

/// All of it, with every repetition's value.
[[nodiscard]] std::string study_json(StudyReport const& report);

}  // namespace thermotwin::twin
