#pragma once

#include <fstream>
#include <string>

namespace thermotwin::block {

/// Of this program [bytes]. getrusage would count what the process that started it had taken, too.
inline long peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (long kilobytes = 0; word == "VmHWM:" && status >> kilobytes) return 1024 * kilobytes;
  return 0;
}

}  // namespace thermotwin::block
