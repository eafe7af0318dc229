#include "thermal/feed_drive.h"
#include "thermal/stroke.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/feed_torque.h"

namespace thermotwin::twin {
namespace {

/// Q = d (F + c ν(T)/ν₄₀ v) v. Ports: rail, carriage. c = {F, c, A, B, rail's share}, u = {v, d}.
struct RollingGuideHeat {
  static constexpr std::string_view name = "friction of a rolling guide";
  static constexpr int ports = 2, coefficients = 5, inputs = 2;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    S const viscosity = flow_ratio<S>(c[2], c[3], 0.5 * (T[0] + T[1]), 1.0, S(1.0));
    S const heat = u[1] * (c[0] + c[1] * viscosity * u[0]) * u[0];
    q[0] = c[4] * heat;
    q[1] = (1.0 - c[4]) * heat;
  }
};

/// Q = d W μ(v) v with Stribeck's μ. Ports: rail, carriage. c = {W, μ_s, μ_c, v_s, k, rail's share}, u = {v, d}.
struct SlidewayHeat {
  static constexpr std::string_view name = "friction of a slideway";
  static constexpr int ports = 2, coefficients = 6, inputs = 2;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const*, S const* c, double const* u, S* q) {
    if (u[0] == 0.0) return;
    S const force = thermal::slideway_force<S>({c[1], c[2], c[3], c[4]}, c[0], S(u[0]));
    S const heat = u[1] * force * u[0];
    q[0] = c[5] * heat;
    q[1] = (1.0 - c[5]) * heat;
  }
};

struct Guide {
  std::string name, rail, carriage, axis = "z", kind = "rolling";
  std::optional<double> carriage_length;
  double load = required;
  double rolling_friction = 0.003, seal_force = 10.0, viscous_force = 0.0;
  int oil = 68;
  double static_friction = 0.1, sliding_friction = 0.04, stribeck_speed = 0.02, viscous_friction = 0.0;
  double reference_feed = 0.2;
  double rail_share = 0.5;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Guide::name, "unique among these");
    f.name("rail", &Guide::rail, "place of the rails");
    f.name("carriage", &Guide::carriage, "place of the carriages");
    f("axis", &Guide::axis, "whose feed moves it");
    f.choice("kind", &Guide::kind, {"rolling", "sliding"}, "linear bearing, or slideway with Stribeck's curve");
    f("carriage_length", &Guide::carriage_length, dimension::length,
      "spreads the rail's heat along the stroke; the rail is then a bar or cylinder that starts where the screw does",
      Range{0.02, 2.0});
    f("load", &Guide::load, dimension::force, "all normal forces, preload included", Range{100, 1e5});
    f("rolling_friction", &Guide::rolling_friction, dimension::dimensionless, "rolling: coefficient",
      Range{0.002, 0.004});
    f("seal_force", &Guide::seal_force, dimension::force, "rolling: of all seals, 3 to 15 N per carriage",
      Range{0.0, 120.0});
    f("viscous_force", &Guide::viscous_force, dimension::force,
      "rolling: at reference feed and 40 degC, with the oil's viscosity", Range{0.0, 200.0});
    f("oil", &Guide::oil, "rolling: ISO viscosity grade of the base oil", Range{10, 100});
    f("static_friction", &Guide::static_friction, dimension::dimensionless, "sliding: coefficient at rest",
      Range{0.04, 0.2});
    f("sliding_friction", &Guide::sliding_friction, dimension::dimensionless, "sliding: its least value",
      Range{0.02, 0.06});
    f("stribeck_speed", &Guide::stribeck_speed, dimension::speed, "sliding: where 63 % of the fall is done",
      Range{1e-3, 0.2}.above_zero());
    f("viscous_friction", &Guide::viscous_friction, dimension::dimensionless,
      "sliding: rise of the coefficient up to the reference feed", Range{0.0, 0.1});
    f("reference_feed", &Guide::reference_feed, dimension::speed, "of the two viscous parts",
      Range{0.01, 2.0}.above_zero());
    f("rail_share", &Guide::rail_share, dimension::dimensionless, "of the heat, into the rail", share_range);
  }

  void add_to(Assembly& assembly) const {
    std::vector<thermal::Port> const ports = {rail_port(assembly), assembly.port(carriage)};
    std::vector<int> const inputs = {assembly.channel(axis + ".feed"), assembly.channel(axis + ".duty")};
    if (kind == "sliding") {
      assembly.network().add<SlidewayHeat>(
          assembly.part(), ports,
          {load, static_friction, sliding_friction, stribeck_speed, viscous_friction / reference_feed, rail_share},
          inputs);
      return;
    }
    auto const viscosity = thermal::mineral_oil_viscosity(oil);
    assembly.network().add<RollingGuideHeat>(assembly.part(), ports,
                                             {rolling_friction * load + seal_force, viscous_force / reference_feed,
                                              viscosity.scale, viscosity.temperature, rail_share},
                                             inputs);
  }

 private:
  [[nodiscard]] thermal::Port rail_port(Assembly& assembly) const {
    if (!carriage_length) return assembly.port(rail);
    return thermal::add_moving_average(assembly.network(), assembly.place(rail).site,
                                       assembly.channel(axis + ".stroke_from"), assembly.channel(axis + ".stroke_to"),
                                       *carriage_length);
  }
};

}  // namespace

Effect const& guide_effect() {
  static Effect const effect = make_effect<Guide>(
      {"guide",
       "friction of linear guides or slideways of an axis",
       "Q = d F v, d the share of time in motion;  rolling: F = μ W + F_seal + F_v (ν(T)/ν40) v/v_r;  sliding: F = W "
       "[μ_c + (μ_s − "
       "μ_c) e^(−(v/v_s)²) + k v/v_r]",
       "source",
       "rail on column or bed, carriage",
       "proportional to the feed, spread over the stroke; bends the column (front warm); 5…60 W per axis; ends at stop",
       "physics.md 1.10, 2.11, §7 no. 19",
       {19},
       {"ball_nut", "nut_reversal", "nut_preload"},
       "sensors on rail and nut; the same mean feed with another stroke; torque of the axis"},
      {{.amplitude = "load",
        .largest = 1e5,
        .sites = {{"rail", "casting"}, {"carriage", "nut"}},
        .shapes = {{{"seal_force", "0 N"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
