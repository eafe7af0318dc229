#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "thermal/body.h"
#include "thermal/material.h"
#include "twin/description.h"

namespace thermotwin::twin {

/// Adds to `weights` what a block's warming does to a displacement channel (physics.md 3.6, Maysel):
///
///   e = Σ wᵢ θᵢ,  wᵢ = α ∫ tr σ̂ φᵢ dV,
///
/// with σ̂ the stress under a unit load at `point` (a unit moment about the direction for a rotation), the block held at
/// its `fixed` face and loaded at its `loaded` face (see ElasticBlock), and φᵢ the linear interpolation between the
/// centres of the cells: a linear temperature field is met exactly, whatever the mesh (physics.md 3.4).
///
/// The loop is a chain of blocks from the table to the tool: each enters with what it does to the rest, which it
/// carries like a rigid body; so the weights of different blocks add.
///
/// The solutions come from the file that `thermotwin weights` has written beside the machine's, or are those of a beam.
/// InputError that names that command when they are not there.
void add_influence(std::vector<std::pair<int, double>>& weights, std::filesystem::path const& machine_file,
                   InfluenceDescription const& influence, std::string const& direction, thermal::Body const& body,
                   thermal::Material const& material, int first_node, bool rotation);

/// By how much a block that is 1/α warmer moves its loaded face along the direction: the block's part in the sum that
/// closes the loop (physics.md 3.8) [m].
[[nodiscard]] double closing_length(InfluenceDescription const& influence, std::string const& direction,
                                    thermal::Body const& body);

}  // namespace thermotwin::twin
