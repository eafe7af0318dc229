#pragma once

#include <Eigen/Core>
#include <vector>

#include "twin/diagnosis/measured_run.h"
#include "twin/input_motion.h"
#include "twin/machine.h"
#include "twin/room_air.h"

namespace thermotwin::twin {

/// A channel of the data in a machine, and what lies between that machine and the channel's number: what the file
/// states of the instrument, and what parts add to it (Machine::reading_terms).
///
///   A sensor:        x = T_b − χ (T_b − T_a)
///   A displacement:  x = Σ wᵢ (Tᵢ − Tᵢ(0)) + Σ c (u^p − u(0)^p) + c_a (T_a − T_a(0))
///   Shown:           y + b₀ + b₁ t,  τ dy/dt = x − y
///
/// with lag τ (of sensors), share of the air χ, offset b₀ and drift b₁; T_a the air at the sensor, or near the tool.
struct ChannelReading {
  Sensor const* sensor = nullptr;
  Displacement const* displacement = nullptr;  ///< neither: the machine does not have it
  double lag = 0.0;                            ///< [s]
  double air_share = 0.0;                      ///< of the way from the body's temperature to the air's
  double offset = 0.0;                         ///< [K]
  double drift = 0.0;                          ///< [K/s, m/s]
  double per_air = 0.0;                        ///< [m/K]
  double height = 0.0;                         ///< of the air that it meets [m]
  RoomAir air;                                 ///< of the run
  InputMotion motion;                          ///< of the displacement

  /// x, from Σ wᵢ Tᵢ of a sensor's nodes or Σ wᵢ (Tᵢ − Tᵢ(0)) of a displacement's, with the values of the course's
  /// channels then and at the start.
  [[nodiscard]] double before_lag(double of_nodes, std::vector<double> const& inputs,
                                  std::vector<double> const& at_start) const;
  /// From y at these times [s].
  [[nodiscard]] Eigen::VectorXd shown(Eigen::VectorXd const& behind_lag, Eigen::VectorXd const& time) const;
};

/// Of every channel of the run.
[[nodiscard]] std::vector<ChannelReading> readings_of(Machine const& machine, MeasuredRun const& run);

}  // namespace thermotwin::twin
