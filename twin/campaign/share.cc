#include "twin/campaign/share.h"

#include <cstdio>
#include <fmt/format.h>

#include "thermal/error.h"

namespace thermotwin::twin {

Share share_of(std::string const& text) {
  Share share;
  char behind = '\0';
  if (std::sscanf(text.c_str(), "%d/%d%c", &share.index, &share.count, &behind) != 2 || share.index < 0 ||
      share.index >= share.count)
    throw thermal::InputError(
        fmt::format("'{}': a share is written I/N with I from 0 to N - 1, for example 3/16", text));
  return share;
}

}  // namespace thermotwin::twin
