#include "twin/command_line_number.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "thermal/error.h"
#include "thermal/units.h"

namespace thermotwin::twin {
namespace {

/// Puts the option in front of what a parser complains of.
template <class Parse>
double of_option(char const* option, Parse parse) {
  try {
    return parse();
  } catch (thermal::InputError const& error) {
    throw thermal::InputError(fmt::format("{}: {}", option, error.what()));
  }
}

}  // namespace

std::function<std::string(std::string const&)> number_between(double low, double high, std::string const& unit) {
  auto const allowed = fmt::format("allowed is {} to {}{}{}", low, high, unit.empty() ? "" : " ", unit);
  return [=](std::string const& text) {
    double number = 0.0;
    if (!CLI::detail::lexical_cast(text, number)) return fmt::format("'{}' is no number; {}", text, allowed);
    return number >= low && number <= high ? std::string() : fmt::format("{} is out of range; {}", text, allowed);
  };
}

double option_quantity(char const* option, std::string const& text, thermal::Dimension expected) {
  return of_option(option, [&] { return thermal::parse_value(text, expected); });
}

double positive_quantity(char const* option, std::string const& text, thermal::Dimension expected) {
  double const value = option_quantity(option, text, expected);
  if (value > 0.0) return value;
  throw thermal::InputError(fmt::format("{} {}: a {} above 0 is due", option, text, thermal::name_of(expected)));
}

double option_temperature(char const* option, std::string const& text) {
  return of_option(option, [&] { return thermal::parse_temperature(text); });
}

}  // namespace thermotwin::twin
