#include "thermal/contact.h"
#include "thermal/joint.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/joint_side.h"

namespace thermotwin::twin {
namespace {

struct ContactJoint {
  std::string name, from, to, model = "cooper_mikic_yovanovich";
  double pressure = required;
  std::optional<double> area;
  double from_conductivity = 47.5, to_conductivity = 47.5;
  double gap_conductivity = 0.026;
  double gas_parameter = thermal::air_gas_parameter;
  double roughness = 0.8e-6, slope = 0.1, hardness = 2.5e9;
  double peak_heights = 12.6e-6, tensile_strength = 250e6;

  template <class Fields>
  static void fields(Fields& f) {
    using P = ContactJoint;
    f.name("name", &P::name, "unique among these");
    f.name("from", &P::from, "one side");
    f.name("to", &P::to, "other side");
    f.choice("model", &P::model, {"cooper_mikic_yovanovich", "jungnickel"}, "which of the two equations");
    f("pressure", &P::pressure, dimension::pressure, "between the sides: of the bolts' pressure cone", Range{1e5, 2e7});
    f("area", &P::area, dimension::area,
      "of contact, where the places have none or touch in part: 2.5 to 3 bolt heads "
      "wide",
      Range{1e-5, 5.0});
    f("from_conductivity", &P::from_conductivity, dimension::conductivity, "of one side's metal", Range{1, 400});
    f("to_conductivity", &P::to_conductivity, dimension::conductivity, "of the other side's metal", Range{1, 400});
    f("gap_conductivity", &P::gap_conductivity, dimension::conductivity, "of what fills the gaps: air 0.026, oil 0.13",
      Range{0.02, 1.0});
    f("gas_parameter", &P::gas_parameter, dimension::length, "cooper_mikic_yovanovich: of air 0.37 um, of a liquid 0",
      Range{0.0, 1e-6});
    f("roughness", &P::roughness, dimension::length, "cooper_mikic_yovanovich: root of both squared rms heights",
      Range{0.1e-6, 20e-6});
    f("slope", &P::slope, dimension::dimensionless, "cooper_mikic_yovanovich: root of both squared asperity slopes",
      Range{0.05, 0.4});
    f("hardness", &P::hardness, dimension::pressure, "cooper_mikic_yovanovich: of the softer surface",
      Range{1.5e9, 3e9});
    f("peak_heights", &P::peak_heights, dimension::length,
      "jungnickel: Rz of both sides together; of one: milling 6.3, grinding 0.6, scraping 2.5, turning 25 um",
      Range{1e-6, 60e-6});
    f("tensile_strength", &P::tensile_strength, dimension::stress, "jungnickel: of the softer metal",
      Range{100e6, 1500e6});
  }

  void add_to(Assembly& assembly) const {
    Place const a = joint_side(assembly, from), b = joint_side(assembly, to);
    auto& network = assembly.network();
    if (area) return connect(network, assembly.part(), a.site, b.site, coefficient() * *area);
    connect_by_area(network, assembly.part(), a.site, b.site, coefficient());
  }

 private:
  [[nodiscard]] double coefficient() const {
    if (model == "jungnickel")
      return thermal::jungnickel_joint_film<double>(gap_conductivity, from_conductivity, to_conductivity, peak_heights,
                                                    pressure, tensile_strength);
    return thermal::joint_film<double>({from_conductivity, to_conductivity, roughness, slope, hardness}, pressure,
                                       gap_conductivity, gas_parameter);
  }
};

}  // namespace

Effect const& contact_joint_effect() {
  static Effect const effect = make_effect<ContactJoint>(
      {"contact_joint", "conduction through a bolted or flat joint, from its pressure and its roughness",
       "h = 1.25 (k m/σ)(p/H)^0.95 + k_g/(Y + M), k = 2k1k2/(k1+k2), Y = 1.53 σ (p/H)^(−0.097);  jungnickel: h = 6.7 "
       "[k_g/ΣRz + 928 k1k2/(k1+k2) (κp/σ_B)^0.86], κ = 15 um/ΣRz (fine) … 1 (coarse)",
       "link", "any two places; their cells are paired by exact overlap",
       "settles with the bodies that it joins; seen only where its resistance is comparable with those in series",
       "physics.md 2.2 (2.1); Cooper, Mikic & Yovanovich 1969; Jungnickel 2010"});
  return effect;
}

}  // namespace thermotwin::twin
