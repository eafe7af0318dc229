#include "thermal/lubricant.h"

#include <string>

#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

constexpr std::array<Vogel, iso_viscosity_grades.size()> oils{{
    {0.1000e-6, 623.0},
    {0.0932e-6, 687.0},
    {0.0870e-6, 748.0},
    {0.0813e-6, 808.0},
    {0.0762e-6, 866.0},
    {0.0710e-6, 929.0},
    {0.0662e-6, 990.0},
}};

double walther_ordinate(double viscosity) { return std::log10(std::log10(viscosity * 1e6 + 0.7)); }

}  // namespace

Vogel andrade_through(double viscosity1, double temperature1, double viscosity2, double temperature2) {
  double const b = std::log(viscosity1 / viscosity2) / (1.0 / temperature1 - 1.0 / temperature2);
  return {viscosity1 * std::exp(-b / temperature1), b, 0.0};
}

Vogel mineral_oil_viscosity(int iso_grade) {
  std::string known;
  for (std::size_t i = 0; i < iso_viscosity_grades.size(); ++i) {
    if (iso_viscosity_grades[i] == iso_grade) return oils[i];
    known += (known.empty() ? "" : ", ") + std::to_string(iso_viscosity_grades[i]);
  }
  throw InputError("no oil of ISO viscosity grade " + std::to_string(iso_grade) + "; known: " + known);
}

Walther walther_through(double viscosity1, double temperature1, double viscosity2, double temperature2) {
  double const w1 = walther_ordinate(viscosity1);
  double const w2 = walther_ordinate(viscosity2);
  double const slope = (w1 - w2) / std::log10(temperature2 / temperature1);
  return {w1 + slope * std::log10(temperature1), slope};
}

}  // namespace thermotwin::thermal
