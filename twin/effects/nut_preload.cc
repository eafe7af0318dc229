#include <cmath>

#include "thermal/physical_constant.h"
#include "thermal/preload.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

/// ΔQ = T_pre [(1 + δ/δ₀)₊^{3/2} − 1] ω. Ports: nut, screw. c = {T_pre, δ per K, δ₀, T_assembly, α_nut/α_screw, nut's
/// share}, u = {ω}.
struct NutPreloadHeat {
  static constexpr std::string_view name = "friction of a nut's thermal preload";
  static constexpr int ports = 2, coefficients = 6, inputs = 1;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    if (u[0] == 0.0) return;
    using std::pow;
    S const deflection = 1.0 + c[1] * ((T[1] - c[3]) - c[4] * (T[0] - c[3])) / c[2];
    S const change = deflection > S(0.0) ? S(pow(deflection, 1.5) - 1.0) : S(-1.0);
    S const heat = c[0] * change * u[0];
    q[0] = c[5] * heat;
    q[1] = (1.0 - c[5]) * heat;
  }
};

struct NutPreload {
  std::string name, nut, screw, axis = "z";
  double torque = required, deflection = required, nominal_diameter = required;
  double screw_expansion = 11.5e-6, nut_expansion = 12.1e-6;
  double assembly_temperature = thermal::reference_temperature, nut_share = 0.5;

  template <class Fields>
  static void fields(Fields& f) {
    using P = NutPreload;
    f.name("name", &P::name, "unique among these");
    f.name("nut", &P::nut, "body of the nut");
    f.name("screw", &P::screw, "place on the screw, along its stroke");
    f("axis", &P::axis, "whose screw it is");
    f("torque", &P::torque, dimension::torque, "of the nut's preload at assembly", Range{0.05, 2.0});
    f("deflection", &P::deflection, dimension::length, "of the balls under that preload, along the radius",
      Range{1e-6, 20e-6}.above_zero());
    f("nominal_diameter", &P::nominal_diameter, dimension::length, "of the screw", Range{0.005, 0.2});
    f("screw_expansion", &P::screw_expansion, dimension::expansion, "of the screw", Range{9e-6, 13e-6}.above_zero());
    f("nut_expansion", &P::nut_expansion, dimension::expansion, "of the nut", Range{9e-6, 13e-6});
    f.temperature("assembly_temperature", &P::assembly_temperature, "at which the preload was set");
    f("nut_share", &P::nut_share, dimension::dimensionless, "of the heat, into the nut", share_range);
  }

  void add_to(Assembly& assembly) const {
    double const per_kelvin = thermal::nut_approach<double>(screw_expansion, 0.5 * nominal_diameter, 1.0, 0.0);
    assembly.network().add<NutPreloadHeat>(
        assembly.part(), {assembly.port(nut), assembly.port(screw)},
        {torque, per_kelvin, deflection, assembly_temperature, nut_expansion / screw_expansion, nut_share},
        {assembly.channel(axis + ".speed")});
  }
};

}  // namespace

Effect const& nut_preload_effect() {
  static Effect const effect = make_effect<NutPreload>(
      {"nut_preload",
       "friction that a ball nut gains or loses as screw and nut warm differently",
       "ΔQ = T_pre [(1 + δ/δ0)₊^(3/2) − 1] ω,  δ = r (α_s θ_screw − α_n θ_nut)",
       "source",
       "nut and screw",
       "torque of the axis falls 20…30 % in warm-up when the nut is the warmer one; power of feed 1; ends at stop",
       "physics.md 1.8, 1.4 (1.8)",
       {17},
       {"ball_nut", "nut_reversal", "guide"},
       "torque of the axis along a warm-up at constant feed"},
      {{.amplitude = "torque",
        .largest = 2.0,
        .sites = {{"nut", "nut", "screw"}},
        .shapes = {{{"deflection", "5 um"}, {"nominal_diameter", "40 mm"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
