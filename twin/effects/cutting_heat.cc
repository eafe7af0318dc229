#include "thermal/drive_loss.h"
#include "thermal/error.h"
#include "thermal/laws.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

struct CuttingHeat {
  std::string name, tool, workpiece, chips_on, while_cutting = "spindle.running";
  std::optional<double> power, specific_force, removal_rate;
  double tool_share = 0.06, workpiece_share = 0.16, chips_share = 0.1;

  template <class Fields>
  static void fields(Fields& f) {
    using P = CuttingHeat;
    f.name("name", &P::name, "unique among these");
    f("tool", &P::tool, "place that takes the tool's share: spindle nose");
    f("workpiece", &P::workpiece, "place that takes the workpiece's share: table");
    f("chips_on", &P::chips_on, "place on which hot chips lie: table, bed, coolant");
    f("power", &P::power, dimension::power, "of cutting", Range{50, 20000});
    f("specific_force", &P::specific_force, dimension::pressure, "k_c, instead of the power: steel 2 GPa",
      Range{0.3e9, 6e9});
    f("removal_rate", &P::removal_rate, dimension::volume_flow, "of material, with the specific force",
      Range{1e-8, 2e-5});
    f("tool_share", &P::tool_share, dimension::dimensionless, "of the power, into the tool",
      Range{0.03, 0.1}.up_to(1.0));
    f("workpiece_share", &P::workpiece_share, dimension::dimensionless, "into the workpiece",
      Range{0.1, 0.25}.up_to(1.0));
    f("chips_share", &P::chips_share, dimension::dimensionless,
      "that chips leave where they lie; the rest goes with them", Range{0.05, 0.3}.up_to(1.0));
    f("while_cutting", &P::while_cutting, "input channel between 0 and 1 that scales it");
  }

  void check(Value const& table) const {
    for (auto const* key : {"specific_force", "removal_rate"}) refuse_both(table, key, "power");
    std::vector<std::pair<std::string, double>> taken;
    if (!tool.empty()) taken.emplace_back("tool_share", tool_share);
    if (!workpiece.empty()) taken.emplace_back("workpiece_share", workpiece_share);
    if (!chips_on.empty()) taken.emplace_back("chips_share", chips_share);
    refuse_more_than_whole(table, taken);
  }

  void add_to(Assembly& assembly) const {
    if (tool.empty() && workpiece.empty() && chips_on.empty())
      throw thermal::InputError("cutting_heat '" + name + "' needs a place: tool, workpiece or chips_on");
    for (auto const& [place, share] :
         {std::pair(tool, tool_share), std::pair(workpiece, workpiece_share), std::pair(chips_on, chips_share)})
      if (!place.empty())
        assembly.network().add<thermal::SwitchedHeat>(assembly.part(), {assembly.port(place)},
                                                      {share * cutting_power()}, {assembly.channel(while_cutting)});
  }

 private:
  [[nodiscard]] double cutting_power() const {
    if (power) return *power;
    if (specific_force && removal_rate) return thermal::cutting_power<double>(*specific_force, *removal_rate);
    throw thermal::InputError("cutting_heat '" + name + "' needs a power, or specific_force and removal_rate");
  }
};

}  // namespace

Effect const& cutting_heat_effect() {
  static Effect const effect = make_effect<CuttingHeat>(
      {"cutting_heat",
       "heat of cutting in tool and workpiece, and of hot chips where they lie",
       "q = β P_c,  P_c = k_c MRR;  tool 0.03…0.1, workpiece 0.1…0.25, chips on the table 0.05…0.3",
       "source",
       "spindle nose, table, bed, coolant",
       "only while cutting; absent in an air cut",
       "physics.md 1.11, §7 no. 26",
       {26},
       {"heat", "motor_load"},
       "the same programme as an air cut; with the place and the flag of a heat they are the same"});
  return effect;
}

}  // namespace thermotwin::twin
