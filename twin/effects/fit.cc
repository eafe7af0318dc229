#include <cmath>
#include <numbers>

#include "thermal/contact.h"
#include "thermal/error.h"
#include "thermal/joint.h"
#include "thermal/laws.h"
#include "thermal/physical_constant.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/joint_side.h"

namespace thermotwin::twin {
namespace {

/// q = A (T₁ − T₀)/(1/h + A R), h(g) = k/(½ g₊ + ξ) + H (K (−g)₊)^0.95, g = g₀ − D (α₀ θ₀ − α₁ θ₁).
/// Ports: inner, outer part. c = {A, R of both half cells, g₀, D, α₀, α₁, T_assembly, k, ξ, h of contact at 1 Pa, Pa
/// per m of interference}.
struct FitLaw {
  static constexpr std::string_view name = "fit with clearance";
  static constexpr int ports = 2, coefficients = 11, inputs = 0;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const*, S* q) {
    using std::pow;
    S const gap = thermal::fit_gap<S>(c[2], c[3], c[4], T[0] - c[6], c[5], T[1] - c[6]);
    thermal::within<S>(thermal::fit_gap_range, gap);
    S const clearance = thermal::smooth_positive<S>(gap, thermal::fit_blend);
    S const pressure = c[10] * thermal::smooth_positive<S>(-gap, thermal::fit_blend);
    S const film = c[7] / (0.5 * clearance + c[8]) + c[9] * pow(pressure, 0.95);
    thermal::exchange<S>(c[0] * film / (1.0 + c[0] * film * c[1]) * (T[1] - T[0]), q);
  }
};

struct FitPart {
  std::string name, inner, outer;
  double diameter = required, width = required;
  double clearance = required;
  double inner_bore = required, outer_diameter = required;
  double gap_conductivity = 0.026;
  double separation = 1.5e-6, roughness = 0.8e-6, slope = 0.1, hardness = 2.5e9;
  double inner_conductivity = 33.0, outer_conductivity = 47.5;
  double inner_expansion = 12.1e-6, outer_expansion = 10.5e-6;
  double inner_modulus = 208e9, outer_modulus = 120e9;
  double assembly_temperature = thermal::reference_temperature;

  template <class Fields>
  static void fields(Fields& f) {
    using P = FitPart;
    f.name("name", &P::name, "unique among these");
    f.name("inner", &P::inner, "inner part: bearing ring in a housing, shaft in a ring");
    f.name("outer", &P::outer, "outer part");
    f("diameter", &P::diameter, dimension::length, "of the seat", Range{0.005, 1.0});
    f("width", &P::width, dimension::length, "of the seat", Range{0.002, 1.0});
    f("clearance", &P::clearance, dimension::length, "on the diameter at assembly; negative: interference",
      Range{-5e-6, 20e-6});
    f("inner_bore", &P::inner_bore, dimension::length, "of the inner part", Range{0.0, 1.0});
    f("outer_diameter", &P::outer_diameter, dimension::length, "of the outer part's outside", Range{0.005, 2.0});
    f("gap_conductivity", &P::gap_conductivity, dimension::conductivity,
      "of what fills the gap: air 0.026, grease 0.14", Range{0.02, 0.3});
    f("separation", &P::separation, dimension::length, "mean distance of surfaces that touch without pressure",
      Range{0.3e-6, 10e-6});
    f("roughness", &P::roughness, dimension::length, "root of both squared rms heights", Range{0.1e-6, 10e-6});
    f("slope", &P::slope, dimension::dimensionless, "root of both squared asperity slopes", Range{0.05, 0.4});
    f("hardness", &P::hardness, dimension::pressure, "of the softer surface", Range{1.5e9, 3e9});
    f("inner_conductivity", &P::inner_conductivity, dimension::conductivity, "of the inner part", Range{1, 400});
    f("outer_conductivity", &P::outer_conductivity, dimension::conductivity, "of the outer part", Range{1, 400});
    f("inner_expansion", &P::inner_expansion, dimension::expansion, "of the inner part", Range{3e-6, 24e-6});
    f("outer_expansion", &P::outer_expansion, dimension::expansion, "of the outer part", Range{3e-6, 24e-6});
    f("inner_modulus", &P::inner_modulus, dimension::stress, "Young's modulus of the inner part", Range{50e9, 320e9});
    f("outer_modulus", &P::outer_modulus, dimension::stress, "Young's modulus of the outer part", Range{50e9, 320e9});
    f.temperature("assembly_temperature", &P::assembly_temperature, "at which the clearance was measured");
  }

  void add_to(Assembly& assembly) const {
    if (!(inner_bore < diameter && diameter < outer_diameter))
      throw thermal::InputError("fit '" + name + "': the seat lies between inner_bore and outer_diameter");
    Place const a = joint_side(assembly, inner), b = joint_side(assembly, outer);
    double const area = std::numbers::pi * diameter * width;
    double const contact = thermal::contact_film<double>(fit().contact, 1.0);
    double const stiffness = thermal::fit_pressure<double>(fit(), -1.0);
    for (auto const& pair : thermal::pair(a.site, b.site))
      assembly.network().add<FitLaw>(
          assembly.part(), {assembly.node(a, pair.a), assembly.node(b, pair.b)},
          {area * pair.share, pair.resistance, clearance, diameter, inner_expansion, outer_expansion,
           assembly_temperature, gap_conductivity, separation, contact, stiffness});
  }

 private:
  [[nodiscard]] thermal::Fit fit() const {
    thermal::Fit fit;
    fit.diameter = diameter;
    fit.inner_bore = inner_bore;
    fit.outer_diameter = outer_diameter;
    fit.inner_youngs_modulus = inner_modulus;
    fit.outer_youngs_modulus = outer_modulus;
    fit.separation = separation;
    fit.contact = {inner_conductivity, outer_conductivity, roughness, slope, hardness};
    return fit;
  }
};

}  // namespace

Effect const& fit_effect() {
  static Effect const effect = make_effect<FitPart>(
      {"fit",
       "conduction from a ring into its seat, which changes with the clearance",
       "q = h(g) π D b (T_outer − T_inner);  g = g0 − D (α_i θ_i − α_o θ_o);  clearance: h = k/(g/2 + ξ);  "
       "interference: "
       "besides 1.25 (k_s m/σ)(p/H)^0.95, p = −g/{D [(C_o + ν_o)/E_o + (C_i − ν_i)/E_i]}",
       "link",
       "bearing ring and housing, bearing ring and shaft",
       "difference across the seat curved over the heat flow; warm-up and cool-down differ; all neighbours see it",
       "physics.md 2.3 (2.2)-(2.4), §7 no. 9",
       {9},
       {"sensor_contact"},
       "swap the sensor: a fit changes the heat that all sensors see, a displaced sensor its own reading only"});
  return effect;
}

}  // namespace thermotwin::twin
