#pragma once

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace thermotwin::twin::tests {

/// The one that is meant; a test fails where there is none, or more.
template <class Range, class Meant>
auto only(Range const& range, Meant meant) {
  auto const count = std::count_if(range.begin(), range.end(), meant);
  if (count != 1) throw std::logic_error(fmt::format("{} are meant, not one", count));
  return *std::find_if(range.begin(), range.end(), meant);
}

}  // namespace thermotwin::twin::tests
