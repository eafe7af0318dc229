#pragma once

#include "thermal/physical_constant.h"

namespace thermotwin::twin {

/// Air in the path of a laser beam.
struct AirState {
  double temperature = thermal::reference_temperature;  ///< T [K]
  double pressure = 101325.0;                           ///< p [Pa]
  double humidity = 0.5;                                ///< φ, relative [1]
};

/// n − 1 of air by Edlén's equation as modified by Birch & Downs (1994), with the vapour term of the NIST Engineering
/// Metrology Toolbox (Stone & Zimmerman 2001):
///
///   n_s − 1 = 1e-8 [8342.54 + 2406147/(130 − S) + 15998/(38.9 − S)],   S = 1/λ² [µm⁻²]
///   n − 1   = (n_s − 1) p/96095.43 · [1 + 1e-8 (0.601 − 0.00972 t) p]/(1 + 0.003661 t)
///             − (292.75/T) [3.7345 − 0.0401 S] 1e-10 φ p_s(T),   t = T − 273.15 K, p in Pa
///
/// λ vacuum wavelength [m], visible light; 0…60 °C, 600…1200 hPa; ±3e-8.
/// At 20 °C, 1013.25 hPa, 50 % humidity and 633 nm: n − 1 = 2.7137e-4, ∂n/∂T = −0.955e-6/K, ∂n/∂p = +0.268e-6/hPa,
/// ∂n/∂φ = −0.0085e-6 per per cent. (physics.md §4 gives these figures; dry air has 2.7180e-4 and −0.930e-6/K.)
double refractivity(AirState const& air, double wavelength = 633e-9);

/// Saturation pressure of water vapour over water [Pa], T in kelvin, 0…350 °C. (IAPWS-IF97, eq. 30)
double saturation_pressure(double temperature);

}  // namespace thermotwin::twin
