#pragma once

#include <string>
#include <vector>

#include "scenarios/field.h"
#include "scenarios/signal.h"
#include "thermal/units.h"

namespace thermotwin::scenarios {

/// A switch that stays on or off for a while.
struct SwitchBlock {
  double duration = required;  ///< [s] > 0
  bool on = true;

  template <class Fields>
  static void fields(Fields& f) {
    f("duration", &SwitchBlock::duration, thermal::dimension::time, "how long it stays so", {0.0, unbounded});
    f("on", &SwitchBlock::on, "on or off");
  }
};

/// Drives, controller: on for the whole run, or in blocks and `on` afterwards.
struct PowerSwitch {
  bool on = true;
  std::vector<SwitchBlock> blocks;

  template <class Fields>
  static void fields(Fields& f) {
    f("on", &PowerSwitch::on, "on or off, after the blocks if there are any");
    f("blocks", &PowerSwitch::blocks, "on and off, one after another");
  }
};

/// Coolant of the cutting zone or through the tool.
struct Coolant {
  bool on = false;
  std::vector<SwitchBlock> blocks;
  double temperature = 293.15;  ///< of the supply, where the machine has no tank that computes it [K]

  template <class Fields>
  static void fields(Fields& f) {
    f("on", &Coolant::on, "pump on or off, after the blocks if there are any");
    f("blocks", &Coolant::blocks, "on and off, one after another");
    f.temperature("temperature", &Coolant::temperature, "of the supply, where the machine does not compute it");
  }
};

/// The command to the chiller; its own thermostat may still switch the compressor.
struct Chiller {
  bool on = true;
  std::vector<SwitchBlock> blocks;
  double offset = 0.0;  ///< added to the machine's set point [K]

  template <class Fields>
  static void fields(Fields& f) {
    f("on", &Chiller::on, "allowed to run, after the blocks if there are any");
    f("blocks", &Chiller::blocks, "on and off, one after another");
    f("offset", &Chiller::offset, thermal::dimension::temperature_difference, "added to the machine's set point",
      {-40.0, 40.0});
  }
};

/// 1 while on, 0 while off, from 0 to `duration` [s]; `name` is what errors call the switch.
Signal switching(std::vector<SwitchBlock> const& blocks, bool afterwards, double duration, std::string const& name);

}  // namespace thermotwin::scenarios
