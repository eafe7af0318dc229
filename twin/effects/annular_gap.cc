#include "thermal/annular_gap.h"

#include <map>
#include <memory>

#include "thermal/error.h"
#include "thermal/joint.h"
#include "thermal/laws.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/joint_side.h"

namespace thermotwin::twin {
namespace {

struct BeckerKayeTaylor {
  static constexpr std::string_view name = "annular gap after Becker and Kaye, steps in Ta";
  template <class S>
  static S film(S const& a, S const& b, S const& radius, S const& gap, double speed) {
    return thermal::annular_gap_film<S>(a, b, radius, gap, S(speed));
  }
};

struct BeckerKaye {
  static constexpr std::string_view name = "annular gap after Becker and Kaye";
  template <class S>
  static S film(S const& a, S const& b, S const& radius, S const& gap, double speed) {
    auto const air = thermal::properties(thermal::Air{}, S(0.5 * (a + b)));
    S const taylor = thermal::taylor_number<S>(S(speed), radius, gap, air.kinematic_viscosity);
    return 0.5 * thermal::becker_kaye_nusselt<S>(taylor) * air.conductivity / gap;
  }
};

struct Jungnickel {
  static constexpr std::string_view name = "annular gap after Jungnickel";
  template <class S>
  static S film(S const&, S const&, S const& radius, S const& gap, double speed) {
    return thermal::jungnickel_gap_film<S>(radius, gap, S(speed));
  }
};

/// q = U A (T₁ − T₀)/(1 + U A R). Ports: cells of either wall. c = {A, R of both half cells, r_m, δ}, u = {ω}.
template <class Correlation>
struct GapLaw {
  static constexpr std::string_view name = Correlation::name;
  static constexpr int ports = 2, coefficients = 4, inputs = 1;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    S const conductance = c[0] * Correlation::template film<S>(T[0], T[1], c[2], c[3], u[0]);
    thermal::exchange<S>(conductance / (1.0 + conductance * c[1]) * (T[1] - T[0]), q);
  }
};

std::map<std::string, std::shared_ptr<thermal::Law const>> const& gap_correlations() {
  static std::map<std::string, std::shared_ptr<thermal::Law const>> const laws = {
      {"taylor", thermal::law_of<GapLaw<BeckerKayeTaylor>>()},
      {"becker_kaye", thermal::law_of<GapLaw<BeckerKaye>>()},
      {"jungnickel", thermal::law_of<GapLaw<Jungnickel>>()}};
  return laws;
}

struct AnnularGap {
  std::string name, rotor, stator, correlation = "taylor", speed = "spindle.speed";
  double diameter = required, gap = required;
  std::optional<double> area;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &AnnularGap::name, "unique among these");
    f.name("rotor", &AnnularGap::rotor, "surface that turns");
    f.name("stator", &AnnularGap::stator, "surface that stands");
    f.choice("correlation", &AnnularGap::correlation, {"taylor", "becker_kaye", "jungnickel"},
             "taylor: conduction, vortices from Ta = 41, turbulence from 100; jungnickel: only while it turns");
    f("diameter", &AnnularGap::diameter, dimension::length, "mean of rotor and stator", Range{0.01, 1.0}.above_zero());
    f("gap", &AnnularGap::gap, dimension::length, "between the walls", Range{0.1e-3, 5e-3}.above_zero());
    f("area", &AnnularGap::area, dimension::area, "of one wall, where the places have none", Range{1e-4, 2.0});
    f("speed", &AnnularGap::speed, "input channel with the speed");
  }

  void add_to(Assembly& assembly) const {
    Place const a = joint_side(assembly, rotor), b = joint_side(assembly, stator);
    for (auto const& pair : thermal::pair(a.site, b.site)) {
      double const wall = area ? *area * pair.share : pair.area;
      if (!(wall > 0.0)) throw thermal::InputError("annular_gap '" + name + "': neither side has an area; give one");
      assembly.network().add(gap_correlations().at(correlation), assembly.part(),
                             {assembly.node(a, pair.a), assembly.node(b, pair.b)},
                             {wall, pair.resistance, 0.5 * diameter, gap}, {assembly.channel(speed)});
    }
  }
};

}  // namespace

Effect const& annular_gap_effect() {
  static Effect const effect = make_effect<AnnularGap>(
      {"annular_gap", "heat through the air gap of a rotor in its stator, or a shaft in its housing",
       "q = U A (T_stator − T_rotor),  U = Nu k/2δ;  Ta = (ω r δ/ν)(δ/r)^(1/2):  Nu = 2 up to Ta 41, 0.202 Ta^0.63 "
       "Pr^0.27 "
       "up to 100, 0.386 Ta^(1/2) Pr^0.27 above;  becker_kaye: 2, 0.128 (Ta²)^0.367, 0.409 (Ta²)^0.241;  jungnickel: U "
       "= "
       "0.765 (ωr)^(2/3) δ^(−1/3)",
       "link", "rotor and stator, shaft and cartridge",
       "ties rotor to stator more closely with speed^0.5; at stop only conduction is left",
       "physics.md 2.8 (2.9); Becker & Kaye 1962; Staton & Cavagnino 2008; Jungnickel 2010"});
  return effect;
}

}  // namespace thermotwin::twin
