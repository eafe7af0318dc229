#pragma once

#include <Eigen/Core>
#include <map>
#include <string>

#include "twin/elastic_mesh.h"

namespace thermotwin::twin {

/// CalculiX, the finite-element program `ccx` (Dhondt, CalculiX CrunchiX User's Manual): the one place that starts it.

/// Nodes, C3D20R elements (set ALL), one elastic material and the support that restrains nothing; steps follow.
[[nodiscard]] std::string calculix_model(ElasticMesh const& mesh, double youngs_modulus, double poisson_ratio,
                                         double expansion);

/// `*CLOAD` lines.
[[nodiscard]] std::string calculix_loads(std::map<int, Eigen::Vector3d> const& forces);

/// Runs a deck in a directory of its own, which goes afterwards, and returns what it printed to the .dat file.
/// InputError if ccx is not installed; std::runtime_error with its last words if it fails.
[[nodiscard]] std::string run_calculix(std::string const& deck);

}  // namespace thermotwin::twin
