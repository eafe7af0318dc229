#include "thermal/lanes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "thermal/law.h"
#include "thermal/rotating_surface.h"

namespace thermotwin::thermal {
namespace {

/// A rotating cylinder in air. c = {A, D}, u = {ω}.
template <bool Wide>
struct Cylinder {
  static constexpr std::string_view name = "cylinder";
  static constexpr int ports = 2, coefficients = 2, inputs = 1;
  static constexpr bool conservative = true, in_lanes = Wide;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    q[0] = c[0] * rotating_cylinder_film<S>(T[0], T[1], c[1], S(u[0])) * (T[1] - T[0]);
    q[1] = -q[0];
  }
};

/// Elements by fours, in runs of the same input that end anywhere, flow as they do one by one.
TEST(Lanes, OfALawGiveWhatItsElementsGiveOneByOne) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> temperature(285.0, 330.0), area(0.001, 0.1), diameter(0.02, 0.2);
  std::vector<double> const speeds = {0.0, 20.0, 600.0};
  for (int count = 0; count <= 23; ++count) {
    std::vector<double> T, c;
    std::vector<int> ports, inputs;
    for (int e = 0; e < count; ++e) {
      T.push_back(temperature(random));
      ports.insert(ports.end(), {e, count});
      c.insert(c.end(), {area(random), diameter(random)});
      inputs.push_back(int(random() % 7 == 0 ? random() % 3 : e > 0 ? std::size_t(inputs.back()) : 1));
    }
    T.push_back(295.0);
    ElementBatch const batch{count, ports, c, inputs};
    std::vector<double> wide(2 * std::size_t(count)), narrow(wide), heat(T.size()), expected(T.size());
    LawOf<Cylinder<true>>().heat_flows(batch, T.data(), speeds.data(), wide.data());
    LawOf<Cylinder<false>>().heat_flows(batch, T.data(), speeds.data(), narrow.data());
    for (std::size_t i = 0; i < wide.size(); ++i) EXPECT_NEAR(wide[i], narrow[i], 1e-14 * std::abs(narrow[i]));
    LawOf<Cylinder<true>>().add_heat_flows(batch, T.data(), speeds.data(), heat.data());
    for (std::size_t i = 0; i < wide.size(); ++i) expected[std::size_t(ports[i])] += wide[i];
    EXPECT_EQ(heat, expected) << "the same bytes, whoever asks";
  }
}

#ifdef THERMOTWIN_LANES

double worst_of(Lanes (*lanes)(Lanes const&), double (*one)(double), double from, double to) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> exponent(std::log(from), std::log(to));
  double worst = 0.0;
  for (int i = 0; i < 20000; ++i) {
    Lanes x;
    for (int k = 0; k < Lanes::count; ++k) x.value[k] = std::exp(exponent(random));
    Lanes const y = lanes(x);
    for (int k = 0; k < Lanes::count; ++k) worst = std::max(worst, std::abs(y.value[k] / one(x.value[k]) - 1.0));
  }
  return worst;
}

TEST(Lanes, RootsAndPowersAreThoseOfSingleNumbers) {
  constexpr double few_units = 2e-15;
  EXPECT_LT(worst_of([](Lanes const& x) { return sqrt(x); }, [](double x) { return std::sqrt(x); }, 1e-12, 1e12),
            1e-15);
  EXPECT_LT(worst_of([](Lanes const& x) { return cbrt(x); }, [](double x) { return std::cbrt(x); }, 1e-12, 1e12),
            few_units);
  EXPECT_LT(worst_of([](Lanes const& x) { return tanh(x); }, [](double x) { return std::tanh(x); }, 1e-6, 1e2),
            few_units);
  EXPECT_LT(worst_of([](Lanes const& x) { return pow(x, 1.0 / 6.0); }, [](double x) { return std::pow(x, 1.0 / 6.0); },
                     1e-12, 1e12),
            few_units);
  EXPECT_LT(worst_of([](Lanes const& x) { return pow(x, 2.0 / 3.0); }, [](double x) { return std::pow(x, 2.0 / 3.0); },
                     1e-12, 1e12),
            few_units);
  EXPECT_LT(
      worst_of([](Lanes const& x) { return pow(x, 0.8); }, [](double x) { return std::pow(x, 0.8); }, 1e-12, 1e12),
      few_units);
}

#endif

}  // namespace
}  // namespace thermotwin::thermal
