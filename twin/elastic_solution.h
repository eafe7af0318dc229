#pragma once

#include <vector>

#include "twin/elastic_block.h"

namespace thermotwin::twin {

/// ∫ tr σ̂ φᵢ dV of every cell under one of the unit loads, by CalculiX: one C3D20R element per cell, its stresses at
/// the 8 Gauss points; φᵢ interpolates linearly between the centres of the cells, and goes on straight beyond the
/// outermost.
[[nodiscard]] std::vector<double> solve_unit_load(ElasticBlock const& block, int load);

}  // namespace thermotwin::twin
