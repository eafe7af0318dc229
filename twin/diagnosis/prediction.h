#pragma once

#include <Eigen/Core>

#include "twin/diagnosis/measured_run.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// What the channels of a measured run would show if the machine were as its file says: row × channel [SI].
///
/// A sensor:        τ dy/dt = T_b − χ (T_b − T_a) − y,  shown: y + b₀ + b₁ t
/// A displacement:  Σ wᵢ (Tᵢ − Tᵢ(0)) + Σ c (u^p − u(0)^p) + c_a (T_a − T_a(0)) + b₁ t, through the lag τ if it has one
///
/// with lag τ, stem loss χ, offset b₀ and drift b₁ where the file states them, and what parts add to them
/// (Machine::reading_terms). The machine starts at the run's 0, at `initial_temperature` or at that of the air.
[[nodiscard]] Eigen::MatrixXd predict(Machine const& machine, MeasuredRun const& run);

}  // namespace thermotwin::twin
