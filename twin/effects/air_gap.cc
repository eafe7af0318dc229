#include "thermal/error.h"
#include "thermal/joint.h"
#include "thermal/laws.h"
#include "thermal/natural_convection.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/joint_side.h"

namespace thermotwin::twin {
namespace {

/// q = h A (T₁ − T₀)/(1 + h A R). Ports: cells of either wall. c = {A, R of both half cells, width, height}.
struct VerticalGap {
  static constexpr std::string_view name = "closed vertical gap";
  static constexpr int ports = 2, coefficients = 4, inputs = 0;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const*, S* q) {
    S const conductance = c[0] * thermal::vertical_gap_film<S>(T[0], T[1], c[2], c[3]);
    thermal::exchange<S>(conductance / (1.0 + conductance * c[1]) * (T[1] - T[0]), q);
  }
};

/// Ports: cells of bottom and top. c = {A, R of both half cells, width}.
struct HorizontalGap {
  static constexpr std::string_view name = "closed horizontal gap";
  static constexpr int ports = 2, coefficients = 3, inputs = 0;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const*, S* q) {
    S const conductance = c[0] * thermal::horizontal_gap_film<S>(T[0], T[1], c[2]);
    thermal::exchange<S>(conductance / (1.0 + conductance * c[1]) * (T[1] - T[0]), q);
  }
};

struct AirGap {
  std::string name, from, to;
  double width = required;
  std::optional<double> height, area;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &AirGap::name, "unique among these");
    f.name("from", &AirGap::from, "one wall; of a horizontal gap the bottom");
    f.name("to", &AirGap::to, "other wall; of a horizontal gap the top");
    f("width", &AirGap::width, dimension::length, "between the walls", Range{1e-3, 0.3}.above_zero());
    f("height", &AirGap::height, dimension::length, "of a vertical gap; without it the gap is horizontal",
      Range{0.02, 3.0}.above_zero());
    f("area", &AirGap::area, dimension::area, "of one wall, where the places have none", Range{1e-3, 5.0});
  }

  void add_to(Assembly& assembly) const {
    Place const a = joint_side(assembly, from), b = joint_side(assembly, to);
    for (auto const& pair : thermal::pair(a.site, b.site)) {
      double const wall = area ? *area * pair.share : pair.area;
      if (!(wall > 0.0)) throw thermal::InputError("air_gap '" + name + "': neither side has an area; give one");
      std::vector<thermal::Port> const ports = {assembly.node(a, pair.a), assembly.node(b, pair.b)};
      if (height)
        assembly.network().add<VerticalGap>(assembly.part(), ports, {wall, pair.resistance, width, *height});
      else
        assembly.network().add<HorizontalGap>(assembly.part(), ports, {wall, pair.resistance, width});
    }
  }
};

}  // namespace

Effect const& air_gap_effect() {
  static Effect const effect = make_effect<AirGap>(
      {"air_gap",
       "free convection through a closed gap: behind a cover, between cabinet and column",
       "q = h A (T_to − T_from), h = Nu k/width;  vertical: Nu = 0.42 Pr^0.012 Ra^(1/4) (H/w)^(−1/4), turbulent 0.049 "
       "Ra^(1/3), at least 1;  horizontal, warm below: Nu = 1 up to Ra 1708, 0.208 Ra^(1/4), 0.092 Ra^(1/3); warm "
       "above: 1",
       "link",
       "two walls that face each other",
       "grows with |ΔT|^(5/4); does not follow speed; radiation comes besides",
       "physics.md 2.6; VDI Heat Atlas; Jungnickel 2010",
       {23},
       {"radiation"},
       "shield between the walls: radiation falls, convection stays"});
  return effect;
}

}  // namespace thermotwin::twin
