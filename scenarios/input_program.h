#pragma once

#include <string>
#include <vector>

#include "scenarios/field.h"
#include "scenarios/recorded.h"
#include "thermal/units.h"

namespace thermotwin::scenarios {

/// A value held for a while. It is text, because its dimension is that of the channel: "70 %", "35 degC", "1.2 kg/s".
struct ValueBlock {
  double duration = required;  ///< [s] > 0
  std::string value;

  template <class Fields>
  static void fields(Fields& f) {
    f("duration", &ValueBlock::duration, thermal::dimension::time, "how long the value is held", {0.0, unbounded});
    f.name("value", &ValueBlock::value, "number with unit, for example \"70 %\"");
  }
};

/// A programme for any channel by name, for what has none of its own: a heater, an inlet.
struct InputProgram {
  std::string channel;
  std::vector<ValueBlock> blocks;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("channel", &InputProgram::channel, "input channel that it drives, of the machine's or a new one");
    f("blocks", &InputProgram::blocks, "values one after another; the last one holds afterwards");
  }
};

/// The channel from 0 to `duration` [s]. Throws InputError that begins with the key within the programme:
/// "blocks[1].value: ".
DrivenChannel driven_channel(InputProgram const& program, double duration);

}  // namespace thermotwin::scenarios
