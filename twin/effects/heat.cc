#include "thermal/laws.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct Heat {
  std::string name, at;
  double power = required;  ///< [W]
  std::string while_on = "machine.on";

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Heat::name, "unique among these");
    f.name("at", &Heat::at, "place that receives it");
    f("power", &Heat::power, dimension::power, "while the flag is up; negative: cooling", Range{-1000, 5000});
    f("while_on", &Heat::while_on,
      "input channel between 0 and 1 that scales it: machine.on, servo.on, coolant.on, "
      "spindle.running, heater1.duty");
  }

  void add_to(Assembly& assembly) const {
    assembly.network().add<thermal::SwitchedHeat>(assembly.part(), {assembly.port(at)}, {power},
                                                  {assembly.share(while_on)});
  }
};

}  // namespace

Effect const& heat_effect() {
  static Effect const effect = make_effect<Heat>(
      {"heat",
       "heat at a constant rate while something is on: pump, electronics, brake",
       "q = P·u,  u = 0…1",
       "source",
       "any place",
       "power of speed 0; follows its flag, not the spindle; at stop it goes on while the flag is up",
       "physics.md 1.10, 1.7, §7 nos. 22, 39, 42",
       {10, 22, 39, 42},
       {"hot_neighbour", "copper_loss", "hydraulic_unit", "cutting_heat", "motor_load", "stratification"},
       "pumps, drives and machine switched off one after another at standstill; power meter; all off overnight"},
      {{.amplitude = "power",
        .largest = 300.0,
        .either_sign = true,
        .sites = {{"at", "solid"}},
        .shapes = {{{"while_on", "machine.on"}}, {{"while_on", "spindle.running"}}, {{"while_on", "coolant.on"}}}},
       {.amplitude = "power",
        .largest = 300.0,
        .either_sign = true,
        .if_changes = "servo.on",
        .sites = {{"at", "solid but no motor"}},
        .shapes = {{{"while_on", "servo.on"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
