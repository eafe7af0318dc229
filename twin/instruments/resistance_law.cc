#include "twin/instruments/resistance_law.h"

#include <cmath>
#include <fmt/format.h>
#include <vector>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "thermal/physical_constant.h"

namespace thermotwin::twin {
namespace {

using thermal::zero_celsius;

constexpr double r_0 = 100.0;
constexpr double a = 3.9083e-3;
constexpr double b = -5.775e-7;
constexpr double c = -4.183e-12;
constexpr double t_25 = 298.15;

double cubic(double t) { return t < 0.0 ? c * t * t * t * (t - 100.0) : 0.0; }
double cubic_slope(double t) { return t < 0.0 ? c * t * t * (4.0 * t - 300.0) : 0.0; }

}  // namespace

double pt100_resistance(double temperature) {
  double const t = temperature - zero_celsius;
  return r_0 * (1.0 + t * (a + b * t) + cubic(t));
}

double pt100_temperature(double resistance) {
  double const ratio = resistance / r_0;
  double t = 2.0 * (ratio - 1.0) / (a + std::sqrt(a * a + 4.0 * b * (ratio - 1.0)));
  double step = t < 0.0 ? 1.0 : 0.0;
  while (std::abs(step) > 1e-10) {
    step = (ratio - (1.0 + t * (a + b * t) + cubic(t))) / (a + 2.0 * b * t + cubic_slope(t));
    t += step;
  }
  return t + zero_celsius;
}

ToleranceClass pt100_tolerance(std::string const& name) {
  if (name == "AA") return {0.1, 0.0017};
  if (name == "A") return {0.15, 0.002};
  if (name == "B") return {0.3, 0.005};
  std::vector<std::string> const known{"AA", "A", "B"};
  throw thermal::InputError(fmt::format("tolerance class '{}'; {}", name, thermal::did_you_mean(name, known)));
}

double thermistor_resistance(double temperature, double resistance_25, double beta) {
  return resistance_25 * std::exp(beta * (1.0 / temperature - 1.0 / t_25));
}

double thermistor_temperature(double resistance, double resistance_25, double beta) {
  return 1.0 / (1.0 / t_25 + std::log(resistance / resistance_25) / beta);
}

}  // namespace thermotwin::twin
