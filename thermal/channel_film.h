#pragma once

#include "thermal/channel_flow.h"
#include "thermal/dual.h"
#include "thermal/fluid.h"

namespace thermotwin::thermal {

/// The fluid of a number, as coefficients of laws carry it: its place in fluid_names().
[[nodiscard]] Fluid const& fluid_of_number(double number);
[[nodiscard]] double number_of_fluid(std::string_view name);

/// Heat from a channel's wall into the stream that passes: q = A (T_wall − T_fluid)/(r + 1/h(T_wall, T_fluid, ṁ)), with
/// h = channel_film of the fluid at V̇ = ṁ/ρ. Ports: wall, fluid cell.
/// c = {A of this cell's wall [m²], r from the wall's node to its surface [m² K/W], section area [m²], d_h [m], length
/// of the whole channel [m], number of the fluid}, u = {ṁ [kg/s]}.
struct ChannelFilm {
  static constexpr std::string_view name = "channel film";
  static constexpr int ports = 2, coefficients = 6, inputs = 1;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    Fluid const& medium = fluid_of_number(value_of(c[5]));
    S const volume_flow = u[0] / properties(medium, T[1]).density;
    S const h = channel_film<S>(medium, T[0], T[1], volume_flow, c[2], c[3], c[4]);
    S const into_fluid = c[0] * (T[0] - T[1]) / (c[1] + 1.0 / h);
    q[0] = -into_fluid;
    q[1] = into_fluid;
  }
};

}  // namespace thermotwin::thermal
