#include "twin/command_line_number.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace thermotwin::twin {

std::function<std::string(std::string const&)> number_between(double low, double high, std::string const& unit) {
  auto const allowed = fmt::format("allowed is {} to {}{}{}", low, high, unit.empty() ? "" : " ", unit);
  return [=](std::string const& text) {
    double number = 0.0;
    if (!CLI::detail::lexical_cast(text, number)) return fmt::format("'{}' is no number; {}", text, allowed);
    return number >= low && number <= high ? std::string() : fmt::format("{} is out of range; {}", text, allowed);
  };
}

}  // namespace thermotwin::twin
