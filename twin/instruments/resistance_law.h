#pragma once

#include <string>

namespace thermotwin::twin {

/// Platinum, R₀ = 100 Ω at 0 °C: R = R₀ (1 + A t + B t² + C t³ (t − 100 °C)), t in °C, C only below 0 °C.
/// A = 3.9083e-3, B = −5.775e-7, C = −4.183e-12. Range −200 to 850 °C. (IEC 60751)
double pt100_resistance(double temperature);

/// The inverse [K]: closed form above 0 °C, below it Newton's method to 1e-10 K.
double pt100_temperature(double resistance);

/// |ΔT| ≤ constant + slope |t|, t in °C: what a tolerance class of IEC 60751 allows.
struct ToleranceClass {
  double constant;  ///< [K]
  double slope;     ///< [K/K]
};

/// AA 0.1 + 0.0017 |t|, A 0.15 + 0.002 |t|, B 0.3 + 0.005 |t|. Throws InputError for another name.
ToleranceClass pt100_tolerance(std::string const& name);

/// R = R₂₅ exp(β (1/T − 1/T₂₅)), T₂₅ = 298.15 K: a thermistor with negative coefficient. β = 3435 to 3950 K.
double thermistor_resistance(double temperature, double resistance_25, double beta);

/// The inverse [K].
double thermistor_temperature(double resistance, double resistance_25, double beta);

}  // namespace thermotwin::twin
