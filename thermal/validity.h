#pragma once

namespace thermotwin::thermal {

/// The range of a correlation's governing number (Re, Ra, Ta, Pr, a temperature) inside which its source states it.
/// Outside, the formula still gives a finite number, which is then an extrapolation.
struct Validity {
  double lower;
  double upper;

  [[nodiscard]] constexpr bool contains(double number) const { return lower <= number && number <= upper; }
};

}  // namespace thermotwin::thermal
