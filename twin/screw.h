#pragma once

#include <string>

#include "thermal/ball_screw.h"
#include "twin/assembly.h"
#include "twin/bodies.h"
#include "twin/description.h"
#include "twin/structural_loop.h"

namespace thermotwin::twin {

/// A ball screw as built: positions at which its error is a channel.
struct Screw {
  BallScrewDescription description;
  thermal::BallScrew screw;
  NodeWeights seat_growth;       ///< by how much the bearings' seats part [m/K]
  NodeWeights reference_strain;  ///< of what the position is measured against [1/K]
  NodeWeights zero_shift;        ///< of all positions alike [m/K]
  int first_node = 0;

  /// "E_P_120mm": of the error with the nut at x [m].
  [[nodiscard]] std::string channel_at(double x) const;
  /// Whether that error is Σ wᵢ (Tᵢ − Tᵢ(0)) at all temperatures: its far bearing holds both ways, or does not hold.
  [[nodiscard]] bool is_linear() const;
  /// These weights, where it is.
  [[nodiscard]] NodeWeights weights_at(double x) const;
};

/// On a body that is a bar, with what the parts so far add to its displacements; the loop says how much its seats and
/// its reference grow. InputError for an unknown place.
[[nodiscard]] Screw screw_of(BallScrewDescription const& description, Assembly const& assembly, Bodies const& bodies,
                             StructuralLoop const& loop);

}  // namespace thermotwin::twin
