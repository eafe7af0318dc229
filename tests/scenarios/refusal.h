#pragma once

#include <string>

#include "thermal/error.h"

namespace thermotwin::tests {

/// What an action says when it refuses its input; "accepted" if it does not.
template <class Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (thermal::InputError const& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace thermotwin::tests
