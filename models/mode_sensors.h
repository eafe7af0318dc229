#pragma once

#include <span>

#include "models/selection.h"

namespace thermotwin::models {

/// Sensors for thermal modes (Yang, Yuan & Ni, IJMTM 39 (1999) 1367; methods.md §6.1): those that leave least unknown
/// of the error, which the modes make up. With Φ the unit shapes of the modes at the sensors (p × q), the amplitudes
/// are those of least squares, θ = X Φ⁺ᵀ of the centred readings X, and
///
///   S_xx = Φ cov(θ) Φᵀ,   s_xy = Φ cov(θ, error),   V(A) = var(error) − s_Aᵀ (S_AA + r I)⁻¹ s_A   [µm²]
///
/// is what readings of the sensors A that are rounded to the resolution, r = resolution²/12, leave of it
/// (remaining_variance.h: A-optimality; Chaloner & Verdinelli, Stat. Sci. 10 (1995) 273); the set of small V is found
/// as placements are (placement.h), and of sensors at the same place the first are taken. Where the error stands still,
/// V is of the amplitudes themselves. Φ has only the modes whose shapes at the sensors differ, by a column-pivoted QR
/// of the unit shapes at different places (pivots above 0.1): sensors at n places tell n modes apart at most, and
/// amplitudes of more would be arbitrary. Without a count: as many as there are eigenvalues of S_xx above r, at most
/// one per mode. Best first; the score is what a sensor alone takes off the error's variance [µm²].
/// std::invalid_argument unless options.mode_shapes has a row for every sensor of the batches, and some sensor sees
/// some mode.
Selection select_for_modes(std::span<Batch const> batches, SelectionOptions const& options);

}  // namespace thermotwin::models
