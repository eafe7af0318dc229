#include "twin/instruments/air_refraction.h"

#include <cmath>

#include "thermal/physical_constant.h"

namespace thermotwin::twin {

double saturation_pressure(double temperature) {
  double const theta = temperature - 0.23855557567849 / (temperature - 650.17534844798);
  double const a = theta * theta + 1167.0521452767 * theta - 724213.16703206;
  double const b = -17.073846940092 * theta * theta + 12020.82470247 * theta - 3232555.0322333;
  double const c = 14.91510861353 * theta * theta - 4823.2657361591 * theta + 405113.40542057;
  double const root = 2.0 * c / (-b + std::sqrt(b * b - 4.0 * a * c));
  return 1e6 * std::pow(root, 4);
}

double refractivity(AirState const& air, double wavelength) {
  double const micrometres = wavelength * 1e6;
  double const s = 1.0 / (micrometres * micrometres);
  double const t = air.temperature - thermal::zero_celsius;
  double const p = air.pressure;
  double const standard = 1e-8 * (8342.54 + 2406147.0 / (130.0 - s) + 15998.0 / (38.9 - s));
  double const density = p / 96095.43 * (1.0 + 1e-8 * (0.601 - 0.00972 * t) * p) / (1.0 + 0.003661 * t);
  double const vapour = 292.75 / air.temperature * (3.7345 - 0.0401 * s) * 1e-10 * air.humidity;
  return standard * density - vapour * saturation_pressure(air.temperature);
}

}  // namespace thermotwin::twin
