#pragma once

#include <string_view>
#include <type_traits>
#include <vector>

#include "thermal/dual.h"

namespace thermotwin::thermal {

/// The range of a correlation's governing number (Re, Ra, Ta, a temperature) inside which its source states it.
/// Outside, the formula still gives a finite number, which is then an extrapolation.
struct Validity {
  double lower;
  double upper;
  std::string_view number;  ///< "Ra of a vertical plate"
};

/// A governing number outside its range.
struct Extrapolation {
  Validity const* range;
  double number;
};

/// Where `within` puts what it finds; nowhere, if null. Of this thread.
inline thread_local std::vector<Extrapolation>* extrapolations = nullptr;

/// Without derivatives: laws are evaluated with it only to see what `within` says (Law::watch).
using Watched = Dual<0>;

/// Stands where a formula uses a correlation. Costs nothing but in the evaluation that watches.
template <class S>
void within([[maybe_unused]] Validity const& range, [[maybe_unused]] S const& number) {
  if constexpr (std::is_same_v<S, Watched>) {
    if (extrapolations != nullptr && !(range.lower <= number.value && number.value <= range.upper))
      extrapolations->push_back({&range, number.value});
  }
}

/// The same where the correlation's part of the result outweighs another.
template <class S>
void within([[maybe_unused]] Validity const& range, [[maybe_unused]] S const& number, [[maybe_unused]] S const& part,
            [[maybe_unused]] S const& other) {
  if constexpr (std::is_same_v<S, Watched>) {
    if (part > other) within<S>(range, number);
  }
}

}  // namespace thermotwin::thermal
