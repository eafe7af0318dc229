#pragma once

#include <vector>

#include "twin/elastic_block.h"

namespace thermotwin::twin {

/// ∫ tr σ̂ φᵢ dV of every cell under a unit load; φᵢ interpolates linearly between the centres of the cells, and goes on
/// straight beyond the outermost. Integrated at the 8 Gauss points of each cell.

/// By CalculiX, for one of the unit loads: one C3D20R element per cell.
[[nodiscard]] std::vector<double> solve_unit_load(ElasticBlock const& block, int load);

/// After Saint-Venant, for a block between two whole opposite faces, held and loaded like a beam:
///
///   tr σ̂ = n · [F/A + (J⁻¹ M(s)) × r],  M(s) = M + (c_loaded − c(s)) × F,  n along the beam.
///
/// So a section at mean temperature θ̄ grows by α θ̄, and one with a gradient across its height bends by κ = (α/I) ∫θ z
/// dA (physics.md 3.5). Exact for a gradient that does not change along the beam, 5 to 10 % off for stout blocks with
/// strongly curved fields. Needs no CalculiX. InputError for other faces.
[[nodiscard]] std::vector<double> beam_solution(ElasticBlock const& block, Load const& load);

}  // namespace thermotwin::twin
