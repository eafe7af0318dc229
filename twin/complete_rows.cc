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
  return complete;
}

Eigen::Index first_value(output::Channel const& channel, std::vector<std::string>& remarks) {
  auto const& values = channel.values;
  auto const first = std::find_if(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  auto const row = first == values.end() ? 0 : first - values.begin();
  if (row > 0)
    remarks.push_back(fmt::format("changes of {} count from row {}, where its values begin, and not from the first",
                                  channel.name, row + 1));
  return row;
}

}  // namespace thermotwin::twin
