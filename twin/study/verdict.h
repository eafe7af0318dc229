#pragma once

#include "twin/study/study.h"

namespace thermotwin::twin {

/// The verdict in words, world by world: the best combination by cross-prediction RMSE with its interval, the one that
/// cross-validation within the training runs would have chosen, the best one of the papers and how much better the best
/// is than that; the same over all worlds; and every claim.
///
/// A claim holds when the 95 % interval over the repetitions lies wholly on its side, fails when wholly on the other,
/// and is undecided between. Two combinations are compared repetition by repetition, by 100 (1 − figure/other) %.
void put_verdict(StudyReport& report);

}  // namespace thermotwin::twin
