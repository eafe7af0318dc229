#pragma once

#include <string>
#include <vector>

#include "twin/file/schema.h"
#include "twin/sensitivity.h"

namespace thermotwin::twin {

/// `[[uncertain]]`: a number of the machine file of which its author knows the range only.
struct UncertainRange {
  std::string name, from, to;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &UncertainRange::name, "of a number of this file, by its path: bearing.front.grease_factor");
    f.name("from", &UncertainRange::from, "lower end, as text with the number's unit");
    f.name("to", &UncertainRange::to, "upper end");
  }
};

/// A range with the number that it is of, in SI.
struct RangedNumber {
  Parameter number;
  double low = 0.0, high = 0.0;
};

/// The ranges that a machine file states, in its order. FileError where the number is not there, the ends have another
/// dimension or are the wrong way round, or the number lies outside.
[[nodiscard]] std::vector<RangedNumber> ranged_numbers(Value const& document);

}  // namespace thermotwin::twin
