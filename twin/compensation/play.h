#pragma once

#include <atomic>
#include <functional>

#include "twin/compensation/broker.h"
#include "twin/compensation/virtual_machine.h"

namespace thermotwin::twin {

struct PlayOptions {
  BrokerOptions broker;
  Topics topics;
  double speed = 1.0;      ///< seconds of the run per second
  double patience = 10.0;  ///< to wait for somebody who compensates [s]
  std::function<void(double)> progress;
  std::function<void(std::string const&)> say;
};

/// Plays a recorded run over a broker: publishes readings and inputs when they are due, applies the offsets that come
/// back. Begins when the compensation of its axis is online, or without it when that takes too long. InputError when
/// that reports to work against another displacement than the run is judged by.
[[nodiscard]] PlayedRun play(VirtualMachine machine, std::string const& axis, PlayOptions options,
                             std::atomic<bool> const& stop);

[[nodiscard]] std::string played_text(PlayedRun const& run);

}  // namespace thermotwin::twin
