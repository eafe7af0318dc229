#include "twin/complete_rows.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

/// "no value of E_X in 3, of T2 in 12"
std::string lacks(std::vector<output::Channel const*> const& channels) {
  std::vector<std::string> counts;
  for (auto const* channel : channels)
    if (auto const missing = (!channel->values.array().isFinite()).count(); missing > 0)
      counts.push_back(fmt::format("{} in {}", channel->name, missing));
  return fmt::format("no value of {}", fmt::join(counts, ", of "));
}

}  // namespace

std::vector<Eigen::Index> complete_rows(std::vector<output::Channel const*> const& channels, std::string const& run,
                                        std::vector<std::string>& remarks) {
  Eigen::Index const rows = channels.front()->values.size();
  std::vector<Eigen::Index> complete;
  for (Eigen::Index i = 0; i < rows; ++i)
    if (std::all_of(channels.begin(), channels.end(), [&](auto const* c) { return std::isfinite(c->values[i]); }))
      complete.push_back(i);
  if (complete.empty())
    throw thermal::InputError(fmt::format("{}: none of its {} rows is complete: {}{}{}", run, rows, lacks(channels),
                                          remarks.empty() ? "" : "; ", fmt::join(remarks, "; ")));
  if (Eigen::Index(complete.size()) < rows)
    remarks.push_back(
        fmt::format("{} of {} rows are left out: {}", rows - Eigen::Index(complete.size()), rows, lacks(channels)));
  if (complete.front() > 0)
    remarks.push_back(
        fmt::format("changes count from row {}, the first in which all have a value", complete.front() + 1));
  return complete;
}

}  // namespace thermotwin::twin
