#pragma once

#include <span>
#include <string>
#include <string_view>

#include "thermal/dimension.h"

namespace thermotwin::thermal {

/// SI value = number · numerator / denominator: two factors, so that "250 um" is the double nearest to 250e-6.
struct Unit {
  Dimension dimension;
  double numerator = 1.0;
  double denominator = 1.0;
  bool absolute = false;  ///< degC, degF: a point on the scale
  double zero = 0.0;      ///< of the scale, above absolute zero in its own degrees: SI value = (number + zero) · …

  [[nodiscard]] double si(double number) const;
  [[nodiscard]] double number(double si) const;
};

/// Reads a unit as parse_quantity describes it, in ASCII; `text` is what messages quote. Throws InputError, which
/// offers one of `usual` for an unknown unit that stands alone; by default any unit.
Unit read_unit(std::string_view unit, std::string_view text, std::span<std::string_view const> usual = {});

/// Writes the usual non-ASCII signs in letters: µ, °C, ⁻¹, ², ³, ·, Ω, spaces that do not break; without spaces at its
/// ends.
std::string in_ascii(std::string_view text);

}  // namespace thermotwin::thermal
