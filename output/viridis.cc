#include "output/viridis.h"

#include <algorithm>
#include <cstddef>

namespace thermotwin::output {
namespace {

constexpr std::array<std::array<double, 3>, 11> viridis_anchors = {{{0.267, 0.005, 0.329},
                                                                    {0.283, 0.141, 0.458},
                                                                    {0.254, 0.265, 0.530},
                                                                    {0.207, 0.372, 0.553},
                                                                    {0.164, 0.471, 0.558},
                                                                    {0.128, 0.567, 0.551},
                                                                    {0.135, 0.659, 0.518},
                                                                    {0.267, 0.749, 0.441},
                                                                    {0.478, 0.821, 0.318},
                                                                    {0.741, 0.873, 0.150},
                                                                    {0.993, 0.906, 0.144}}};

}  // namespace

std::array<double, 3> viridis(double share) {
  double const at = share * (viridis_anchors.size() - 1);
  auto const below = std::min(static_cast<std::size_t>(at), viridis_anchors.size() - 2);
  double const rest = at - static_cast<double>(below);
  std::array<double, 3> colour{};
  for (std::size_t i = 0; i < 3; ++i)
    colour[i] = (1 - rest) * viridis_anchors[below][i] + rest * viridis_anchors[below + 1][i];
  return colour;
}

}  // namespace thermotwin::output
