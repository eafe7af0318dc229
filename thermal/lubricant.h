#pragma once

#include <array>
#include <cmath>

#include "thermal/physical_constant.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Vogel's law of kinematic viscosity: ν(T) = A exp(B/(T − T_p)) [m²/s], T in kelvin.
///
/// T_p = 178.15 K gives Vogel–Cameron, ν = A exp(B/(T[°C] + 95)), for mineral oils of viscosity index about 95;
/// T_p = 0 gives Andrade's law. Source: Jungnickel 2010, eq. 4.23; physics.md (1.6).
struct Vogel {
  double scale = 0.0;        ///< A [m²/s]
  double temperature = 0.0;  ///< B [K]
  double pole = 178.15;      ///< T_p [K]
};

inline constexpr Validity vogel_cameron_temperature{273.15, 373.15, "temperature of oil or grease [K]"};

/// ν(T) [m²/s]; A [m²/s], B [K], T [K], with the pole of Vogel–Cameron.
template <class S>
S vogel_cameron_viscosity(S const& scale, S const& vogel_temperature, S const& temperature) {
  using std::exp;
  within<S>(vogel_cameron_temperature, temperature);
  return scale * exp(vogel_temperature / (temperature - Vogel{}.pole));
}

/// ν(T) [m²/s].
template <class S>
S viscosity(Vogel const& law, S const& temperature) {
  using std::exp;
  within<S>(vogel_cameron_temperature, temperature);
  return law.scale * exp(law.temperature / (temperature - law.pole));
}

/// The Vogel law without a pole through two measured points (ν₁, T₁), (ν₂, T₂).
[[nodiscard]] Vogel andrade_through(double viscosity1, double temperature1, double viscosity2, double temperature2);

/// Constants of the oil of ISO viscosity grade 10, 15, 22, 32, 46, 68 or 100 (physics.md §1.3).
/// For a grease: its base oil, for spindle greases 15 to 25 mm²/s at 40 °C. Throws InputError for any other grade.
[[nodiscard]] Vogel mineral_oil_viscosity(int iso_grade);

inline constexpr std::array iso_viscosity_grades{10, 15, 22, 32, 46, 68, 100};

/// Walther's law (ASTM D341): log₁₀ log₁₀(ν + 0.7) = A − B log₁₀ T, ν in mm²/s, 2 to 2e4, T in kelvin; for tabulated
/// oils.
struct Walther {
  double intercept = 0.0;  ///< A
  double slope = 0.0;      ///< B
};

/// The law through two measured points (ν₁, T₁), (ν₂, T₂) [m²/s, K], as a data sheet gives them at 40 and 100 °C.
[[nodiscard]] Walther walther_through(double viscosity1, double temperature1, double viscosity2, double temperature2);

/// ν(T) [m²/s].
template <class S>
S viscosity(Walther const& law, S const& temperature) {
  using std::exp;
  using std::log10;
  constexpr double ln10 = 2.302585092994045684;
  S const double_logarithm = law.intercept - law.slope * log10(temperature);
  return 1e-6 * (exp(ln10 * exp(ln10 * double_logarithm)) - 0.7);
}

}  // namespace thermotwin::thermal
