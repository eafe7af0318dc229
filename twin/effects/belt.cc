#include "thermal/drive_loss.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

/// c = {P_b, exponent, rated speed, share}, u = {ω}.
struct BeltHeat {
  static constexpr std::string_view name = "belt loss";
  static constexpr int ports = 1, coefficients = 4, inputs = 1;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const*, S const* c, double const* u, S* q) {
    if (u[0] == 0.0) return;
    using std::exp;
    using std::log;
    q[0] = c[3] * c[0] * exp(c[1] * log(S(u[0] / c[2])));
  }
};

struct Belt {
  std::string name, pulley, motor;
  double loss = required;
  double exponent = 1.0;
  double pulley_share = 0.35, motor_share = 0.325;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Belt::name, "unique among the belts");
    f.name("pulley", &Belt::pulley, "place on the spindle that receives its share");
    f.name("motor", &Belt::motor, "place on the motor's side");
    f("loss", &Belt::loss, dimension::power, "without load at the spindle's maximum speed", Range{5, 80});
    f("exponent", &Belt::exponent, dimension::dimensionless, "of the speed", Range{1.0, 1.5});
    f("pulley_share", &Belt::pulley_share, dimension::dimensionless, "to the spindle", share_range);
    f("motor_share", &Belt::motor_share, dimension::dimensionless, "to the motor; the rest goes to the air",
      share_range);
  }

  void check(Value const& table) const {
    refuse_more_than_whole(table, {{"pulley_share", pulley_share}, {"motor_share", motor_share}});
  }

  void add_to(Assembly& assembly) const {
    auto const speed = assembly.channel("spindle.speed");
    for (auto const& [place, share] : {std::pair(pulley, pulley_share), std::pair(motor, motor_share)})
      assembly.network().add<BeltHeat>(assembly.part(), {assembly.port(place)},
                                       {loss, exponent, assembly.maximum_spindle_speed(), share}, {speed});
  }
};

}  // namespace

Effect const& belt_effect() {
  static Effect const effect = make_effect<Belt>(
      {"belt",
       "no-load loss of a belt drive",
       "P = P_b (ω/ω_max)^m,  m = 1…1.5",
       "source",
       "pulley end of the shaft, motor",
       "power of speed 1 to 1.5; first seen at the pulley end of the shaft and the rear bearing; ends at stop",
       "physics.md 1.10, §7 no. 21",
       {21},
       {"seal", "bearing", "motor_loss"},
       "motor without belt; infrared on the pulley"},
      {{.amplitude = "loss",
        .largest = 80.0,
        .needs_spindle = true,
        .sites = {{"pulley", "shaft"}, {"motor", "motor"}},
        .shapes = {{{"exponent", "1"}}, {{"exponent", "1.5"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
