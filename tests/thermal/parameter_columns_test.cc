#include "thermal/parameter_columns.h"

#include <gtest/gtest.h>

#include "tests/thermal/random_network.h"
#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

constexpr unsigned seeds = 200;

/// A random network in the midst of its course.
struct Instant {
  explicit Instant(unsigned seed) : random(random_network(seed)), draw(seed + 1000) {
    auto const course = random_course();
    std::vector<double> all(4);
    course.evaluate(800.0, all);
    for (int i = 0; i < network.given_channels(); ++i)
      for (std::size_t k = 0; k < all.size(); ++k)
        if (course.channels()[k].name == network.channel_names()[std::size_t(i)]) input.push_back(all[k]);
    for (int i = 0; i < network.nodes(); ++i)
      state.push_back(network.state_of_temperature(i, random.start[std::size_t(i)]));
  }
  double any() { return 2.0 * (draw() / 4294967296.0) - 1.0; }

  /// A parameter that nothing depends on.
  [[nodiscard]] NetworkDerivative none() const {
    NetworkDerivative d;
    d.capacity.resize(network.capacity().size());
    d.capacity_slope.resize(network.capacity().size());
    d.coefficients.resize(network.groups().size());
    d.boundary_offset.resize(network.boundaries().size());
    for (auto const& boundary : network.boundaries()) d.boundary_weights.emplace_back(boundary.terms.size());
    for (auto const& average : network.averages()) d.average_weights.emplace_back(average.weights.size());
    return d;
  }
  NetworkDerivative of_one_capacity() {
    auto d = none();
    std::size_t const i = draw() % d.capacity.size();
    d.capacity[i] = any() * network.capacity()[i];
    return d;
  }
  NetworkDerivative of_one_element() {
    auto d = none();
    std::size_t const g = draw() % d.coefficients.size();
    auto const& group = network.groups()[g];
    d.coefficients[g].resize(group.coefficients.size());
    auto const count = std::size_t(group.law->coefficients());
    std::size_t const e = draw() % std::size_t(group.count());
    for (std::size_t i = e * count; i < (e + 1) * count; ++i) d.coefficients[g][i] = any() * group.coefficients[i];
    return d;
  }
  NetworkDerivative of_all_coefficients() {
    auto d = none();
    for (std::size_t g = 0; g < d.coefficients.size(); ++g)
      for (double const c : network.groups()[g].coefficients) d.coefficients[g].push_back(any() * c);
    return d;
  }
  NetworkDerivative of_boundaries() {
    auto d = none();
    for (double& offset : d.boundary_offset) offset = any();
    for (auto& weights : d.boundary_weights)
      for (double& weight : weights) weight = any();
    return d;
  }
  NetworkDerivative of_everything() {
    auto d = of_all_coefficients();
    auto const air = of_boundaries();
    d.boundary_offset = air.boundary_offset;
    d.boundary_weights = air.boundary_weights;
    for (std::size_t i = 0; i < d.capacity.size(); ++i) d.capacity[i] = any() * network.capacity()[i];
    return d;
  }

  RandomNetwork random;
  Network const& network = random.network;
  std::mt19937 draw;
  std::vector<double> input, state;
};

Eigen::MatrixXd columns(Instant const& at, std::vector<NetworkDerivative> const& parameters) {
  std::vector<NetworkDerivative const*> pointers;
  for (auto const& parameter : parameters) pointers.push_back(&parameter);
  ParameterColumns const all(at.network, pointers);
  Evaluation evaluation(at.network);
  NodeByParameter forcing;
  all.evaluate(evaluation, at.state.data(), at.input.data(), forcing);
  return forcing;
}

/// (∂f/∂y) dy/dθ + ∂f/∂θ with dy/dθ = 0.
Eigen::MatrixXd one_by_one(Instant const& at, std::vector<NetworkDerivative> const& parameters) {
  Evaluation evaluation(at.network);
  std::vector<double> const still(at.state.size());
  Eigen::MatrixXd rates(Eigen::Index(at.state.size()), Eigen::Index(parameters.size()));
  for (std::size_t k = 0; k < parameters.size(); ++k)
    evaluation.rate_derivative(at.state.data(), still.data(), parameters[k], at.input.data(),
                               rates.col(Eigen::Index(k)).data());
  return rates;
}

using Draw = NetworkDerivative (Instant::*)();

class ParameterColumnsOf : public testing::TestWithParam<std::pair<char const*, Draw>> {};

/// Three parameters of a kind at once, in random networks.
TEST_P(ParameterColumnsOf, AreTheRateDerivativesAtAStateThatStandsStill) {
  double largest = 0.0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    Instant at(seed);
    std::vector<NetworkDerivative> parameters;
    for (int k = 0; k < 3; ++k) parameters.push_back((at.*GetParam().second)());
    auto const expected = one_by_one(at, parameters), forcing = columns(at, parameters);
    ASSERT_EQ(forcing.rows(), expected.rows());
    for (Eigen::Index k = 0; k < 3; ++k) {
      double const scale = expected.col(k).cwiseAbs().maxCoeff();
      ASSERT_LE((forcing.col(k) - expected.col(k)).cwiseAbs().maxCoeff(), 1e-10 * scale) << "seed " << seed;
      largest = std::max(largest, scale);
    }
  }
  EXPECT_GT(largest, 0.0);
}

INSTANTIATE_TEST_SUITE_P(AnyParameter, ParameterColumnsOf,
                         testing::Values(std::pair{"capacity", &Instant::of_one_capacity},
                                         std::pair{"element", &Instant::of_one_element},
                                         std::pair{"coefficients", &Instant::of_all_coefficients},
                                         std::pair{"boundaries", &Instant::of_boundaries},
                                         std::pair{"everything", &Instant::of_everything}),
                         [](auto const& info) { return std::string(info.param.first); });

/// The rate itself, differenced by the scale of all conductances.
TEST(ParameterColumns, AgreeWithDifferencesOfTheRate) {
  for (unsigned seed = 0; seed < seeds; ++seed) {
    double const step = 1e-5;
    auto const plus = random_network(seed, {.scale = 1.0 + step}), minus = random_network(seed, {.scale = 1.0 - step});
    Instant const at(seed);
    Eigen::VectorXd up(at.network.nodes()), down(at.network.nodes());
    Evaluation(plus.network).rate(at.state.data(), at.input.data(), up.data());
    Evaluation(minus.network).rate(at.state.data(), at.input.data(), down.data());
    Eigen::VectorXd const expected = (up - down) / (2.0 * step);
    auto const forcing = columns(at, {difference(plus.network, minus.network, step)});
    ASSERT_LE((forcing.col(0) - expected).cwiseAbs().maxCoeff(), 1e-6 * expected.cwiseAbs().maxCoeff()) << seed;
  }
}

/// Wherever nothing depends on a parameter its column is zero, whatever its neighbours do.
TEST(ParameterColumns, DoNotTouchEachOther) {
  for (unsigned seed = 0; seed < seeds; ++seed) {
    Instant at(seed);
    auto const all = at.of_everything();
    auto const alone = columns(at, {all}), between = columns(at, {at.none(), all, at.none()});
    ASSERT_EQ(between.col(1), alone.col(0));
    ASSERT_TRUE(between.col(0).isZero(0.0) && between.col(2).isZero(0.0));
  }
}

TEST(ParameterColumns, RefuseAPlaceThatMoves) {
  Instant const at(1);
  auto slope = at.none();
  slope.capacity_slope[0] = 1e-3;
  EXPECT_THROW(ParameterColumns(at.network, {&slope}), InputError);
  for (unsigned seed = 0; seed < seeds; ++seed) {
    Instant const averaging(seed);
    auto moved = averaging.none();
    if (moved.average_weights.empty()) continue;
    moved.average_weights[0][0] = 1.0;
    EXPECT_THROW(ParameterColumns(averaging.network, {&moved}), InputError);
  }
}

}  // namespace
}  // namespace thermotwin::thermal
