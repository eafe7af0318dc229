#include "thermal/joint.h"

#include <optional>

#include "thermal/error.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/joint_side.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

struct Joint {
  std::string name;
  std::string from, to;
  std::optional<double> conductance;  ///< [W/K]
  std::optional<double> coefficient;  ///< [W/(m² K)]
  std::optional<double> area;         ///< [m²]
  std::optional<double> in_series;    ///< [W/K]
  bool welded = false;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Joint::name, "unique among the joints");
    f.name("from", &Joint::from, "one side");
    f.name("to", &Joint::to, "other side");
    f("conductance", &Joint::conductance, dimension::conductance, "of the whole joint", Range{0.01, 1e4});
    f("coefficient", &Joint::coefficient, dimension::film_coefficient,
      "instead: per area of contact; bolted 5 to 15 kW/(m2 K), dry light 2 to 5, sliding fit 0.8", Range{100, 1e5});
    f("area", &Joint::area, dimension::area, "of contact, where the places have none or touch in part", plausible_area);
    f("in_series", &Joint::in_series, dimension::conductance, "a further conductance on the way", Range{0.0, 1e6});
    f("welded", &Joint::welded, "one piece of metal: only the half cells resist");
  }

  void check(Value const& table) const {
    for (auto const* key : {"coefficient", "area"}) refuse_both(table, key, "conductance");
  }

  void add_to(Assembly& assembly) const {
    Place const a = joint_side(assembly, from), b = joint_side(assembly, to);
    auto& network = assembly.network();
    if (welded) return weld(network, assembly.part(), a.site, b.site);
    if (conductance) return connect(network, assembly.part(), a.site, b.site, series(*conductance));
    if (!coefficient)
      throw thermal::InputError("joint '" + name + "' needs a conductance, or a coefficient, or welded = true");
    if (area) return connect(network, assembly.part(), a.site, b.site, series(*coefficient * *area));
    connect_by_area(network, assembly.part(), a.site, b.site, *coefficient);
  }

 private:
  [[nodiscard]] double series(double g) const { return in_series ? 1.0 / (1.0 / g + 1.0 / *in_series) : g; }
};

}  // namespace

Effect const& joint_effect() {
  static Effect const effect = make_effect<Joint>(
      {"joint", "conduction between two bodies through a bolted, flat or sliding contact",
       "q = G (T_to − T_from);  G given, or h·A;  between cells G = 1/(r_a/A + 1/(hA) + r_b/A)", "link",
       "any two places; their cells are paired by exact overlap",
       "settles with the bodies that it joins; seen only where its resistance is comparable with those in series",
       "physics.md 2.2, (0.2); Cooper, Mikic & Yovanovich 1969"});
  return effect;
}

}  // namespace thermotwin::twin
