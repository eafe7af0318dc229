#pragma once

#include <cstddef>

#include "twin/study/choice.h"
#include "twin/study/combinations.h"
#include "twin/study/studied_world.h"
#include "twin/study/study.h"

namespace thermotwin::twin {

/// The truth of a world, with the best set of every size that a selection chose in it.
[[nodiscard]] SelectionTruth selection_truth(StudiedWorld const& world, Combinations const& combinations);

/// What a selection is worth in a world, in the mean of a repetition's questions; without figures where it was refused
/// in one of them. Not what it chose in cross-validation.
[[nodiscard]] SelectionFigures selection_row(StudiedWorld const& world, Combinations const& combinations,
                                             std::size_t selection, SelectionTruth const& truth);

}  // namespace thermotwin::twin
