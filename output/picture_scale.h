#pragma once

#include <string>

/// The numbers and words on a picture.
namespace thermotwin::output {

/// Evenly spaced ticks at round numbers that enclose [low, high], four to nine of them.
struct Ticks {
  double first;
  double step;
  int count;
  int decimals;  ///< that the numbers need
};
/// A span below the smallest is shown as one of that size: what differs by less is one colour, not noise [K]. So is one
/// below 1e-8 of the numbers themselves: its ticks would read the same.
[[nodiscard]] Ticks round_ticks(double low, double high, double smallest_span = 0.4);

/// Displacement as it is shown at most, of the machine's diagonal.
inline constexpr double largest_shown = 0.05;

/// 1, 2 or 5 times a power of ten, the largest that is not above x > 0.
[[nodiscard]] double round_down(double x);

/// "4 h 00 min", "12 min 30 s", "45 s".
[[nodiscard]] std::string time_text(double time_s);

/// "5,000", "0.5".
[[nodiscard]] std::string magnification_text(double magnification);

}  // namespace thermotwin::output
