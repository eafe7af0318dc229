#include "twin/needed_channels.h"

#include <algorithm>

namespace thermotwin::twin {

std::vector<std::string> needed_channels(Machine const& machine) {
  auto const& network = machine.network();
  std::vector<std::string> names(network.channel_names().begin(),
                                 network.channel_names().begin() + network.external_channels());
  for (auto const& displacement : machine.displacements)
    for (auto const& term : displacement.input_terms) names.push_back(term.channel);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace thermotwin::twin
