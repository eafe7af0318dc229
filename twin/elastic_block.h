#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "thermal/body.h"
#include "thermal/site.h"

namespace thermotwin::twin {

/// A block of the structural loop, between the face by which the loop enters it and the one by which it leaves.
///
/// The face that moves carries the rest of the machine. Its motion is the mean one, u(x) = u₀ + φ × (x − c), with u₀
/// and φ the area-weighted averages over the face; the same is held at zero on the fixed face. So a face neither warps
/// nor stretches what it is bolted to: the loop is statically determinate (physics.md 3.5 (c)), the weights of its
/// blocks add, and a block at one temperature moves the centre of its loaded face by α θ (c_loaded − c_fixed) exactly.
///
/// A unit load on the loaded face, reduced to its centre, is a traction that is linear over the face,
///
///   t(x) = F/A + (J⁻¹ M) × (x − c),   J = ∫ (|r|² 1 − r rᵀ) dA,
///
/// and so is its reaction on the fixed face. The stresses that balance it do not depend on Young's modulus.
struct ElasticBlock {
  thermal::Body body;
  double poisson_ratio = 0.3;
  thermal::Site fixed, loaded;  ///< faces, or rectangles on them
};

/// Components of a unit load on the loaded face: 1 N along an axis, or 1 N m about it.
inline constexpr std::array<char const*, 6> unit_loads = {"force_x",  "force_y",  "force_z",
                                                          "moment_x", "moment_y", "moment_z"};
/// How much of each unit load: [N] and [N m].
using Load = Eigen::Matrix<double, 6, 1>;

/// `fixed`, `loaded`: "z_max" or "z_max[0 mm .. 200 mm, 100 mm .. 900 mm]", a rectangle from the block's corner.
/// InputError if the body is no block of at least two cells, or the two are the same face.
[[nodiscard]] ElasticBlock elastic_block(thermal::Body const& body, double poisson_ratio, std::string const& fixed,
                                         std::string const& loaded);

/// The load whose work is the displacement along `direction` of a point that moves with the loaded face: 1 N there; or
/// the rotation of that face about `direction`: 1 N m.
[[nodiscard]] Load unit_load(ElasticBlock const& block, Eigen::Vector3d const& direction, Eigen::Vector3d const& point,
                             bool rotation);

/// Centre of area of a face or a rectangle on it [m].
[[nodiscard]] Eigen::Vector3d centre_of(thermal::Site const& face);

/// J = ∫ (|r|² 1 − r rᵀ) dA about that centre [m⁴].
[[nodiscard]] Eigen::Matrix3d second_moment(thermal::Site const& face);

/// Sixteen digits that name a solution: FNV-1a of everything it depends on – edges and cells of the block, Poisson
/// ratio, both faces, the unit load. Where the block stands, what it is made of otherwise and where the tool is do not
/// matter.
[[nodiscard]] std::string solution_key(ElasticBlock const& block, int load);

}  // namespace thermotwin::twin
