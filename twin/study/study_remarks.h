#pragma once

#include <string>
#include <vector>

#include "twin/study/combinations.h"
#include "twin/study/studied_world.h"

namespace thermotwin::twin {

/// What is to be said of the worlds' runs, questions and observers: each remark once, behind the names of the worlds
/// that it is about, and in how many of their repetitions it is so where that is not all.
[[nodiscard]] std::vector<std::string> study_remarks(std::vector<StudiedWorld> const& worlds,
                                                     Combinations const& combinations);

}  // namespace thermotwin::twin
