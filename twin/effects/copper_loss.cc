
#include "thermal/motor_loss.h"
#include "thermal/physical_constant.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

/// P = u (1 + χ) m R (1 + 0.0039 (T − 20 °C)) [I_μ² + (w M/k_T)²]. Ports: slots, end windings.
/// c = {m R, χ, I_μ, M/k_T, share of the slots}, u = {enabled, loaded w}.
struct CopperHeat {
  static constexpr std::string_view name = "copper loss of a motor";
  static constexpr int ports = 2, coefficients = 5, inputs = 2;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    S const load = u[1] * c[3];
    S const squared_current = c[2] * c[2] + load * load;
    auto const loss = [&](S const& share, S const& winding) {
      thermal::within<S>(thermal::winding_temperature, winding);
      S const warm = 1.0 + thermal::copper_temperature_coefficient * (winding - thermal::reference_temperature);
      return u[0] * (1.0 + c[1]) * share * c[0] * warm * squared_current;
    };
    q[0] = loss(c[4], T[0]);
    q[1] = loss(1.0 - c[4], T[1]);
  }
};

struct CopperLoss {
  std::string name, slots, end_windings, while_on = "servo.on", while_loaded = "spindle.running";
  double phases = 3.0, resistance = required;
  double magnetising_current = 0.0, torque = 0.0, torque_constant = 1.0;
  double harmonics = 0.0, slot_share = 0.6;

  template <class Fields>
  static void fields(Fields& f) {
    using P = CopperLoss;
    f.name("name", &P::name, "unique among these");
    f.name("slots", &P::slots, "place of the winding in the slots: stator");
    f("end_windings", &P::end_windings, "place of the end windings; default: the slots'");
    f("phases", &P::phases, dimension::dimensionless, "of the winding", Range{1, 6});
    f("resistance", &P::resistance, dimension::resistance, "of a phase at 20 degC", Range{0.01, 20});
    f("magnetising_current", &P::magnetising_current, dimension::current, "effective, of a phase; permanent magnets: 0",
      Range{0.0, 100.0});
    f("torque", &P::torque, dimension::torque, "of the load, effective mean", Range{0.0, 500.0});
    f("torque_constant", &P::torque_constant, dimension::torque_constant, "per effective phase current",
      Range{0.05, 10.0}.above_zero());
    f("harmonics", &P::harmonics, dimension::dimensionless, "share that the converter's harmonics add",
      Range{0.0, 0.2});
    f("slot_share", &P::slot_share, dimension::dimensionless, "of the loss, in the slots", share_range);
    f("while_on", &P::while_on, "input channel that enables the motor");
    f("while_loaded", &P::while_loaded, "input channel between 0 and 1 that scales the load");
  }

  void add_to(Assembly& assembly) const {
    auto const slot_port = assembly.port(slots);
    assembly.network().add<CopperHeat>(
        assembly.part(), {slot_port, end_windings.empty() ? slot_port : assembly.port(end_windings)},
        {phases * resistance, harmonics, magnetising_current, torque / torque_constant, slot_share},
        {assembly.share(while_on), assembly.share(while_loaded)});
  }
};

}  // namespace

Effect const& copper_loss_effect() {
  static Effect const effect = make_effect<CopperLoss>(
      {"copper_loss",
       "copper loss of a motor: magnetising or holding current, and load",
       "P = (1 + χ) m R20 [1 + 0.0039 (T − 20 °C)] I²,  I² = I_μ² + (M/k_T)²",
       "source",
       "stator, end windings",
       "power of speed 0 while enabled, at standstill too; with the square of the torque; τ 20…40 min; ends when the "
       "motor "
       "is disabled",
       "physics.md 1.7 (1.11), §7 nos. 7, 42",
       {7, 42},
       {"heat", "hydraulic_unit", "hot_neighbour", "motor_load"},
       "drives on at standstill, then the machine on with its drives off"},
      {{.amplitude = "resistance",
        .largest = 4.0,
        .sites = {{"slots", "motor"}},
        .shapes = {{{"magnetising_current", "5 A"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
