#include <cmath>
#include <fmt/format.h>

#include "thermal/units.h"
#include "twin/campaign/campaign.h"

namespace thermotwin::twin {

Setting CampaignParameter::at(double share) const {
  double const number =
      logarithmic ? from * std::pow(to / from, share) : (1.0 - share) * from + share * to;  // exact at both ends
  auto const digits = thermal::format_number(number);
  return {path, unit.empty() ? digits : digits + " " + unit};
}

Setting CampaignParameter::value(std::int64_t k) const {
  if (!values.empty()) return {path, values[std::size_t(k)]};
  return at(count > 1 ? double(k) / double(count - 1) : 0.0);
}

}  // namespace thermotwin::twin
