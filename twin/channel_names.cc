#include "twin/channel_names.h"

#include <fmt/format.h>
#include <set>

#include "scenarios/course.h"
#include "twin/file/document.h"

namespace thermotwin::twin {

void check_channel_name(Value const& table, std::string const& name) {
  if (!name.empty() && name != "." && name != "time" && name.find('/') == std::string::npos) return;
  throw FileError(
      where_of(table, "name"),
      fmt::format("'{}' cannot be the name of a channel: no '/', nor the whole '.', 'time' or empty", name));
}

void ChannelNames::claim(Value const& table, std::string const& name, std::string const& kind) {
  check_channel_name(table, name);
  auto const [known, is_new] = owners_.emplace(name, Owner{&table, kind});
  if (!is_new)
    throw FileError(table.find("name")->where,
                    fmt::format("the name '{}' is taken by a [[{}]]", name, known->second.kind));
}

void ChannelNames::refuse_inputs(thermal::Network const& network, scenarios::MachineLimits const& limits) const {
  std::set<std::string> inputs(network.channel_names().begin(),
                               network.channel_names().begin() + network.external_channels());
  for (auto const& channel : scenarios::own_channels(limits)) inputs.insert(channel.name);
  for (auto const& [name, owner] : owners_)
    if (inputs.contains(name))
      throw FileError(owner.table->find("name")->where,
                      fmt::format("'{}' is the name of an input channel; a [[{}]] needs another", name, owner.kind));
}

}  // namespace thermotwin::twin
