#include <cmath>

#include "thermal/error.h"
#include "twin/assembly.h"
#include "twin/effect.h"

namespace thermotwin::twin {
namespace {

/// Q = P (ω/ω_r)^{5/3} e^{−t/τ − N/N_c}. Ports: inner, outer ring. c = {P, ω_r, 1/τ, 1/N_c, inner share},
/// u = {ω, t since start, N}.
struct RunInHeat {
  static constexpr std::string_view name = "churning of fresh grease";
  static constexpr int ports = 2, coefficients = 5, inputs = 3;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const*, S const* c, double const* u, S* q) {
    if (u[0] == 0.0) return;
    using std::exp;
    using std::pow;
    S const heat = c[0] * pow(S(u[0] / c[1]), 5.0 / 3.0) * exp(S(-u[1] * c[2] - u[2] * c[3]));
    q[0] = c[4] * heat;
    q[1] = (1.0 - c[4]) * heat;
  }
};

struct GreaseRunIn {
  std::string name, inner, outer;
  double power = required;
  std::optional<double> decay_time, decay_revolutions, rated_speed;
  double inner_share = 0.5;

  template <class Fields>
  static void fields(Fields& f) {
    using P = GreaseRunIn;
    f.name("name", &P::name, "unique among these");
    f.name("inner", &P::inner, "place of the inner rings, on the shaft");
    f.name("outer", &P::outer, "place of the outer rings");
    f("power", &P::power, dimension::power, "extra heat at rated speed at first: 0.3 to 3 times the bearing's own",
      Range{5, 500});
    f("decay_time", &P::decay_time, dimension::time, "since the spindle last started", Range{1800, 18000}.above_zero());
    f("decay_revolutions", &P::decay_revolutions, dimension::dimensionless,
      "instead or besides: turns after which fresh grease has run in", Range{1e4, 1e8}.above_zero());
    f("rated_speed", &P::rated_speed, dimension::angular_speed, "default: the spindle's maximum", plausible_speed);
    f("inner_share", &P::inner_share, dimension::dimensionless, "of the heat, into the inner rings", share_range);
  }

  void add_to(Assembly& assembly) const {
    if (!decay_time && !decay_revolutions)
      throw thermal::InputError("grease_run_in '" + name + "' needs a decay_time or decay_revolutions");
    auto const rate = [](std::optional<double> const& decay) { return decay ? 1.0 / *decay : 0.0; };
    assembly.network().add<RunInHeat>(
        assembly.part(), {assembly.port(inner), assembly.port(outer)},
        {power, assembly.rated_speed(rated_speed), rate(decay_time), rate(decay_revolutions), inner_share},
        {assembly.channel("spindle.speed"), assembly.channel("spindle.time_running"),
         assembly.channel("spindle.revolutions")});
  }
};

}  // namespace

Effect const& grease_run_in_effect() {
  static Effect const effect = make_effect<GreaseRunIn>(
      {"grease_run_in",
       "heat of grease that is churned until it has left the track",
       "Q = P (ω/ω_r)^(5/3) e^(−t_on/τ),  slow form e^(−N/N_c) with the revolutions N",
       "source",
       "both rings of a bearing",
       "peak in the first 0.5…3 h, then decay at constant speed; smaller the next day where revolutions count",
       "physics.md §7 no. 14",
       {14},
       {"preload", "bearing"},
       "the same run on the next day: only fresh grease has changed"},
      {{.amplitude = "power",
        .largest = 200.0,
        .sites = {{"inner", "bearing", "outer"}},
        .shapes = {{{"decay_time", "0.5 h"}}, {{"decay_time", "1.5 h"}}, {{"decay_time", "5 h"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
