#include "thermal/coolant.h"
#include "thermal/error.h"
#include "thermal/laws.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/given_temperature.h"

namespace thermotwin::twin {
namespace {

/// q = −u sat(K (e + s)), 0 ≤ q ≤ Q; T_i ds/dt = e − 5 (K (e + s) − q)/K: the integral, led back where the chiller can
/// do no more; e = T_measured − T_set. Ports: cooled, measured, set point, s. c = {K, T_i, Q}, u = {flag}.
struct InverterHeat {
  static constexpr std::string_view name = "inverter chiller";
  static constexpr int ports = 4, coefficients = 3, inputs = 1;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    S const error = T[1] - T[2];
    S const gain = c[0] / c[2];
    S const heat = u[0] * thermal::inverter_chiller_heat<S>(error, T[3], gain, gain, 1.0);
    q[0] = -c[2] * heat;
    constexpr double lead_back = 5.0;
    q[3] = (u[0] * (error - lead_back * (error + T[3])) + lead_back * heat / gain - (1.0 - u[0]) * T[3]) / c[1];
  }
};

struct Chiller : GivenTemperature {
  std::string name, cools, measured, kind = "relay", while_on = "chiller.on", offset_channel = "chiller.offset";
  double power = required;
  double hysteresis = 1.0, minimum_off_time = 120.0;
  double gain = 1000.0, integral_time = 120.0;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Chiller::name, "unique among the chillers");
    f.name("cools", &Chiller::cools, "body of fluid from which it takes heat");
    f("measured", &Chiller::measured, "place whose temperature it controls; default: the body that it cools");
    f.choice("kind", &Chiller::kind, {"relay", "inverter"}, "on and off, or continuous by a PI controller");
    GivenTemperature::fields_of<Chiller>(f);
    f("offset_channel", &Chiller::offset_channel, "input channel that is added to the set point");
    f("power", &Chiller::power, dimension::power, "heat that it can take", Range{200, 20000});
    f("hysteresis", &Chiller::hysteresis, dimension::temperature_difference, "relay: from on to off", Range{0.2, 2.0});
    f("minimum_off_time", &Chiller::minimum_off_time, dimension::time, "relay: of the compressor", Range{0.0, 180.0});
    f("gain", &Chiller::gain, dimension::conductance, "inverter: proportional", Range{50, 20000}.above_zero());
    f("integral_time", &Chiller::integral_time, dimension::time, "inverter: of the integral",
      Range{10, 3600}.above_zero());
    f("while_on", &Chiller::while_on, "input channel that enables it");
  }

  void add_to(Assembly& assembly) const {
    auto const cooled = assembly.port(cools), probe = measured.empty() ? cooled : assembly.port(measured);
    if (kind == "relay") return add_relay(assembly, cooled, probe);
    auto const integral = assembly.network().add_signal("integral of chiller '" + name + "'");
    assembly.network().add<InverterHeat>(assembly.part(), {cooled, probe, set_point(assembly), integral},
                                         {gain, integral_time, power}, {assembly.share(while_on)});
  }

 private:
  void add_relay(Assembly& assembly, thermal::Port cooled, thermal::Port probe) const {
    int const state = assembly.network().add_relay("chiller." + name, probe, set_point(assembly), 0.5 * hysteresis,
                                                   -0.5 * hysteresis, minimum_off_time, assembly.share(while_on));
    assembly.network().add<thermal::SwitchedHeat>(assembly.part(), {cooled}, {-power}, {state});
  }
  [[nodiscard]] thermal::Port set_point(Assembly& assembly) const {
    thermal::Boundary boundary{"set point of chiller '" + name + "'", 0.0, {{assembly.channel(offset_channel), 1.0}}};
    if (temperature) {
      boundary.offset = *temperature;
    } else if (!follows.empty()) {
      boundary.offset = offset;
      boundary.terms.push_back({assembly.channel(follows), 1.0});
    } else {
      throw thermal::InputError("chiller '" + name + "' needs a temperature or an input channel that it follows");
    }
    return assembly.network().add_boundary(std::move(boundary));
  }
};

}  // namespace

Effect const& chiller_effect() {
  static Effect const effect = make_effect<Chiller>(
      {"chiller",
       "a chiller that holds a temperature: relay with hysteresis, or inverter",
       "relay: q = −Q_max above T_set + Δ/2 until below T_set − Δ/2, off for a least time;  inverter: q = −sat(K e + "
       "K/T_i "
       "∫e dt), 0…Q_max;  T_set = constant, or channel + offset, + chiller.offset",
       "source",
       "tank, jacket, body of fluid",
       "relay: narrow line of period CΔ [1/Q_l + 1/(Q_max − Q_l)], which changes with the load; at standstill too; set "
       "point follows the room where it is told to",
       "physics.md 2.12, §7 no. 5",
       {5},
       {"ambient_cycle", "stratification"},
       "log the chiller's state: its period changes with the load, that of the room does not"});
  return effect;
}

}  // namespace thermotwin::twin
