#include "output/picture_scale.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace thermotwin::output {
namespace {

constexpr double tolerance = 1e-9;   // of a step, against numbers that are round only nearly
constexpr double told_apart = 1e-8;  // of a number, by the ten digits of a tick

}  // namespace

double round_down(double x) {
  double const decade = std::pow(10.0, std::floor(std::log10(x) + tolerance));
  for (double const factor : {5.0, 2.0})
    if (x >= factor * decade * (1 - tolerance)) return factor * decade;
  return decade;
}

Ticks round_ticks(double low, double high, double smallest_span) {
  double const middle = 0.5 * low + 0.5 * high;
  double const half = 0.5 * std::max({high - low, smallest_span, told_apart * std::abs(middle)});
  double const step = round_down(2 * half / 4);
  double const first = std::floor((middle - half) / step + tolerance);
  double const last = std::ceil((middle + half) / step - tolerance);
  int const decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + tolerance)));
  return {first * step, step, static_cast<int>(last - first) + 1, decimals};
}

std::string time_text(double time_s) {
  auto const seconds = std::llround(time_s);
  if (seconds >= 3600) return fmt::format("{} h {:02} min", seconds / 3600, seconds / 60 % 60);
  if (seconds >= 60) return fmt::format("{} min {:02} s", seconds / 60, seconds % 60);
  return fmt::format("{} s", seconds);
}

std::string magnification_text(double magnification) {
  if (magnification < 1000) return fmt::format("{:g}", magnification);
  auto const whole = std::llround(magnification);
  auto const thousands = whole / 1000;
  return fmt::format("{},{:03}", magnification_text(static_cast<double>(thousands)), whole % 1000);
}

}  // namespace thermotwin::output
