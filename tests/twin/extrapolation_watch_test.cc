#include "twin/extrapolation_watch.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "tests/twin/effect_bench.h"
#include "thermal/evaluation.h"
#include "thermal/fluid.h"
#include "thermal/rotating_surface.h"

namespace thermotwin::twin {
namespace {

/// The bench with an effect at one instant.
struct Instant {
  Machine machine;
  std::vector<double> temperatures, input;

  explicit Instant(Snippet const& effect, Inputs const& replaced = {}, Changes const& changes = {})
      : machine(Machine::build(bench(effect, changes))) {
    auto const& network = machine.network();
    auto const nodes = uniform_temperatures(machine, 313.15);
    std::vector<double> given(std::size_t(network.channels()), 1.0), state(nodes.size());
    bench_course(machine, replaced).evaluate(0.0, {given.data(), std::size_t(network.external_channels())});
    for (std::size_t i = 0; i < state.size(); ++i) state[i] = network.state_of_temperature(int(i), nodes[i]);
    thermal::Evaluation evaluation(network);
    auto const seen = evaluation.temperatures(state.data(), given.data());
    temperatures.assign(seen.begin(), seen.end());
    input = evaluation.inputs();
  }

  [[nodiscard]] std::vector<Extrapolated> seen_for(double seconds, double moved) const {
    ExtrapolationWatch watch(machine.network(), 3600.0);
    watch.look(0.0, temperatures.data(), input.data());
    watch.look(seconds, temperatures.data(), input.data());
    return watch.found(moved);
  }
};

Inputs speed(double radian_per_second) { return {{"spindle.speed", radian_per_second}, {"ambient.gradient", 0.0}}; }

/// Re = ω D²/(2 ν) at the mean of 40 °C and the room's 20.35 °C; Becker's Nu is used up to 4.3e5.
TEST(ExtrapolationWatch, TellsOfACylinderThatTurnsTooFast) {
  auto const& film = snippet("film", "rotating_cylinder");
  Changes const large{{"diameter", "400 mm"}};
  double const viscosity =
      thermal::properties(thermal::Air{}, 0.5 * (313.15 + bench_input("ambient.floor_temperature")))
          .kinematic_viscosity;
  double const fastest = thermal::becker_reynolds.upper * 2.0 * viscosity / (0.4 * 0.4);

  EXPECT_TRUE(Instant(film, speed(0.99 * fastest), large).seen_for(60.0, 1.0).empty());
  EXPECT_TRUE(Instant(film, speed(0.0), large).seen_for(60.0, 1.0).empty());
  Instant const beyond(film, speed(1.5 * fastest), large);
  double const watts = [&] {
    double sum = 0.0;
    for (double const heat :
         heat_of(film, beyond.machine, uniform_temperatures(beyond.machine, 313.15), speed(1.5 * fastest)))
      sum += heat;
    return std::abs(sum);
  }();
  auto const found = beyond.seen_for(60.0, 240.0 * watts);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].part, "film.rotating_cylinder");
  EXPECT_EQ(found[0].range, &thermal::becker_reynolds);
  EXPECT_NEAR(found[0].number, 1.5 * thermal::becker_reynolds.upper, 1.0);
  EXPECT_NEAR(found[0].share, 0.25, 1e-9);
  EXPECT_EQ(text_of(found[0]),
            "film.rotating_cylinder: Re of a rotating cylinder after Becker is 6.45e+05, the law is stated for 0 to "
            "4.3e+05; 25 % of all heat moves so");
  EXPECT_TRUE(beyond.seen_for(60.0, 60.0 * watts * 101.0).empty());  // below a hundredth
}

TEST(ExtrapolationWatch, LooksEveryFiveMinutesAndAtTheEnd) {
  Instant const at(snippet("film", "rotating_cylinder"), speed(100.0));
  ExtrapolationWatch watch(at.machine.network(), 1000.0);
  std::vector<double> looked;
  for (double t = 0.0; t <= 1000.0; t += 20.0) {
    if (!watch.is_due(t)) continue;
    watch.look(t, at.temperatures.data(), at.input.data());
    looked.push_back(t);
  }
  EXPECT_EQ(looked, (std::vector{0.0, 300.0, 600.0, 900.0, 1000.0}));
}

/// The evaluation that watches is that of the run.
TEST(ExtrapolationWatch, MovesTheSameHeatByEveryLaw) {
  for (auto const& effect : snippets()) {
    Instant const at(effect);
    std::vector<thermal::Extrapolation> beyond;
    for (auto const& group : at.machine.network().groups()) {
      auto const batch = group.batch();
      auto const ports = std::size_t(group.law->ports());
      std::vector<double> flows(group.ports.size());
      group.law->heat_flows(batch, at.temperatures.data(), at.input.data(), flows.data());
      for (int e = 0; e < batch.count; ++e) {
        double largest = 0.0;
        for (std::size_t p = 0; p < ports; ++p)
          largest = std::max(largest, std::abs(flows[std::size_t(e) * ports + p]));
        EXPECT_NEAR(group.law->watch(batch, e, at.temperatures.data(), at.input.data(), beyond), largest,
                    1e-12 + 1e-9 * largest)
            << effect.part() << ", " << group.law->name();
      }
    }
  }
  EXPECT_EQ(thermal::extrapolations, nullptr);
}

}  // namespace
}  // namespace thermotwin::twin
