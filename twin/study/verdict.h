#pragma once

#include "twin/study/study.h"

namespace thermotwin::twin {

/// The verdict in words, world by world: the best combination by cross-prediction RMSE with its interval, the one that
/// cross-validation within the training runs would have chosen, the best one of the papers and how much better the best
/// is than that; the same over all worlds; and every claim.
///
/// A combination is better that has less of a claim's figure, or more of it where more_is_better(). A claim holds when
/// the 95 % interval over the repetitions lies wholly on its side, fails when wholly on the other, and is undecided
/// between; equal figures in every repetition are not less, but no more and no worse. Two combinations are compared
/// repetition by repetition, by the differences other − figure − improvement |other|, the first two with the opposite
/// sign where more is better; words give other − figure in % of the other's mean. Of a single repetition the sign
/// decides, and the words say that it has no interval.
void put_verdict(StudyReport& report);

}  // namespace thermotwin::twin
