#include <cmath>
#include <fmt/format.h>

#include "thermal/units.h"
#include "twin/campaign/campaign.h"

namespace thermotwin::twin {
namespace {

/// A whole number keeps its digits: 1e+05 is none to a key that wants one.
std::string digits_of(double number) {
  constexpr double exact = 9007199254740992.0;  // 2⁵³
  if (number == std::floor(number) && std::abs(number) < exact) return fmt::format("{:.0f}", number);
  return thermal::format_number(number);
}

}  // namespace

Setting CampaignParameter::set_to(double number) const {
  auto const digits = digits_of(number);
  return {path, unit.empty() ? digits : digits + " " + unit};
}

double CampaignParameter::position(std::int64_t k) const {
  return numbers.empty() ? double(k) : numbers[std::size_t(k)];
}

Setting CampaignParameter::at(double share) const {
  return set_to(logarithmic ? from * std::pow(to / from, share) : from + share * (to - from));
}

/// Of whole numbers between whole numbers, whole numbers.
Setting CampaignParameter::value(std::int64_t k) const {
  if (!values.empty()) return {path, values[std::size_t(k)]};
  if (count == 1) return set_to(from);
  if (logarithmic) return at(double(k) / double(count - 1));
  return set_to((from * double(count - 1 - k) + to * double(k)) / double(count - 1));
}

}  // namespace thermotwin::twin
