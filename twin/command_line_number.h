#pragma once

#include <functional>
#include <string>

#include "thermal/dimension.h"

namespace thermotwin::twin {

/// For CLI::Option::check: what is wrong with the text of a number between two bounds, or empty. "5 is out of range;
/// allowed is 20 to 1000 mm".
[[nodiscard]] std::function<std::string(std::string const&)> number_between(double low, double high,
                                                                            std::string const& unit = {});

/// The quantity that an option was given, in SI. "--noise: 0.1 has no unit; write for example "0.2 K"".
[[nodiscard]] double option_quantity(char const* option, std::string const& text, thermal::Dimension expected);
/// The same above 0. "--interval 0 s: a time above 0 is due".
[[nodiscard]] double positive_quantity(char const* option, std::string const& text, thermal::Dimension expected);
/// A point on the temperature scale [K].
[[nodiscard]] double option_temperature(char const* option, std::string const& text);

}  // namespace thermotwin::twin
