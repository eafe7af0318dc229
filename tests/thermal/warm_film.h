#pragma once

#include <string_view>

#include "thermal/laws.h"
#include "thermal/smooth.h"

namespace thermotwin::thermal {

/// q = G (1 + 0.3 |ΔT|^{1/3}) ΔT.
struct WarmFilm {
  static constexpr std::string_view name = "warm film";
  static constexpr int ports = 2, coefficients = 1, inputs = 0;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const*, S* q) {
    exchange<S>(c[0] * (1.0 + 0.3 * smooth_power<S>(T[1] - T[0], 1.0 / 3.0)) * (T[1] - T[0]), q);
  }
};

}  // namespace thermotwin::thermal
