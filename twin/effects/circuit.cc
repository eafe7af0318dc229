#include "thermal/error.h"
#include "thermal/fluid.h"
#include "thermal/laws.h"
#include "thermal/physical_constant.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct Circuit {
  std::string name, fluid = "water", while_on = "machine.on";
  std::vector<std::string> through;
  double flow = required;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Circuit::name, "unique among these");
    f("through", &Circuit::through,
      "bodies and channels of the fluid in the order of the flow; from the last it returns to the first");
    f("flow", &Circuit::flow, dimension::volume_flow, "of the pump", Range{1e-6, 5e-3});
    f("fluid", &Circuit::fluid, "known fluid: water, emulsion, water-glycol, oil VG10 and so on");
    f("while_on", &Circuit::while_on, "input channel between 0 and 1 that runs the pump");
  }

  void add_to(Assembly& assembly) const {
    if (through.size() < 2) throw thermal::InputError("circuit '" + name + "' needs two bodies or more");
    auto const properties = thermal::properties(thermal::fluid(fluid), thermal::reference_temperature);
    double const capacity_rate = flow * properties.density * properties.specific_heat;
    auto const stations = ports(assembly);
    for (std::size_t i = 0; i < stations.size(); ++i)
      assembly.network().add<thermal::Advection>(assembly.part(), {stations[i], stations[(i + 1) % stations.size()]},
                                                 {capacity_rate}, {assembly.share(while_on)});
  }

 private:
  /// A channel is passed cell by cell, any other body at its mean.
  [[nodiscard]] std::vector<thermal::Port> ports(Assembly& assembly) const {
    std::vector<thermal::Port> result;
    for (auto const& text : through) {
      Place const place = assembly.place(text);
      if (place.body->faces.contains("wall"))
        for (int cell = 0; cell < place.body->nodes(); ++cell) result.push_back(assembly.node(place, cell));
      else
        result.push_back(assembly.port(place));
    }
    return result;
  }
};

}  // namespace

Effect const& circuit_effect() {
  static Effect const effect = make_effect<Circuit>(
      {"circuit", "coolant or oil that is pumped round: tank, hose, jacket and back", "q = ṁ c (T_previous − T)",
       "link", "bodies of fluid: tank, jacket, a [[channel]] as hose, which delays by V/V̇",
       "ties the bodies together within minutes and makes all follow the tank, τ 2…10 h; follows the pump",
       "physics.md 2.12 (2.11), §7 no. 10"});
  return effect;
}

}  // namespace thermotwin::twin
