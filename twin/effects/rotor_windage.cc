#include <cmath>

#include "thermal/error.h"
#include "thermal/fluid.h"
#include "thermal/windage.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

/// What is not the rotor's share goes to the stator, or to the air.
template <class S>
void share_heat(S const& heat, S const& rotor_share, S const& stator_share, S* q) {
  q[0] = rotor_share * heat;
  q[1] = stator_share * heat;
}

/// P = P_r (ω/ω_r)^m. Ports: rotor, stator. c = {shares of rotor and stator, P_r, m, ω_r}, u = {ω}.
struct KnownWindage {
  static constexpr std::string_view name = "windage of known power";
  static constexpr int ports = 2, coefficients = 5, inputs = 1;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const*, S const* c, double const* u, S* q) {
    if (u[0] == 0.0) return;
    using std::pow;
    share_heat<S>(c[2] * pow(S(u[0] / c[4]), c[3]), c[0], c[1], q);
  }
};

/// c = {shares of rotor and stator, radius, length, gap}, u = {ω}.
struct GapWindage {
  static constexpr std::string_view name = "windage in a rotor's gap";
  static constexpr int ports = 2, coefficients = 5, inputs = 1;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    if (u[0] == 0.0) return;
    auto const air = thermal::properties(thermal::Air{}, S(0.5 * (T[0] + T[1])));
    share_heat<S>(thermal::gap_windage<S>(S(u[0]), c[2], c[3], c[4], air.density, air.kinematic_viscosity), c[0], c[1],
                  q);
  }
};

/// c = {shares of rotor and stator, radius}, u = {ω}.
struct DiscWindage {
  static constexpr std::string_view name = "windage of a disc";
  static constexpr int ports = 2, coefficients = 3, inputs = 1;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    if (u[0] == 0.0) return;
    auto const air = thermal::properties(thermal::Air{}, T[0]);
    share_heat<S>(thermal::disc_windage<S>(S(u[0]), c[2], air.density, air.kinematic_viscosity), c[0], c[1], q);
  }
};

struct RotorWindage {
  std::string name, rotor, stator, kind = "known";
  double rotor_share = 0.5;
  double stator_share = 0.5;
  std::optional<double> power, rated_speed, diameter, length, gap;
  double exponent = 3.0;

  template <class Fields>
  static void fields(Fields& f) {
    using P = RotorWindage;
    f.name("name", &P::name, "unique among these");
    f.name("rotor", &P::rotor, "place on what turns");
    f("stator", &P::stator, "place that faces it; without one that share of the heat goes to the air");
    f.choice("kind", &P::kind, {"known", "gap", "disc"},
             "power known at one speed; gap between cylinders; disc or chuck in free air");
    f("rotor_share", &P::rotor_share, dimension::dimensionless, "of the heat, into the rotor", share_range);
    f("stator_share", &P::stator_share, dimension::dimensionless, "of the heat, into the stator", share_range);
    f("power", &P::power, dimension::power, "known: at rated speed", Range{2, 150});
    f("exponent", &P::exponent, dimension::dimensionless, "known: of the speed", Range{2.0, 3.0});
    f("rated_speed", &P::rated_speed, dimension::angular_speed, "known: default the spindle's maximum",
      plausible_speed);
    f("diameter", &P::diameter, dimension::length, "of rotor or disc", Range{0.01, 1.0}.above_zero());
    f("length", &P::length, dimension::length, "of the rotor in its gap", Range{0.01, 1.0}.above_zero());
    f("gap", &P::gap, dimension::length, "between rotor and stator", Range{0.1e-3, 5e-3}.above_zero());
  }

  void check(Value const& table) const {
    if (!stator.empty()) refuse_more_than_whole(table, {{"rotor_share", rotor_share}, {"stator_share", stator_share}});
  }

  void add_to(Assembly& assembly) const {
    auto const rotor_port = assembly.port(rotor);
    auto const stator_port = stator.empty() ? rotor_port : assembly.port(stator);
    double const other_share = stator.empty() ? 0.0 : stator_share;
    int const part = assembly.part(), speed = assembly.channel("spindle.speed");
    auto& network = assembly.network();
    if (kind == "known")
      network.add<KnownWindage>(
          part, {rotor_port, stator_port},
          {rotor_share, other_share, given(power, "power"), exponent, assembly.rated_speed(rated_speed)}, {speed});
    else if (kind == "gap")
      network.add<GapWindage>(
          part, {rotor_port, stator_port},
          {rotor_share, other_share, 0.5 * given(diameter, "diameter"), given(length, "length"), given(gap, "gap")},
          {speed});
    else
      network.add<DiscWindage>(part, {rotor_port, stator_port},
                               {rotor_share, other_share, 0.5 * given(diameter, "diameter")}, {speed});
  }

 private:
  [[nodiscard]] double given(std::optional<double> const& value, std::string const& key) const {
    if (value) return *value;
    throw thermal::InputError("rotor_windage '" + name + "' of kind " + kind + " needs a " + key);
  }
};

}  // namespace

Effect const& rotor_windage_effect() {
  static Effect const effect = make_effect<RotorWindage>(
      {"rotor_windage",
       "air friction of a motor's rotor in its gap, of a disc or a chuck",
       "known: P = P_r (ω/ω_r)^m;  gap: P = π C_f ρ ω³ r⁴ L, 1/√C_f = 2.04 + 1.768 ln(Re_δ √C_f);  disc: P = ½ C_M ρ "
       "ω³ r⁵, "
       "C_M = 3.87 Re^(−1/2), turbulent 0.146 Re^(−1/5)",
       "source",
       "rotor and stator, shaft, chuck",
       "power of speed 3 (2.7 in a turbulent gap): only above 70 % of the maximum speed; does not depend on "
       "temperature; ends at stop",
       "physics.md 1.7, 1.12, §7 no. 18; Vrancik 1968; Dorfman 1963",
       {18},
       {"bearing", "preload", "motor_loss", "fan_cooling"},
       "runs at 60, 80 and 100 % of the speed; coast-down: a torque with the square of the speed"},
      {{.amplitude = "power",
        .largest = 150.0,
        .needs_spindle = true,
        .sites = {{"rotor", "shaft"}},
        .shapes = {{{"rotor_share", "1"}}}},
       {.amplitude = "power",
        .largest = 150.0,
        .needs_spindle = true,
        .sites = {{"rotor", "motor"}},
        .shapes = {{{"rotor_share", "1"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
