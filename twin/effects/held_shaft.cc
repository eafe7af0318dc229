#include "thermal/shaft_deformation.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct HeldShaftPart {
  std::string name, displacement, shaft, housing;
  double length = required;
  double front_stiffness = required, rear_stiffness = required;
  double shaft_expansion = 11.8e-6, housing_expansion = 11.5e-6;
  double shaft_area = required, housing_area = required;
  double shaft_modulus = 210e9, housing_modulus = 210e9;
  double weight = 1.0;

  template <class Fields>
  static void fields(Fields& f) {
    using P = HeldShaftPart;
    f.name("name", &P::name, "unique among these");
    f.name("displacement", &P::displacement, "channel that it moves");
    f.name("shaft", &P::shaft, "stretch of the shaft between the bearings");
    f.name("housing", &P::housing, "stretch of the housing between the bearings");
    f("length", &P::length, dimension::length, "between the bearings", plausible_length);
    f("front_stiffness", &P::front_stiffness, dimension::stiffness, "of the front bearing and its seat, along the axis",
      plausible_stiffness.above_zero());
    f("rear_stiffness", &P::rear_stiffness, dimension::stiffness, "of the rear bearing and its seat",
      plausible_stiffness);
    f("shaft_expansion", &P::shaft_expansion, dimension::expansion, "of the shaft", Range{3e-6, 24e-6});
    f("housing_expansion", &P::housing_expansion, dimension::expansion, "of the housing", Range{3e-6, 24e-6});
    f("shaft_area", &P::shaft_area, dimension::area, "section of the shaft", plausible_area.above_zero());
    f("housing_area", &P::housing_area, dimension::area, "section of the housing", plausible_area.above_zero());
    f("shaft_modulus", &P::shaft_modulus, dimension::stress, "Young's modulus of the shaft",
      plausible_modulus.above_zero());
    f("housing_modulus", &P::housing_modulus, dimension::stress, "Young's modulus of the housing",
      plausible_modulus.above_zero());
    f("weight", &P::weight, dimension::dimensionless, "sign with which the shaft's way outwards counts in the channel",
      Range{-1.0, 1.0});
  }

  void add_to(Assembly& assembly) const {
    thermal::HeldShaft const held{front_stiffness, rear_stiffness, length / (shaft_modulus * shaft_area),
                                  length / (housing_modulus * housing_area)};
    double const share = weight * held.front_share() * length;
    assembly.displace(TemperatureTerm{displacement, assembly.place(shaft), share * shaft_expansion});
    assembly.displace(TemperatureTerm{displacement, assembly.place(housing), -share * housing_expansion});
  }
};

}  // namespace

Effect const& held_shaft_effect() {
  static Effect const effect = make_effect<HeldShaftPart>(
      {"held_shaft", "a shaft held at both ends pushes its front bearing outwards as it grows",
       "u_f = F/k_f,  F = Δ/(1/k_f + 1/k_r + L/(EA)_s + L/(EA)_h),  Δ = ∫(α_s θ_s − α_h θ_h) dz", "deformation",
       "a displacement channel; shaft and housing between the bearings",
       "follows the difference of shaft and housing: grows fast after a start, shrinks as the housing follows",
       "physics.md 3.2"});
  return effect;
}

}  // namespace thermotwin::twin
