#include <cmath>
#include <numbers>

#include "thermal/error.h"
#include "thermal/shaft_deformation.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct BearingShift {
  std::string name, displacement, inner, outer;
  int balls = 20;
  double ball_diameter = required, pitch_diameter = required;
  double contact_angle = 15.0 * std::numbers::pi / 180.0;
  double preload = required;
  double expansion = 12.1e-6;
  double ball_density = 7800.0;
  double weight = 1.0;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &BearingShift::name, "unique among these");
    f.name("displacement", &BearingShift::displacement, "channel that it moves");
    f.name("inner", &BearingShift::inner, "place of the inner ring, on the shaft");
    f.name("outer", &BearingShift::outer, "place of the outer ring");
    f("balls", &BearingShift::balls, "in one bearing", Range{3, 100});
    f("ball_diameter", &BearingShift::ball_diameter, dimension::length, "D_b", plausible_diameter.above_zero());
    f("pitch_diameter", &BearingShift::pitch_diameter, dimension::length, "d_m", plausible_diameter.above_zero());
    f("contact_angle", &BearingShift::contact_angle, dimension::angle, "unloaded, for example \"15 deg\"",
      Range{0.1, 0.8});
    f("preload", &BearingShift::preload, dimension::force, "of one bearing, along the axis, by springs",
      Range{0.0, 1e6});
    f("expansion", &BearingShift::expansion, dimension::expansion, "of rings and balls", Range{3e-6, 13e-6});
    f("ball_density", &BearingShift::ball_density, dimension::density, "steel 7800, ceramic 3200 kg/m3",
      plausible_density);
    f("weight", &BearingShift::weight, dimension::dimensionless,
      "1: yielding against the preload moves the tool towards positive; -1: the other way", Range{-1.0, 1.0});
  }

  [[nodiscard]] thermal::BallBearing bearing() const { return {balls, ball_diameter, pitch_diameter, contact_angle}; }

  void add_to(Assembly& assembly) const {
    if (!(ball_diameter > 0.0 && ball_diameter < pitch_diameter))
      throw thermal::InputError("bearing_shift '" + name + "': the balls are above 0 and smaller than pitch_diameter");
    if (!(preload > 0.0)) throw thermal::InputError("bearing_shift '" + name + "': 'preload' must be above 0");
    auto const per_kelvin = [&](double inner_rise, double outer_rise) {
      return weight * thermal::spring_preload_shift<double>(bearing(), expansion, inner_rise, outer_rise);
    };
    assembly.displace(TemperatureTerm{displacement, assembly.place(inner), per_kelvin(1.0, 0.0)});
    assembly.displace(TemperatureTerm{displacement, assembly.place(outer), per_kelvin(0.0, 1.0)});
    double const speed = assembly.maximum_spindle_speed();
    auto const shift = [&](double w) { return thermal::centrifugal_ball_shift(bearing(), preload, w, ball_density); };
    if (!(speed > 0.0)) return;
    double const power = std::log2(shift(speed) / shift(0.5 * speed));
    assembly.displace(InputTerm{displacement, "spindle.speed", weight * shift(speed) / std::pow(speed, power), power});
  }
};

}  // namespace

Effect const& bearing_shift_effect() {
  static Effect const effect = make_effect<BearingShift>(
      {"bearing_shift",
       "a spring-preloaded ball bearing shifts the shaft as its contact angle changes",
       "Δ = [cos α (r_i θ_i − r_o θ_o) + D_b ½(θ_i + θ_o)] α_b/sin α + Δ_c(ω_max) (ω/ω_max)^p;  Δ_c from the balls' "
       "centrifugal force, p so that it is exact at half and full speed",
       "deformation",
       "a displacement channel; shaft and outer ring",
       "follows the difference of the rings within minutes, and the speed at once",
       "physics.md 3.2, 3.7; Harris",
       {32},
       {"centrifugal_growth", "compensation", "held_shaft"},
       "stop and go every few minutes: the speed's share follows at once, that of the rings within minutes"},
      {{.amplitude = "weight",
        .largest = 1.0,
        .either_sign = true,
        .sites = {{"displacement", "displacement"}, {"inner", "bearing", "outer"}},
        .shapes = {{{"ball_diameter", "12 mm"}, {"pitch_diameter", "90 mm"}, {"preload", "300 N"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
