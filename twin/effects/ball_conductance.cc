#include "thermal/ball_conductance.h"

#include <cmath>
#include <numbers>

#include "thermal/laws.h"
#include "thermal/lubricant.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

/// q = K √(c₁ + 2 ln ω) (T₁ − T₀): (2.5) with c₁ = 14 + 2 ln r_m[m] − 2 ln D_b[mm]. c = {K, c₁}, u = {ω}.
struct SchaeferConductance {
  static constexpr std::string_view name = "rotating balls after Schaefer";
  static constexpr int ports = 2, coefficients = 2, inputs = 1;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    using std::sqrt;
    thermal::within<S>(thermal::schaefer_angular_speed, S(u[0]));
    double const speed = thermal::smooth_abs<double>(u[0], thermal::slowest_rotation);
    thermal::exchange<S>(c[0] * sqrt(S(c[1] + 2.0 * std::log(speed))) * (T[1] - T[0]), q);
  }
};

/// c = {share of the set, balls, r_b, r_m, force, oil conductivity, ρA, B}, u = {ω}.
struct ContactConductance {
  static constexpr std::string_view name = "rolling contacts after Jungnickel";
  static constexpr int ports = 2, coefficients = 8, inputs = 1;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    S const viscosity = thermal::vogel_cameron_viscosity<S>(c[6], c[7], 0.5 * (T[0] + T[1]));
    thermal::RollingElementsOf<S> elements;
    elements.count = c[1];
    elements.radius = c[2];
    elements.pitch_radius = c[3];
    S const conductance = thermal::contact_model_conductance<S>(elements, c[4], c[5], viscosity, S(u[0]));
    thermal::exchange<S>(c[0] * conductance * (T[1] - T[0]), q);
  }
};

struct BallConductance {
  std::string name, inner, outer, model = "schaefer", speed = "spindle.speed";
  double count = 1.0, factor = 1.0;
  double balls = required, ball_diameter = required, pitch_diameter = required;
  double contact_angle = 15.0 * std::numbers::pi / 180.0;
  double axial_load = 300.0;
  int oil = 22;
  double oil_conductivity = 0.13, oil_density = 870.0;

  template <class Fields>
  static void fields(Fields& f) {
    using P = BallConductance;
    f.name("name", &P::name, "unique among these");
    f.name("inner", &P::inner, "place of the inner rings, on the shaft; or the screw");
    f.name("outer", &P::outer, "place of the outer rings; or the nut");
    f.choice("model", &P::model, {"schaefer", "contact", "static"},
             "measured on rotating bearings; contacts and oil film; dry Hertzian contacts at rest");
    f("speed", &P::speed, "input channel with the speed");
    f("count", &P::count, dimension::dimensionless, "bearings in the set", Range{1, 6}.above_zero());
    f("factor", &P::factor, dimension::dimensionless, "to be fitted: the models differ by 7", Range{0.3, 3.0});
    f("balls", &P::balls, dimension::dimensionless, "in one bearing", Range{3, 400}.above_zero());
    f("ball_diameter", &P::ball_diameter, dimension::length, "D_b", Range{0.001, 0.1}.above_zero());
    f("pitch_diameter", &P::pitch_diameter, dimension::length, "d_m", Range{0.005, 1.0}.above_zero());
    f("contact_angle", &P::contact_angle, dimension::angle, "contact, static: unloaded, for example \"15 deg\"",
      Range{0.17, 1.06}.above_zero());
    f("axial_load", &P::axial_load, dimension::force, "contact, static: of one bearing", Range{50, 2e4});
    f("oil", &P::oil, "contact: ISO viscosity grade of the base oil", Range{10, 100});
    f("oil_conductivity", &P::oil_conductivity, dimension::conductivity, "contact: of oil or grease", Range{0.1, 0.2});
    f("oil_density", &P::oil_density, dimension::density, "contact: of the oil", Range{800, 1000});
  }

  void add_to(Assembly& assembly) const {
    Place const shaft = assembly.place(inner), housing = assembly.place(outer);
    for (auto const& a : shaft.site.contacts)
      for (auto const& b : housing.site.contacts)
        add_pair(assembly, assembly.node(shaft, a.node), assembly.node(housing, b.node),
                 factor * count * a.share * b.share);
  }

 private:
  void add_pair(Assembly& assembly, thermal::Port a, thermal::Port b, double share) const {
    auto& network = assembly.network();
    int const part = assembly.part(), input = assembly.channel(speed);
    double const ball_mm = 1e3 * ball_diameter;
    auto const viscosity = thermal::mineral_oil_viscosity(oil);
    if (model == "schaefer")
      network.add<SchaeferConductance>(part, {a, b},
                                       {share * balls * ball_mm * ball_mm / 2400.0,
                                        14.0 + 2.0 * std::log(0.5 * pitch_diameter) - 2.0 * std::log(ball_mm)},
                                       {input});
    else if (model == "contact")
      network.add<ContactConductance>(part, {a, b},
                                      {share, balls, 0.5 * ball_diameter, 0.5 * pitch_diameter, force(),
                                       oil_conductivity, oil_density * viscosity.scale, viscosity.temperature},
                                      {input});
    else
      network.connect(part, a, b, share * static_conductance());
  }
  [[nodiscard]] double force() const { return axial_load / (balls * std::sin(contact_angle)); }
  [[nodiscard]] double static_conductance() const {
    constexpr double steel = 33.0;
    thermal::BallBearing const one{1, ball_diameter, pitch_diameter, contact_angle};
    return balls * thermal::static_ball_conductance<double>(one, axial_load / balls, steel, steel);
  }
};

}  // namespace

Effect const& ball_conductance_effect() {
  static Effect const effect = make_effect<BallConductance>(
      {"ball_conductance", "conduction from inner to outer ring through the balls, as it grows with speed",
       "q = G (T_outer − T_inner);  schaefer: G = z D_b²/2400 √(14 + 2 ln v − 2 ln D_b), D_b in mm, v in m/s;  "
       "contact: per "
       "ball g_c g_f/(2 g_c + g_f) + 0.05 k r_b with contact g_c and oil film g_f;  static: z/(R_i + R_o), R = 1/(2 k "
       "√(ab))",
       "link", "inner and outer ring, screw and nut; beside a bearing whose own conductance is 0 W/K",
       "ties the rings more closely with speed, 3 to 5 W/K from 60 to 6000 rpm; smaller difference between them",
       "physics.md 2.4 (2.5); Schäfer/FAG 1993; Jungnickel 2010; Yovanovich 1967"});
  return effect;
}

}  // namespace thermotwin::twin
