#pragma once

#include <string>

namespace thermotwin::twin {

/// The parts of a campaign that a process makes: those whose number leaves `index` when divided by `count`.
struct Share {
  int index = 0, count = 1;
};

/// "3/16": share 3 of 16, counted from 0. InputError otherwise.
[[nodiscard]] Share share_of(std::string const& text);

}  // namespace thermotwin::twin
