#include "thermal/error.h"
#include "thermal/laws.h"
#include "thermal/motor_loss.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct MotorLoad {
  std::string name, stator, rotor, while_loaded = "spindle.running";
  double power = required, efficiency = required, slip = 0.0;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &MotorLoad::name, "unique among these");
    f.name("stator", &MotorLoad::stator, "place that takes the loss");
    f("rotor", &MotorLoad::rotor, "place that takes the slip's share of it");
    f("power", &MotorLoad::power, dimension::power, "at the shaft, mean under load", Range{50, 50000});
    f("efficiency", &MotorLoad::efficiency, dimension::dimensionless, "at that load, loss without load left out",
      Range{0.7, 0.98}.above_zero().up_to(1.0));
    f("slip", &MotorLoad::slip, dimension::dimensionless, "of an induction motor", Range{0.0, 0.08}.up_to(1.0));
    f("while_loaded", &MotorLoad::while_loaded, "input channel between 0 and 1 that scales the load");
  }

  void add_to(Assembly& assembly) const {
    double const loss = thermal::map_loss<double>(power, efficiency, 0.0);
    double const of_rotor = rotor.empty() ? 0.0 : thermal::rotor_slip_loss<double>(slip, power);
    if (of_rotor > loss)
      throw thermal::InputError("motor_load '" + name + "': the slip alone loses more than the efficiency allows");
    add(assembly, stator, loss - of_rotor);
    if (!rotor.empty()) add(assembly, rotor, of_rotor);
  }

 private:
  void add(Assembly& assembly, std::string const& place, double heat) const {
    assembly.network().add<thermal::SwitchedHeat>(assembly.part(), {assembly.port(place)}, {heat},
                                                  {assembly.share(while_loaded)});
  }
};

}  // namespace

Effect const& motor_load_effect() {
  static Effect const effect = make_effect<MotorLoad>(
      {"motor_load",
       "loss of a motor under load, from its efficiency; the slip's share in the rotor",
       "P = P_m (1/η − 1),  of it in the rotor P_m s/(1 − s)",
       "source",
       "stator and rotor",
       "only under load; rotor and shaft of an induction motor warm from inside",
       "physics.md 1.7",
       {7},
       {"heat", "cutting_heat", "copper_loss"},
       "no load against load at one speed; with the place and the flag of a heat they are the same"});
  return effect;
}

}  // namespace thermotwin::twin
