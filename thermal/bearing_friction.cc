#include "thermal/bearing_friction.h"

#include <array>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::thermal {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

struct AngleRow {
  double degrees;
  double first;
  double second;
};

constexpr std::array<AngleRow, 8> harris_table{{{10, 3.0e-4, 0.40},
                                                {15, 5.0e-4, 0.38},
                                                {20, 7.0e-4, 0.37},
                                                {25, 8.0e-4, 0.35},
                                                {30, 1.0e-3, 0.33},
                                                {35, 1.2e-3, 0.33},
                                                {40, 1.3e-3, 0.33},
                                                {90, 1.2e-3, 0.33}}};

constexpr std::array<AngleRow, 4> iso_76_table{
    {{15, 0.46, 0.92}, {25, 0.38, 0.76}, {30, 0.33, 0.66}, {40, 0.26, 0.52}}};

AngleRow interpolate(std::span<AngleRow const> table, double contact_angle, std::string const& what) {
  double const degrees = contact_angle / degree;
  constexpr double rounding = 1e-6;
  if (degrees < table.front().degrees - rounding || degrees > table.back().degrees + rounding)
    throw InputError("no " + what + " for a contact angle of " + std::to_string(degrees) + " deg; allowed: " +
                     std::to_string(table.front().degrees) + " to " + std::to_string(table.back().degrees) + " deg");
  std::size_t upper = 1;
  while (upper + 1 < table.size() && degrees > table[upper].degrees) ++upper;
  AngleRow const& a = table[upper - 1];
  AngleRow const& b = table[upper];
  double const s = (degrees - a.degrees) / (b.degrees - a.degrees);
  return {degrees, a.first + s * (b.first - a.first), a.second + s * (b.second - a.second)};
}

struct ViscousFactors {
  std::string name;
  double grease;
  double oil_bath;
};

std::vector<ViscousFactors> const& viscous_factors() {
  static std::vector<ViscousFactors> const rows = {{"angular contact ball", 2.0, 3.3},
                                                   {"angular contact ball pair", 4.0, 6.5},
                                                   {"deep groove ball", 1.0, 2.0},
                                                   {"four-point ball", 6.0, 6.0},
                                                   {"cylindrical roller", 0.8, 3.0},
                                                   {"cylindrical roller full complement", 5.0, 5.0},
                                                   {"tapered roller", 6.0, 6.0},
                                                   {"spherical roller", 6.0, 6.0},
                                                   {"needle roller", 12.0, 12.0},
                                                   {"thrust ball", 5.5, 1.5},
                                                   {"thrust cylindrical roller", 9.0, 3.5},
                                                   {"thrust needle roller", 14.0, 5.0}};
  return rows;
}

struct Lubrication {
  std::string name;
  bool grease;
  double times_bath;
};

std::vector<Lubrication> const& all_lubrications() {
  static std::vector<Lubrication> const rows = {{"grease", true, 0.0},
                                                {"oil bath", false, 1.0},
                                                {"oil bath vertical shaft", false, 2.0},
                                                {"oil injection", false, 2.0},
                                                {"oil-air", false, 0.5}};
  return rows;
}

template <class Row>
std::vector<std::string> names_of(std::vector<Row> const& rows) {
  std::vector<std::string> names;
  for (Row const& row : rows) names.push_back(row.name);
  return names;
}

template <class Row>
Row const& row_named(std::vector<Row> const& rows, std::string_view name, std::string const& what) {
  for (Row const& row : rows)
    if (edit_distance(row.name, name) == 0) return row;
  throw InputError("unknown " + what + " '" + std::string(name) + "'; " + did_you_mean(name, names_of(rows)));
}

}  // namespace

HarrisCoefficients harris_coefficients(double contact_angle) {
  AngleRow const row = interpolate(harris_table, contact_angle, "load torque coefficients z, y");
  return {row.first, row.second};
}

double static_axial_factor(double contact_angle, Arrangement arrangement) {
  AngleRow const row = interpolate(iso_76_table, contact_angle, "static axial factor Y0");
  return arrangement == Arrangement::single ? row.first : row.second;
}

double viscous_torque_factor(std::string_view bearing_type, std::string_view lubrication) {
  ViscousFactors const& factors = row_named(viscous_factors(), bearing_type, "bearing type");
  Lubrication const& kind = row_named(all_lubrications(), lubrication, "lubrication");
  return kind.grease ? factors.grease : kind.times_bath * factors.oil_bath;
}

}  // namespace thermotwin::thermal
