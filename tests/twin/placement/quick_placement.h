#pragma once

#include <string>

#include "tests/output/temporary_directory.h"
#include "thermal/error.h"
#include "twin/file/value.h"
#include "twin/machine.h"
#include "twin/placement/candidate_sites.h"
#include "twin/placement/sensor_placement.h"

namespace thermotwin::twin {

inline Value v450() { return read_toml(machine_file("v450")); }

/// Few machines: seconds, not minutes.
inline PlacementOptions quick(int sensors) {
  PlacementOptions options;
  options.sensors = sensors;
  options.design.members = 10;
  options.unseen_members = 6;
  return options;
}

inline CandidateRules rules_from(std::string const& text) {
  thermotwin::tests::TemporaryDirectory const directory;
  auto const path = directory.path() / "candidates.toml";
  thermotwin::tests::put(path, text);
  return read_candidate_rules(path);
}

/// What placing refuses; empty: nothing.
inline std::string refusal(Value const& document, PlacementOptions const& options) {
  try {
    (void)place_sensors(document, options);
  } catch (thermal::InputError const& error) {
    return error.what();
  }
  return "";
}

}  // namespace thermotwin::twin
