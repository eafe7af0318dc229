#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

struct DisplacementStep {
  std::string name, displacement, follows = "spindle.running";
  double step = required;  ///< [m]

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &DisplacementStep::name, "unique among these");
    f.name("displacement", &DisplacementStep::displacement, "channel that jumps");
    f("step", &DisplacementStep::step, dimension::length, "per unit of the input", Range{-10e-6, 10e-6});
    f("follows", &DisplacementStep::follows,
      "input channel that counts or switches: spindle.running, servo.on, tool.changes");
  }

  void add_to(Assembly& assembly) const { assembly.displace(InputTerm{displacement, follows, step, 1.0}); }
};

}  // namespace

Effect const& displacement_step_effect() {
  static Effect const effect = make_effect<DisplacementStep>(
      {"displacement_step",
       "the tool jumps at events: tool change, clamping, slip of a joint",
       "ΔE = s (u − u(0))",
       "deformation",
       "a displacement channel",
       "steps at events, constant between them; no temperature answers",
       "physics.md §7 nos. 31, 38",
       {31, 38},
       {"probe_drift", "centrifugal_growth"},
       "log of events; the event again and again without a run; steps of the speed, which a jump does not follow"},
      {{.amplitude = "step",
        .largest = 10e-6,
        .hidden_up_to = 5e-6,
        .either_sign = true,
        .sites = {{"displacement", "displacement"}},
        .shapes = {{{"follows", "spindle.running"}}, {{"follows", "servo.on"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
