#include "thermal/fluid.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

/// q = 2 ṁc (T_in − T_m): the node has the mean of inlet and outlet. c = {V̇ ρ c}, of a cell its share; u = {flag}.
struct MeanTemperatureFlow {
  static constexpr std::string_view name = "coolant flow through a body at mean temperature";
  static constexpr int ports = 2, coefficients = 1, inputs = 1;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    q[0] = 2.0 * u[0] * c[0] * (T[1] - T[0]);
    q[1] = -q[0];
  }
};

struct CoolantFlow {
  std::string name, through;
  double flow = required, density = 850.0, specific_heat = 1950.0;
  std::string inlet = "ambient.temperature";
  double inlet_offset = 0.0;
  std::string while_on = "spindle.running";

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &CoolantFlow::name, "unique among these");
    f.name("through", &CoolantFlow::through, "body of the fluid, at the mean of inlet and outlet");
    f("flow", &CoolantFlow::flow, dimension::volume_flow, "of the pump", Range{0.0, 5e-3});
    f("density", &CoolantFlow::density, dimension::density, "of the fluid", Range{0.5, 5000.0});
    f("specific_heat", &CoolantFlow::specific_heat, dimension::specific_heat, "of the fluid", plausible_specific_heat);
    f("inlet", &CoolantFlow::inlet, "input channel that the inlet follows: room air, or a measured temperature");
    f("inlet_offset", &CoolantFlow::inlet_offset, dimension::temperature_difference, "added to it by the chiller",
      Range{-20, 20});
    f("while_on", &CoolantFlow::while_on, "input channel that runs the pump");
  }

  void add_to(Assembly& assembly) const {
    Place const place = assembly.place(through);
    for (auto const& contact : place.site.contacts)
      assembly.network().add<MeanTemperatureFlow>(
          assembly.part(), {assembly.node(place, contact.node), assembly.boundary(inlet, inlet_offset)},
          {contact.share * flow * density * specific_heat}, {assembly.share(while_on)});
  }
};

}  // namespace

Effect const& coolant_flow_effect() {
  static Effect const effect =
      make_effect<CoolantFlow>({"coolant_flow",
                                "coolant that enters at a known temperature and leaves after taking up heat",
                                "q = 2 ṁc (T_in − T_m): T_m is the mean of inlet and outlet, right for NTU < 1",
                                "boundary",
                                "jacket, cooled stator",
                                "pulls its neighbours to the inlet's temperature within minutes; follows the pump",
                                "physics.md 2.7, §7 nos. 3, 5",
                                {3, 10},
                                {"channel_film", "jacket"},
                                "temperatures of supply and return; a step of the flow"});
  return effect;
}

}  // namespace thermotwin::twin
