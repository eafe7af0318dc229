#include "thermal/preload.h"

#include <cmath>

#include "thermal/physical_constant.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

/// Ports: inner ring, outer ring, shaft and housing over the span. u = {ω}.
/// c = {M₁, 1.5 (1 + y), T_assembly, approach per K of inner ring, outer ring, balls, shaft, housing, approach per ω²,
/// δ₀, inner share}.
struct PreloadHeat {
  static constexpr std::string_view name = "friction of thermally induced preload";
  static constexpr int ports = 4, coefficients = 11, inputs = 1;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    if (u[0] == 0.0) return;
    using std::pow;
    S const ball = 0.5 * (T[0] + T[1]);
    S const approach = c[3] * (T[0] - c[2]) + c[4] * (T[1] - c[2]) + c[5] * (ball - c[2]) + c[6] * (T[2] - c[2]) +
                       c[7] * (T[3] - c[2]) + c[8] * (u[0] * u[0]);
    S const deflection = 1.0 + approach / c[9];
    S const change = deflection > S(0.0) ? S(pow(deflection, c[1]) - 1.0) : S(-1.0);
    S const heat = c[0] * change * u[0];
    q[0] = c[10] * heat;
    q[1] = (1.0 - c[10]) * heat;
  }
};

struct Preload {
  std::string name, inner, outer, arrangement = "back_to_back";
  double torque = required;
  double load_exponent = 0.38;
  int balls = 20;
  double ball_diameter = required, pitch_diameter = required, bore = 0.0;
  double contact_angle = 15.0 * std::numbers::pi / 180.0;
  double axial_preload = required;
  std::optional<double> deflection;
  double ring_expansion = 12.1e-6, shaft_expansion = 11.8e-6, housing_expansion = 11.5e-6;
  std::string shaft, housing;
  double span = 0.0;
  double assembly_temperature = thermal::reference_temperature;
  double inner_share = 0.5;

  template <class Fields>
  static void fields(Fields& f) {
    using P = Preload;
    f.name("name", &P::name, "unique among these");
    f.name("inner", &P::inner, "place of the inner rings, on the shaft");
    f.name("outer", &P::outer, "place of the outer rings");
    f.choice("arrangement", &P::arrangement, {"back_to_back", "face_to_face"},
             "a hot shaft unloads a back-to-back pair along the axis and loads a face-to-face one");
    f("torque", &P::torque, dimension::torque, "that the initial preload causes, of the whole set", Range{0.002, 0.1});
    f("load_exponent", &P::load_exponent, dimension::dimensionless, "y: the torque grows with preload^(1 + y)",
      Range{0.3, 0.6});
    f("balls", &P::balls, "in one bearing", Range{3, 100});
    f("ball_diameter", &P::ball_diameter, dimension::length, "D_b", Range{0.001, 0.1}.above_zero());
    f("pitch_diameter", &P::pitch_diameter, dimension::length, "d_m", Range{0.005, 1.0}.above_zero());
    f("bore", &P::bore, dimension::length, "of the shaft, for the centrifugal growth of the inner ring",
      Range{0.0, 0.5});
    f("contact_angle", &P::contact_angle, dimension::angle, "unloaded, for example \"15 deg\"",
      Range{0.17, 0.7}.above_zero());
    f("axial_preload", &P::axial_preload, dimension::force, "of one bearing at assembly", Range{50, 5000});
    f("deflection", &P::deflection, dimension::length,
      "δ0 of ball and races under that preload; default: after Palmgren", Range{1e-6, 6e-6}.above_zero());
    f("ring_expansion", &P::ring_expansion, dimension::expansion, "of rings and balls", Range{3e-6, 13e-6});
    f("shaft_expansion", &P::shaft_expansion, dimension::expansion, "of the shaft", Range{3e-6, 24e-6});
    f("housing_expansion", &P::housing_expansion, dimension::expansion, "of the housing", Range{3e-6, 24e-6});
    f("shaft", &P::shaft, "stretch of the shaft between the bearings; default: the inner rings' place");
    f("housing", &P::housing, "stretch of the housing between the bearings; default: the outer rings' place");
    f("span", &P::span, dimension::length, "between the bearings that are braced against each other", Range{0.0, 2.0});
    f.temperature("assembly_temperature", &P::assembly_temperature, "at which the initial preload holds");
    f("inner_share", &P::inner_share, dimension::dimensionless, "of the heat, into the inner rings", share_range);
  }

  void add_to(Assembly& assembly) const {
    auto const inner_port = assembly.port(inner), outer_port = assembly.port(outer);
    using Growth = thermal::PairGrowth<double>;
    assembly.network().add<PreloadHeat>(
        assembly.part(),
        {inner_port, outer_port, shaft.empty() ? inner_port : assembly.port(shaft),
         housing.empty() ? outer_port : assembly.port(housing)},
        {torque, 1.5 * (1.0 + load_exponent), assembly_temperature, approach(Growth{.inner = 1.0}),
         approach(Growth{.outer = 1.0}), approach(Growth{.ball = 1.0}),
         approach(Growth{.shaft_elongation = shaft_expansion * span}),
         approach(Growth{.housing_elongation = housing_expansion * span}),
         approach(Growth{.centrifugal = centrifugal_growth()}), initial_deflection(), inner_share},
        {assembly.channel("spindle.speed")});
  }

 private:
  [[nodiscard]] thermal::BallBearing bearing() const { return {balls, ball_diameter, pitch_diameter, contact_angle}; }
  [[nodiscard]] double approach(thermal::PairGrowth<double> const& growth) const {
    using thermal::PairArrangement;
    auto const pair = arrangement == "back_to_back" ? PairArrangement::back_to_back : PairArrangement::face_to_face;
    return thermal::normal_approach<double>(bearing(), pair, ring_expansion, growth);
  }
  /// Of the inner race at 1 rad/s [m].
  [[nodiscard]] double centrifugal_growth() const {
    thermal::RotatingRing const ring{0.5 * bore, bearing().inner_contact_radius()};
    return thermal::centrifugal_growth<double>(ring, ring.outer_radius, 1.0);
  }
  [[nodiscard]] double initial_deflection() const {
    if (deflection) return *deflection;
    return thermal::contact_deflection<double>(bearing(), thermal::ball_load<double>(bearing(), axial_preload));
  }
};

}  // namespace

Effect const& preload_effect() {
  static Effect const effect = make_effect<Preload>(
      {"preload",
       "heat that a rigidly preloaded bearing makes more or less as its preload changes",
       "ΔQ = M1 [(F/F0)^(1+y) − 1] ω;  F/F0 = (1 + δ/δ0)₊^(3/2);  δ = cos α [α_b (r_i θ_i − r_o θ_o) + u(ω)] + α_b D_b "
       "θ_b "
       "∓ ½ sin α [α_s ∫θ_s dz − α_h ∫θ_h dz];  δ0 = 4.36e-4 mm (Q²/D_b)^(1/3), Q in N, D_b in mm",
       "source",
       "both rings of a bearing with rigid preload",
       "grows with T_i − T_o: bearing temperature overshoots 5…30 min after a start, power of speed 1.5 to 2.5; little "
       "after slow ramps; a cold start differs from a warm one",
       "physics.md 1.4 (1.7), (1.8), (1.9), §7 no. 1; Stein & Tu 1994; Bossmanns & Tu 1999",
       {1},
       {"bearing", "rotor_windage", "fan_cooling", "grease_run_in"},
       "fast start from cold against a slow ramp; restart within 10 min; torque or current of the spindle"},
      {{.amplitude = "torque",
        .largest = 0.1,
        .sites = {{"inner", "bearing", "outer"}},
        .shapes = {{{"ball_diameter", "12 mm"},
                    {"pitch_diameter", "90 mm"},
                    {"axial_preload", "300 N"},
                    {"deflection", "2 um"}},
                   {{"ball_diameter", "12 mm"},
                    {"pitch_diameter", "90 mm"},
                    {"axial_preload", "300 N"},
                    {"deflection", "5 um"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
