#pragma once

#include "twin/study/combinations.h"
#include "twin/study/studied_world.h"
#include "twin/study/study.h"

namespace thermotwin::twin {

/// A combination in a world, judged in each repetition but for the first `unclaimed` instants of each run; without
/// figures where it was refused in one of them.
[[nodiscard]] Combination judged_combination(StudiedWorld const& world, Combinations const& combinations,
                                             Combinations::One const& one, int unclaimed);

/// "improvement" of each row [%]: by how much less of the study's metric it has than the reference in the same world.
void put_improvements(StudyReport& report);

/// `means` of the rows, repetition by repetition, over worlds of the same unit, where all have as many repetitions.
void put_means(StudyReport& report);

}  // namespace thermotwin::twin
