#pragma once

#include <map>
#include <string>

#include "scenarios/machine_limits.h"
#include "thermal/network.h"
#include "twin/file/value.h"

namespace thermotwin::twin {

/// Data sets and their CSV files hold each channel by its name: FileError at a table's name that cannot be one.
void check_channel_name(Value const& table, std::string const& name);

/// The names under which a machine's sensors and displacements are read: each is one alone.
class ChannelNames {
 public:
  /// FileError if it cannot be the name of a channel, or is taken. `table` must outlive this.
  void claim(Value const& table, std::string const& name, std::string const& kind);
  /// A table of numbers tells inputs and readings apart by their names: FileError at one that an input has.
  void refuse_inputs(thermal::Network const& network, scenarios::MachineLimits const& limits) const;

 private:
  struct Owner {
    Value const* table;
    std::string kind;
  };
  std::map<std::string, Owner> owners_;
};

}  // namespace thermotwin::twin
