#include "thermal/seal.h"

#include "thermal/error.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

/// Q = M ω. Ports: shaft, housing. c = {M, shaft's share}, u = {ω}.
struct SealHeat {
  static constexpr std::string_view name = "friction of a contact seal";
  static constexpr int ports = 2, coefficients = 2, inputs = 1;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const*, S const* c, double const* u, S* q) {
    S const heat = c[0] * u[0];
    q[0] = c[1] * heat;
    q[1] = (1.0 - c[1]) * heat;
  }
};

std::vector<std::string> seal_kinds() {
  auto kinds = thermal::bearing_seal_types();
  kinds.insert(kinds.begin(), "lip");
  return kinds;
}

struct Seal {
  std::string name, shaft, housing, kind = "lip";
  std::optional<double> torque, diameter;
  double friction = 0.3, line_force = 100.0;
  double outer_diameter = 0.1;
  double shaft_share = 0.5;
  std::string speed = "spindle.speed";

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Seal::name, "unique among the seals");
    f.name("shaft", &Seal::shaft, "place on the shaft");
    f.name("housing", &Seal::housing, "place on the housing");
    f.choice("kind", &Seal::kind, seal_kinds(), "radial lip seal, or the two contact seals of such a bearing");
    f("torque", &Seal::torque, dimension::torque, "known torque, instead of what follows from the kind",
      Range{0.02, 0.5});
    f("diameter", &Seal::diameter, dimension::length, "on which the seal runs", Range{0.005, 0.5});
    f("friction", &Seal::friction, dimension::dimensionless, "coefficient, of a lip seal", Range{0.2, 0.4});
    f("line_force", &Seal::line_force, dimension::stiffness, "force of a lip per length", Range{50, 200});
    f("outer_diameter", &Seal::outer_diameter, dimension::length,
      "of a deep groove ball bearing: its table changes at 62, 80 and 100 mm", Range{0.01, 1.0});
    f("shaft_share", &Seal::shaft_share, dimension::dimensionless, "of the heat, into the shaft", share_range);
    f("speed", &Seal::speed, "input channel with the speed");
  }

  void check(Value const& table) const { refuse_both(table, "diameter", "torque"); }

  void add_to(Assembly& assembly) const {
    assembly.network().add<SealHeat>(assembly.part(), {assembly.port(shaft), assembly.port(housing)},
                                     {torque ? *torque : torque_of_kind(), shaft_share}, {assembly.channel(speed)});
  }

 private:
  [[nodiscard]] double torque_of_kind() const {
    if (!diameter) throw thermal::InputError("seal '" + name + "' needs a torque or a diameter");
    if (kind == "lip") return thermal::lip_seal_torque<double>(friction, line_force, *diameter);
    return thermal::bearing_seal(kind, outer_diameter).torque(*diameter);
  }
};

}  // namespace

Effect const& seal_effect() {
  static Effect const effect = make_effect<Seal>(
      {"seal",
       "friction of a seal that touches the shaft",
       "Q = M ω;  lip: M = ½π μ p d²;  contact seals of a bearing: M[N mm] = K₁ d^β + K₂, d in mm",
       "source",
       "nose, shaft and housing at a bearing of the spindle or of a screw",
       "power of speed 1 exactly, whatever the temperature; shaft and housing together; seen at 200…1000 rpm, where "
       "bearing friction has vanished; ends at stop",
       "physics.md 1.6, §7 no. 8; SKF 2006",
       {8},
       {"belt", "bearing"},
       "200…1000 rpm, where bearing friction has vanished; torque at speed 0 by extrapolation"},
      {{.amplitude = "torque", .largest = 0.5, .sites = {{"shaft", "bearing", "housing"}}},
       {.amplitude = "torque", .largest = 0.5, .sites = {{"shaft", "support", "housing"}}}});
  return effect;
}

}  // namespace thermotwin::twin
