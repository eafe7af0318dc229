#include "thermal/rolling_contact.h"

#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/part_time_motion.h"

namespace thermotwin::twin {
namespace {

/// Q = k₀ w̄ (w e^{B/(T − T_p)})^{k₂}: w while moving, w̄ its mean over time. Ports: the two sides. c = {k₀, k₂, B, first
/// share}, u as of part_time_motion.h; of a guide {share of the time in motion, w}.
template <bool of_guide>
struct RollingContactHeat {
  static constexpr std::string_view name = of_guide ? "friction of a guide's contacts" : "friction of rolling contacts";
  static constexpr int ports = 2, coefficients = 4, inputs = 2;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    double const speed = of_guide ? u[1] : moving_speed(u), mean = of_guide ? u[0] * u[1] : u[0];
    if (mean == 0.0) return;
    using std::exp;
    S const temperature = 0.5 * (T[0] + T[1]);
    thermal::within<S>(thermal::vogel_cameron_temperature, temperature);
    S const flow = std::log(speed) + c[2] / (temperature - thermal::Vogel{}.pole);
    S const heat = c[0] * mean * exp(S(c[1] * flow));
    q[0] = c[3] * heat;
    q[1] = (1.0 - c[3]) * heat;
  }
};

struct RollingContactPart {
  std::string name, first, second, kind = "bearing", axis = "z";
  double factor = 1.0;
  double force = required;
  double elements = 20.0, element_diameter = required;
  double pitch_diameter = 0.04, lead = 0.01, roller_length = 0.01;
  double contact_angle = 0.7853981633974483;
  int oil = 68;
  double oil_density = 870.0;
  bool sealed = true;
  double first_share = 0.5;

  template <class Fields>
  static void fields(Fields& f) {
    using P = RollingContactPart;
    f.name("name", &P::name, "unique among these");
    f.name("first", &P::first, "place on one side: shaft, screw, rail");
    f.name("second", &P::second, "place on the other side: outer ring, nut, carriage");
    f.choice("kind", &P::kind,
             {"bearing", "single_nut", "double_nut", "guide_two_point", "guide_four_point", "guide_roller"},
             "angular contact bearing of the spindle; of an axis: nut, guide");
    f("axis", &P::axis, "of a nut or guide: whose motion counts");
    f("factor", &P::factor, dimension::dimensionless, "to be fitted: the exponents are surer than the magnitude",
      Range{0.2, 5.0});
    f("force", &P::force, dimension::force, "axial load of a bearing, preload of a nut, all normal forces of a guide",
      Range{10, 1e5});
    f("elements", &P::elements, dimension::dimensionless, "balls or rollers; of a nut: circulating turns",
      Range{1, 1000}.above_zero());
    f("element_diameter", &P::element_diameter, dimension::length, "of ball or roller", Range{0.001, 0.1}.above_zero());
    f("pitch_diameter", &P::pitch_diameter, dimension::length, "bearing, nut: of the centres",
      Range{0.005, 1.0}.above_zero());
    f("lead", &P::lead, dimension::length, "nut: travel per revolution", Range{0.001, 0.1}.above_zero());
    f("roller_length", &P::roller_length, dimension::length, "guide_roller: of a roller",
      Range{0.001, 0.1}.above_zero());
    f("contact_angle", &P::contact_angle, dimension::angle, "bearing, nut, for example \"15 deg\"",
      Range{0.17, 1.06}.above_zero());
    f("oil", &P::oil, "ISO viscosity grade of the base oil", Range{10, 100});
    f("oil_density", &P::oil_density, dimension::density, "of the oil", Range{800, 1000});
    f("sealed", &P::sealed, "contact seals double the friction");
    f("first_share", &P::first_share, dimension::dimensionless, "of the heat, into the first side", share_range);
  }

  void add_to(Assembly& assembly) const {
    auto const contact = friction();
    std::vector const sides = {assembly.port(first), assembly.port(second)};
    std::vector<double> const numbers = {factor * contact.factor, contact.exponent, contact.vogel_temperature,
                                         first_share};
    if (kind.starts_with("guide"))
      assembly.network().add<RollingContactHeat<true>>(
          assembly.part(), sides, numbers, {assembly.channel(axis + ".duty"), assembly.channel(axis + ".feed")});
    else
      assembly.network().add<RollingContactHeat<false>>(
          assembly.part(), sides, numbers,
          assembly.friction_channels(kind == "bearing" ? "spindle.speed" : axis + ".speed"));
  }

 private:
  [[nodiscard]] thermal::RollingFriction<double> friction() const {
    thermal::ContactOil const lubricant{thermal::mineral_oil_viscosity(oil), oil_density, sealed};
    double const radius = 0.5 * element_diameter;
    double const each = force / elements;
    if (kind == "bearing")
      return times(elements, thermal::bearing_contact_friction<double>(
                                 {1, element_diameter, pitch_diameter, contact_angle}, lubricant, each));
    if (kind == "guide_roller")
      return times(elements, thermal::roller_guide_contact_friction<double>(1, radius, roller_length, lubricant, each));
    if (kind.starts_with("guide"))
      return times(elements,
                   thermal::ball_guide_contact_friction<double>(
                       kind == "guide_two_point" ? thermal::guide_two_point_law : thermal::guide_four_point_law, 1,
                       radius, lubricant, each));
    return thermal::nut_contact_friction<double>(
        kind == "single_nut" ? thermal::single_nut_law : thermal::double_nut_law,
        {pitch_diameter, lead, element_diameter, elements, contact_angle}, lubricant, force);
  }
  static thermal::RollingFriction<double> times(double count, thermal::RollingFriction<double> one) {
    one.factor *= count;
    return one;
  }
};

}  // namespace

Effect const& rolling_contact_effect() {
  static Effect const effect = make_effect<RollingContactPart>(
      {"rolling_contact", "friction of the lubricated contacts of a bearing, ball nut or linear guide",
       "Q = d k0 ω (ω e^(B/(T[°C] + 95)))^k2, ω while moving, for the share d of the time,  k0 = N a G^g W^w "
       "(ρAt/2E')^k2 F r,  k2 = 0.49…0.60;  of a guide the feed "
       "stands "
       "for ω",
       "source", "bearing rings, screw and nut, rail and carriage",
       "power of speed 1.5, falling as the oil warms; ends at stop",
       "physics.md 1.5 (1.10); Jungnickel 2010, eq. 9.49"});
  return effect;
}

}  // namespace thermotwin::twin
