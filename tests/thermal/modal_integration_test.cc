#include "thermal/modal_integration.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/thermal/random_network.h"
#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

std::vector<std::vector<double>> in_modes(Network const& network, Course const& course,
                                          std::vector<double> const& start, std::vector<double> const& times,
                                          IntegrationOptions const& options) {
  std::vector<std::vector<double>> seen;
  integrate_in_modes(network, course, start, times, options, [&](Sample const& sample) {
    seen.emplace_back(sample.temperatures.begin(), sample.temperatures.end());
  });
  return seen;
}

/// Two lumps, a joint, a film of constant coefficient, a constant heat: nothing is left that a step could err by.
TEST(ModalIntegration, LinearNetworksAreExactHoweverLooseTheTolerance) {
  NetworkBuilder builder;
  int const part = builder.part("p");
  Port const head = builder.add_body("head", {4000.0}), column = builder.add_body("column", {4000.0});
  Port const air = builder.add_boundary({"air", T0, {}});
  builder.connect(part, head, column, 6.0);
  builder.connect(part, head, air, 2.0);
  builder.connect(part, column, air, 2.0);
  Network const network = builder.build();
  // Sum and difference of the two rises decay with 2 W/K and 14 W/K over 4000 J/K.
  std::vector<double> const start{T0 + 10.0, T0 + 4.0}, times{0.0, 7.0, 300.0, 2000.0, 9000.0};
  std::size_t row = 0;
  for (auto const& temperatures : in_modes(network, FunctionCourse(), start, times, tight(1e-2))) {
    double const t = times[row++];
    double const sum = 14.0 * std::exp(-2.0 / 4000.0 * t), difference = 6.0 * std::exp(-14.0 / 4000.0 * t);
    EXPECT_NEAR(temperatures[0] - T0, 0.5 * (sum + difference), 1e-10) << t;
    EXPECT_NEAR(temperatures[1] - T0, 0.5 * (sum - difference), 1e-10) << t;
  }
}

/// A lump of 20 min in air that swings within 20 min: T = a (sin ωt − ωτ cos ωt + ωτ e^{−t/τ})/(1 + ω²τ²). What depends
/// on time alone cancels in the estimate of a step's error.
TEST(ModalIntegration, FollowsAirThatSwings) {
  constexpr double period = 1200.0, tau = 1200.0, omega = 2.0 * std::numbers::pi / period, x = omega * tau;
  NetworkBuilder builder;
  int const part = builder.part("p");
  Port const lump = builder.add_body("lump", {2.0 * tau});
  Port const air = builder.add_boundary({"air", T0, {{builder.channel("warmer"), 1.0}}});
  builder.connect(part, lump, air, 2.0);
  Network const network = builder.build();
  FunctionCourse const course(
      {"warmer"}, [](double t, std::span<double> values) { values[0] = std::sin(omega * t); }, {}, {}, period / 12.0);
  std::vector<double> times;
  for (int i = 0; i <= 96; ++i) times.push_back(300.0 * i);
  std::size_t row = 0;
  for (auto const& temperatures : in_modes(network, course, {T0}, times, tight(1e-5))) {
    double const t = times[row++];
    double const due = (std::sin(omega * t) - x * std::cos(omega * t) + x * std::exp(-t / tau)) / (1.0 + x * x);
    EXPECT_NEAR(temperatures[0] - T0, due, 1e-4) << t;
  }
}

/// Films, radiation, friction, evaporation, flow, averages, capacities that depend on temperature.
TEST(ModalIntegration, AgreesWithBdfToItsTolerance) {
  std::vector<double> const times{0.0, 10.0, 300.0, 600.0, 1000.0, 1200.0, 3000.0};
  int compared = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    auto const random = random_network(seed);
    try {
      check_modes(random.network);
    } catch (InputError const&) {
      continue;  // a part moves
    }
    std::vector<std::vector<double>> exact;
    integrate(random.network, random_course(), random.start, times, tight(1e-10), [&](Sample const& sample) {
      exact.emplace_back(sample.temperatures.begin(), sample.temperatures.end());
    });
    for (double const tolerance : {1e-4, 1e-5}) {
      auto const seen = in_modes(random.network, random_course(), random.start, times, tight(tolerance));
      ASSERT_EQ(seen.size(), exact.size());
      for (std::size_t row = 0; row < seen.size(); ++row) {
        ASSERT_EQ(seen[row].size(), exact[row].size());
        for (std::size_t i = 0; i < seen[row].size(); ++i)
          ASSERT_NEAR(seen[row][i], exact[row][i], 30.0 * tight(tolerance).tolerance())
              << "seed " << seed << ", t = " << times[row] << ", tolerance " << tolerance;
      }
    }
    ++compared;
  }
  EXPECT_GT(compared, 70);
}

TEST(ModalIntegration, GivesUpWhereItTakesTooManySteps) {
  NetworkBuilder builder;
  int const part = builder.part("p");
  builder.connect(part, builder.add_body("lump", {4000.0}), builder.add_boundary({"air", T0, {}}), 2.0);
  Network const network = builder.build();
  std::vector<double> const start{T0 + 10.0}, times{0.0, 9000.0};
  auto const within = [&](long steps) {
    auto options = tight(1e-5);
    options.most_steps = steps;
    return integrate_in_modes(network, FunctionCourse(), start, times, options, [](Sample const&) {});
  };
  auto const summary = within(1'000'000);
  long const needed = summary.steps + summary.error_test_failures;
  EXPECT_EQ(within(needed).steps, summary.steps);
  EXPECT_THROW((void)within(needed - 1), IntegrationError);
}

TEST(ModalIntegration, RefusesWhatHasNoConstantModes) {
  EXPECT_THROW(check_modes(with_thermostat()), InputError);

  auto const chain = [](int nodes) {
    NetworkBuilder builder;
    int const part = builder.part("p");
    Port last = builder.add_boundary({"air", T0, {}});
    for (int i = 0; i < nodes; ++i) {
      Port const next = builder.add_body("body " + std::to_string(i), {100.0});
      builder.connect(part, last, next, 1.0);
      last = next;
    }
    return builder.build();
  };
  EXPECT_NO_THROW(check_modes(chain(400)));
  auto const large = chain(401);
  EXPECT_THROW(check_modes(large), InputError);
}

}  // namespace
}  // namespace thermotwin::thermal
