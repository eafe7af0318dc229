#include <cmath>
#include <fmt/format.h>

#include "thermal/units.h"
#include "twin/campaign/campaign.h"

namespace thermotwin::twin {

Setting CampaignParameter::set_to(double number) const {
  auto const digits = thermal::format_number(number);
  return {path, unit.empty() ? digits : digits + " " + unit};
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
