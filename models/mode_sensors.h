#pragma once

#include <Eigen/Core>
#include <span>

#include "models/selection.h"

namespace thermotwin::models {

/// How thermal modes show in readings and error. With Φ the mode shapes at the sensors (p × q) and X the centred
/// readings, the amplitudes are those of least squares, θ = X Φ⁺ᵀ.
struct ModeParticipation {
  Eigen::VectorXd deviation;    ///< q: of θ_i, times the norm of its shape [K]
  Eigen::VectorXd correlation;  ///< q: of θ_i with the error; 1 where the error stands still
};
ModeParticipation participation(Eigen::MatrixXd const& mode_shapes, Eigen::MatrixXd const& temperature_rise,
                                Eigen::VectorXd const& error);

/// Sensors for thermal modes (Yang, Yuan & Ni, IJMTM 39 (1999) 1367; methods.md §6.1): rows of
///
///   W = Φ diag(w_i),   w_i = deviation of θ_i × |its correlation with the error|  [K]
///
/// that span its columns, by column-pivoted QR of Wᵀ: first the sensor that sees most of what moves the error, then the
/// one that sees most of what the first cannot tell. Φ has only the modes whose shapes at the sensors differ, by a
/// column-pivoted QR of the unit shapes at different places (pivots above 0.1): sensors at n places tell n modes apart
/// at most, and amplitudes of more would be arbitrary. A pivot of W below the rounding of the readings (resolution/√12)
/// tells nothing more; if further sensors are asked for, the pivoting starts again among the rest, so that modes are
/// seen twice. Without a count: as many as pivots above that, at most one per mode. The score is the length of a
/// sensor's row of W [K]. std::invalid_argument unless options.mode_shapes has a row for every sensor of the batches,
/// and some sensor sees some mode.
Selection select_for_modes(std::span<Batch const> batches, SelectionOptions const& options);

}  // namespace thermotwin::models
