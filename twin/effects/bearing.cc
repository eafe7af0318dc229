#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "thermal/ball_conductance.h"
#include "thermal/bearing_friction.h"
#include "thermal/laws.h"
#include "thermal/lubricant.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

/// Port 0 inner ring, port 1 outer ring; the lubricant has their mean temperature. u = {ω}.
/// c = {count, f₀, A, B (viscosity), d_m, z, y, P₀/C₀, P₁, inner share}, and with a power p of its own {p, ν₄₀ ω_max}:
/// the viscous torque times (νω/(ν₄₀ ω_max))^(p − 2/3).
template <bool own_power>
struct PalmgrenHeat {
  static constexpr std::string_view name = "bearing friction after Palmgren and Harris";
  static constexpr int ports = 2, coefficients = own_power ? 12 : 10, inputs = 1;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    if (u[0] == 0.0) return;
    S const speed(u[0]);
    S const viscosity = thermal::vogel_cameron_viscosity<S>(c[2], c[3], 0.5 * (T[0] + T[1]));
    S viscous = thermal::palmgren_viscous_torque<S>(c[1], viscosity, speed, c[4]);
    if constexpr (own_power) {
      using std::pow;
      viscous *= pow(viscosity * std::abs(u[0]) / c[11], S(c[10] - 2.0 / 3.0));
    }
    S const torque = viscous + thermal::load_torque<S>(c[5], c[6], c[7], c[8], c[4]);
    S const heat = c[0] * thermal::friction_heat<S>(torque, speed);
    q[0] = c[9] * heat;
    q[1] = (1.0 - c[9]) * heat;
  }
};

/// q = G (T₁ − T₀), G = G₀ + G₁ √(ω/ω_max). c = {G₀, G₁, ω_max}, u = {ω}.
struct BallConduction {
  static constexpr std::string_view name = "conduction through the balls of a bearing";
  static constexpr int ports = 2, coefficients = 3, inputs = 1;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    thermal::exchange<S>(thermal::rolling_conductance<S>(c[0], c[1], c[2], u[0]) * (T[1] - T[0]), q);
  }
};

struct Bearing {
  std::string name, inner, outer;
  double count = 1.0;
  double grease_factor = 0.8;
  int oil = 22;
  double viscosity_factor = 1.0;
  std::optional<double> viscosity_temperature;  ///< [K]
  std::optional<double> viscous_exponent;
  double pitch_diameter = required;
  double load_factor = 5e-4, load_exponent = 0.38, load_ratio = 0.003;
  double torque_load = required;
  double inner_share = 0.5;
  double conductance = required;
  std::optional<double> conductance_speed;  ///< [W/K]

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Bearing::name, "unique among the bearings");
    f.name("inner", &Bearing::inner, "place of the inner rings, on the shaft");
    f.name("outer", &Bearing::outer, "place of the outer rings");
    f("count", &Bearing::count, dimension::dimensionless, "bearings in the set", Range{1, 6}.above_zero());
    f("grease_factor", &Bearing::grease_factor, dimension::dimensionless,
      "f0 of each: run-in spindle grease 0.4 to 1.0, grease 2, oil bath 3.3", Range{0.2, 8.0});
    f("oil", &Bearing::oil, "ISO viscosity grade of the base oil", Range{10, 100});
    f("viscosity_factor", &Bearing::viscosity_factor, dimension::dimensionless, "of that grade, at every temperature",
      Range{0.3, 3.0});
    f("viscosity_temperature", &Bearing::viscosity_temperature, dimension::temperature_difference,
      "B, where it is not that grade's; the viscosity at 40 degC stays; 0: no feedback", Range{0.0, 1000.0});
    f("viscous_exponent", &Bearing::viscous_exponent, dimension::dimensionless,
      "p of the viscous torque, ∝ (νω)^p, where it is not 2/3; the same at 40 degC and full speed", Range{0.1, 2.0});
    f("pitch_diameter", &Bearing::pitch_diameter, dimension::length, "d_m", Range{0.005, 1.0}.above_zero());
    f("load_factor", &Bearing::load_factor, dimension::dimensionless, "z of f1 = z (P0/C0)^y", Range{1e-4, 2e-3});
    f("load_exponent", &Bearing::load_exponent, dimension::dimensionless, "y of it", Range{0.3, 0.6});
    f("load_ratio", &Bearing::load_ratio, dimension::dimensionless, "P0/C0", Range{1e-4, 0.2});
    f("torque_load", &Bearing::torque_load, dimension::force, "P1 = max(0.9 Fa cot(alpha) - 0.1 Fr, Fr) of each",
      Range{0.0, 1e5});
    f("inner_share", &Bearing::inner_share, dimension::dimensionless, "of the heat, into the inner rings", share_range);
    f("conductance", &Bearing::conductance, dimension::conductance,
      "from inner to outer rings of the whole set, through balls and grease; 0 beside a ball_conductance",
      Range{0.0, 50.0});
    f("conductance_speed", &Bearing::conductance_speed, dimension::conductance,
      "added at full speed, with the root of the speed; below 0: less than at rest", Range{-50.0, 50.0});
  }

  void add_to(Assembly& assembly) const {
    auto const viscosity = base_oil();
    Place const shaft = assembly.place(inner), housing = assembly.place(outer);
    std::vector<thermal::Port> const ports{assembly.port(shaft), assembly.port(housing)};
    std::vector<double> c{count,       grease_factor, viscosity.scale, viscosity.temperature, pitch_diameter,
                          load_factor, load_exponent, load_ratio,      torque_load,           inner_share};
    std::vector<int> const speed{assembly.channel("spindle.speed")};
    if (viscous_exponent) {
      c.insert(c.end(), {*viscous_exponent, thermal::viscosity(viscosity, 313.15) * assembly.rated_speed({})});
      assembly.network().add<PalmgrenHeat<true>>(assembly.part(), ports, c, speed);
    } else {
      assembly.network().add<PalmgrenHeat<false>>(assembly.part(), ports, c, speed);
    }
    conduct(assembly, shaft, housing);
  }

 private:
  void conduct(Assembly& assembly, Place const& shaft, Place const& housing) const {
    if (conductance_speed && conductance + *conductance_speed < 0.0)
      throw thermal::InputError("bearing '" + name + "': at full speed its conductance is below 0");
    for (auto const& a : shaft.site.contacts)
      for (auto const& b : housing.site.contacts) {
        auto const from = assembly.node(shaft, a.node), to = assembly.node(housing, b.node);
        double const share = a.share * b.share;
        if (conductance_speed)
          assembly.network().add<BallConduction>(
              assembly.part(), {from, to}, {conductance * share, *conductance_speed * share, assembly.rated_speed({})},
              {assembly.channel("spindle.speed")});
        else
          assembly.network().connect(assembly.part(), from, to, conductance * share);
      }
  }
  [[nodiscard]] thermal::Vogel base_oil() const {
    thermal::Vogel law = thermal::mineral_oil_viscosity(oil);
    double const at_40 = viscosity_factor * thermal::viscosity(law, 313.15);
    law.temperature = viscosity_temperature.value_or(law.temperature);
    law.scale = at_40 * std::exp(-law.temperature / (313.15 - law.pole));
    return law;
  }
};

}  // namespace

Effect const& bearing_effect() {
  static Effect const effect = make_effect<Bearing>(
      {"bearing",
       "friction of a set of spindle bearings, and conduction through its balls",
       "Q = n (M0 + M1) |ω|;  M0 = 4500.9 f0 (νω)^(2/3) d_m³ (νω ≥ 2.0944e-4 m²/s², else 16 f0 d_m³), with a power p "
       "of its own times (νω/(ν40 ω_max))^(p − 2/3);  M1 = z (P0/C0)^y P1 d_m;  ν = A exp(B/(T[°C] + 95)) at the mean "
       "of both rings;  q = (G0 + G1 √(n/n_max)) (T_outer − T_inner)",
       "source, link",
       "shaft and outer ring",
       "power of speed 1.67, falling to 1.0…1.2 in the steady state by the "
       "viscosity's feedback; first seen at the rings; ends at stop",
       "physics.md 1.1, 1.3, 2.4; Palmgren 1957; Harris & Kotzalas 2006",
       {4},
       {"fan_cooling", "rotor_windage", "preload", "grease_run_in"},
       "the same speed from a warm bearing: a wrong viscosity shows at once, a draught or windage "
       "does not; spindle current"},
      {{.amplitude = "grease_factor",
        .largest = 1.0,
        .sites = {{"inner", "bearing", "outer"}},
        .shapes = {{{"pitch_diameter", "90 mm"},
                    {"torque_load", "0 N"},
                    {"conductance", "0 W/K"},
                    {"viscosity_temperature", "0 K"}},
                   {{"pitch_diameter", "90 mm"},
                    {"torque_load", "0 N"},
                    {"conductance", "0 W/K"},
                    {"viscosity_temperature", "1000 K"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
