#pragma once

/// What moves for a part of the time, as a law sees it by u = {mean ω, ω while moving}: Assembly::friction_channels.
namespace thermotwin::twin {

/// The speed while moving, which is 0 where a record has no feed although the screw turns.
inline double moving_speed(double const* u) { return u[1] > 0.0 ? u[1] : u[0]; }

/// The share of the time in motion; 1 of what never moves.
inline double share_of_motion(double const* u) {
  double const speed = moving_speed(u);
  return speed > 0.0 ? u[0] / speed : 1.0;
}

/// f(ω) as its mean over motion and rest.
template <class Function>
auto mean_over_motion(double const* u, Function const& f) {
  double const share = share_of_motion(u);
  auto result = f(moving_speed(u));
  if (share < 1.0) result = share * result + (1.0 - share) * f(0.0);
  return result;
}

}  // namespace thermotwin::twin
