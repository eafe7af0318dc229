
#include "thermal/channel_film.h"
#include "thermal/laws.h"
#include "thermal/physical_constant.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/given_temperature.h"

namespace thermotwin::twin {
namespace {

struct StraightChannel {
  static constexpr std::string_view name = "straight cooling channel";
  template <class S>
  static S film(thermal::Fluid const& medium, S const& wall, S const& inlet, S const& flow, S const& area,
                S const& diameter, S const& length) {
    return thermal::channel_film<S>(medium, wall, inlet, flow, area, diameter, length);
  }
};

struct Helix {
  static constexpr std::string_view name = "helical cooling jacket";
  template <class S>
  static S film(thermal::Fluid const& medium, S const& wall, S const& inlet, S const& flow, S const& area,
                S const& diameter, S const& curvature_diameter) {
    return thermal::helix_film<S>(medium, wall, inlet, flow, area, diameter, curvature_diameter);
  }
};

/// q = s ṁc (1 − e^{−NTU}) (T_in − T_wall), NTU = A/(1/h + r)/(ṁc), V̇ = V̇₀ (ν₀/ν(T_in))^γ: a cell of the wall meets
/// its share s of area and flow, and is never cooled below the inlet. Ports: cell, inlet.
/// c = {A, r, V̇₀, γ, ν₀, section, d_h, length or diameter of curvature, number of the fluid, s}, u = {flag}.
template <class Shape>
struct JacketLaw {
  static constexpr std::string_view name = Shape::name;
  static constexpr int ports = 2, coefficients = 10, inputs = 1;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    if (u[0] <= 0.0) return;
    auto const& medium = thermal::fluid_of_number(thermal::value_of(c[8]));
    auto const fluid = thermal::properties(medium, T[1]);
    S const flow = u[0] * c[2] * thermal::viscous_flow_ratio<S>(c[4], fluid.kinematic_viscosity, c[3]);
    S const h = Shape::template film<S>(medium, T[0], T[1], flow, c[5], c[6], c[7]);
    S const capacity_rate = flow * fluid.density * fluid.specific_heat;
    S const conductance = thermal::ntu_conductance<S>(capacity_rate, c[0] / (1.0 / h + c[1]));
    thermal::exchange<S>(c[9] * conductance * (T[1] - T[0]), q);
  }
};

struct Jacket : GivenTemperature {
  std::string name, wall, from, fluid = "water", while_on = "machine.on";
  double flow = required, flow_exponent = 0.0, flow_temperature = thermal::reference_temperature;
  double channel_width = required, channel_height = required, length = required;
  std::optional<double> helix_diameter, area;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Jacket::name, "unique among these");
    f.name("wall", &Jacket::wall, "surface or body that it cools");
    f("from", &Jacket::from, "body of fluid from which it is fed and to which it returns; or its temperature is given");
    GivenTemperature::fields_of<Jacket>(f);
    f("flow", &Jacket::flow, dimension::volume_flow, "of the pump", Range{1e-6, 5e-3}.above_zero());
    f("flow_exponent", &Jacket::flow_exponent, dimension::dimensionless,
      "of (ν0/ν): 0 where a volume is displaced, 1 where a constant pressure drives laminar flow", Range{0.0, 1.0});
    f.temperature("flow_temperature", &Jacket::flow_temperature, "of the fluid, at which the flow is stated");
    f("fluid", &Jacket::fluid, "known fluid: water, emulsion, water-glycol, oil VG10 and so on");
    f("channel_width", &Jacket::channel_width, dimension::length, "of the section", Range{1e-3, 0.1}.above_zero());
    f("channel_height", &Jacket::channel_height, dimension::length, "of the section", Range{1e-3, 0.1}.above_zero());
    f("length", &Jacket::length, dimension::length, "of the channel, unrolled", Range{0.05, 50.0}.above_zero());
    f("helix_diameter", &Jacket::helix_diameter, dimension::length, "of a helical channel; without it straight",
      Range{0.02, 1.0}.above_zero());
    f("area", &Jacket::area, dimension::area, "wetted area that cools; default: three sides of the channel",
      Range{1e-3, 5.0});
    f("while_on", &Jacket::while_on, "input channel between 0 and 1 that scales the flow");
  }

  void check(Value const& table) const {
    GivenTemperature::check(table);
    for (auto const* key : {"temperature", "follows"}) refuse_both(table, key, "from");
  }

  void add_to(Assembly& assembly) const {
    Place const place = assembly.place(wall);
    auto const inlet = from.empty() ? port(assembly, "jacket '" + name + "'") : assembly.port(from);
    double const section = channel_width * channel_height, perimeter = 2.0 * (channel_width + channel_height);
    double const wetted = area.value_or((perimeter - channel_width) * length);
    auto const reference = thermal::properties(thermal::fluid(fluid), flow_temperature);
    std::vector<int> const inputs = {assembly.share(while_on)};
    for (auto const& contact : place.site.contacts) {
      std::vector<thermal::Port> const ports = {assembly.node(place, contact.node), inlet};
      std::vector<double> const numbers = {wetted,
                                           contact.half_resistance,
                                           flow,
                                           flow_exponent,
                                           reference.kinematic_viscosity,
                                           section,
                                           4.0 * section / perimeter,
                                           helix_diameter.value_or(length),
                                           thermal::number_of_fluid(fluid),
                                           contact.share};
      if (helix_diameter)
        assembly.network().add<JacketLaw<Helix>>(assembly.part(), ports, numbers, inputs);
      else
        assembly.network().add<JacketLaw<StraightChannel>>(assembly.part(), ports, numbers, inputs);
    }
  }
};

}  // namespace

Effect const& jacket_effect() {
  static Effect const effect = make_effect<Jacket>(
      {"jacket",
       "a cooling jacket: flow and film from its geometry, any number of transfer units",
       "q = ṁc (1 − e^(−NTU)) (T_in − T_wall), each cell of the wall with its share;  NTU = A/(1/h + r)/ṁc,  V̇ = V̇0 "
       "(ν0/ν)^γ;  h: laminar Nu = (3.66³ + "
       "1.615³ Re "
       "Pr d/L)^(1/3), Gnielinski from Re 1e4, linear between;  helix: from Re_cr = 2300 [1 + 8.6 (d/D)^0.45] to 2.2e4",
       "boundary, link",
       "housing, stator, nut, screw bore",
       "all places near the jacket scaled alike, τ 1…5 min; return less supply; cold oil flows less where pressure "
       "drives "
       "it",
       "physics.md 2.7, §7 no. 3; Gnielinski 1975; VDI Heat Atlas Gc",
       {3},
       {"coolant_flow", "channel_film"},
       "temperatures of supply and return; a step of the flow"});
  return effect;
}

}  // namespace thermotwin::twin
