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
///   e = Σ wᵢ θᵢ,  wᵢ = α ∫_cell tr σ̂ dV,
///
/// with σ̂ the stress under a unit load at `point` (a unit moment about the direction for a rotation), the body held at
/// its `fixed` face. The weights come from the file that `thermotwin weights` has written beside the machine's; they are
/// known by a hash of everything that they depend on. InputError that names that command when they are not there.
void add_influence(std::vector<std::pair<int, double>>& weights, std::filesystem::path const& machine_file,
                   std::string const& machine, InfluenceDescription const& influence, std::string const& direction,
                   thermal::Body const& body, thermal::Material const& material, int first_node, bool rotation);

}  // namespace thermotwin::twin
