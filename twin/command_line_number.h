#pragma once

#include <functional>
#include <string>

namespace thermotwin::twin {

/// For CLI::Option::check: what is wrong with the text of a number between two bounds, or empty. "5 is out of range;
/// allowed is 20 to 1000 mm".
[[nodiscard]] std::function<std::string(std::string const&)> number_between(double low, double high,
                                                                            std::string const& unit = {});

}  // namespace thermotwin::twin
