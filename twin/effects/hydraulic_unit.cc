#include "thermal/drive_loss.h"
#include "thermal/error.h"
#include "thermal/laws.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct HydraulicUnit {
  std::string name, tank, consumers, while_on = "machine.on";
  double electric_power = required, duty = 1.0;
  double pressure_drop = 0.0, volume_flow = 0.0;

  template <class Fields>
  static void fields(Fields& f) {
    using P = HydraulicUnit;
    f.name("name", &P::name, "unique among these");
    f.name("tank", &P::tank, "body of the oil, or place on which the unit stands");
    f("consumers", &P::consumers,
      "place where oil is throttled: valves, clamps; without one all heat goes to the tank");
    f("electric_power", &P::electric_power, dimension::power, "of the pump while it runs", Range{20, 5000});
    f("duty", &P::duty, dimension::dimensionless, "share of the time that it runs; with an accumulator 0.05 to 0.3",
      Range{0.05, 1.0}.up_to(1.0));
    f("pressure_drop", &P::pressure_drop, dimension::pressure, "at the consumers", Range{0.0, 2e7});
    f("volume_flow", &P::volume_flow, dimension::volume_flow, "mean flow through the consumers", Range{0.0, 1e-3});
    f("while_on", &P::while_on, "input channel between 0 and 1 that scales it");
  }

  void add_to(Assembly& assembly) const {
    double const throttled = consumers.empty() ? 0.0 : thermal::throttling_heat<double>(pressure_drop, volume_flow);
    double const all = thermal::hydraulic_unit_heat<double>(electric_power, duty);
    if (throttled > all)
      throw thermal::InputError("hydraulic_unit '" + name + "': the consumers throttle more than the pump takes");
    add(assembly, tank, all - throttled);
    if (!consumers.empty()) add(assembly, consumers, throttled);
  }

 private:
  void add(Assembly& assembly, std::string const& place, double heat) const {
    assembly.network().add<thermal::SwitchedHeat>(assembly.part(), {assembly.port(place)}, {heat},
                                                  {assembly.share(while_on)});
  }
};

}  // namespace

Effect const& hydraulic_unit_effect() {
  static Effect const effect =
      make_effect<HydraulicUnit>({"hydraulic_unit",
                                  "heat of a hydraulic or lubrication unit, and of its oil where it is throttled",
                                  "q_tank = d P − Δp V̇,  q_consumers = Δp V̇",
                                  "source",
                                  "oil tank, side of the bed, rear of the column",
                                  "power of speed 0; follows machine-on, not the spindle; tank 1…3 h",
                                  "physics.md 1.10, §7 no. 22",
                                  {22},
                                  {"heat", "copper_loss", "stratification"},
                                  "unit off; power meter; with the place and the flag of a heat they are the same"});
  return effect;
}

}  // namespace thermotwin::twin
