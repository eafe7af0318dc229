#include "twin/campaign/share.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

struct Launcher {
  char const *rank, *count;
};

constexpr std::array launchers = {Launcher{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                  Launcher{"PMI_RANK", "PMI_SIZE"}, Launcher{"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}};

}  // namespace

Share share_of(std::string const& text) {
  Share share;
  char behind = '\0';
  if (std::sscanf(text.c_str(), "%d/%d%c", &share.index, &share.count, &behind) != 2 || share.index < 0 ||
      share.index >= share.count)
    throw thermal::InputError(
        fmt::format("'{}': a share is written I/N with I from 0 to N - 1, for example 3/16", text));
  return share;
}

Share share_of_rank() {
  for (auto const& launcher : launchers) {
    char const *const rank = std::getenv(launcher.rank), *const count = std::getenv(launcher.count);
    if (!rank || !count) continue;
    try {
      return share_of(fmt::format("{}/{}", rank, count));
    } catch (thermal::InputError const& error) {
      throw thermal::InputError(
          fmt::format("{}/{} in the environment: {}", launcher.rank, launcher.count, error.what()));
    }
  }
  return {};
}

}  // namespace thermotwin::twin
