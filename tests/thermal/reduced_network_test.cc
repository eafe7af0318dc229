#include "thermal/reduced_network.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "tests/thermal/random_network.h"
#include "thermal/error.h"
#include "thermal/evaluation.h"
#include "thermal/reduced_integration.h"
#include "thermal/reduced_sums.h"

namespace thermotwin::thermal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool has_moving_part(Network const& network) {
  return std::any_of(network.averages().begin(), network.averages().end(),
                     [](auto const& average) { return average.from_channel >= 0; });
}

/// All temperatures 20 °C, all inputs ½.
ReferencePoint plain_point(Network const& network) {
  return {std::vector<double>(std::size_t(network.temperatures()), T0),
          std::vector<double>(std::size_t(network.channels()), 0.5)};
}

ReducedNetwork with_all_shapes(Network const& network) {
  LinearPart const linear(network, plain_point(network));
  return {network, linear, MatrixXd::Identity(network.nodes(), network.nodes()), nonlinear_elements(network, linear)};
}

TEST(ReducedNetwork, WithAsManyShapesAsNodesIsTheNetwork) {
  int compared = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    auto const random = random_network(seed);
    auto const& network = random.network;
    if (has_moving_part(network)) continue;
    auto const reduced = with_all_shapes(network);
    ReducedEvaluation evaluation(reduced);
    Evaluation full(network);
    std::vector<double> const input(std::size_t(network.channels()), 0.3);
    std::vector<double> state, rate(std::size_t(network.nodes()));
    for (int i = 0; i < network.nodes(); ++i)
      state.push_back(network.state_of_temperature(i, random.start[std::size_t(i)]));
    full.rate(state.data(), input.data(), rate.data());

    VectorXd const xi = reduced.state_of(random.start);
    VectorXd rest;
    evaluation.rest(xi, input.data(), rest);
    VectorXd const back = reduced.shapes() * (rest - reduced.decay().cwiseProduct(xi));
    double const scale = 1e-12 + Eigen::Map<VectorXd const>(rate.data(), back.size()).cwiseAbs().maxCoeff();
    for (int i = 0; i < network.nodes(); ++i)
      ASSERT_NEAR(back[i], rate[std::size_t(i)], 1e-9 * scale) << "seed " << seed << ", node " << i;
    std::vector<double> temperatures(random.start.size());
    reduced.temperatures_of(xi, temperatures);
    for (std::size_t i = 0; i < temperatures.size(); ++i) ASSERT_NEAR(temperatures[i], random.start[i], 1e-9);
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

TEST(ReducedNetwork, RunsAsTheNetworkDoes) {
  std::vector<double> const times{0.0, 300.0, 600.0, 1000.0, 1200.0, 3000.0};
  int compared = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    auto const random = random_network(seed);
    if (has_moving_part(random.network)) continue;
    auto const reduced = with_all_shapes(random.network);
    std::vector<std::vector<double>> full;
    integrate(random.network, random_course(), random.start, times, tight(1e-9), [&](Sample const& sample) {
      full.emplace_back(sample.temperatures.begin(), sample.temperatures.begin() + random.network.nodes());
    });
    std::size_t row = 0;
    std::vector<double> temperatures(random.start.size());
    integrate(reduced, random_course(), reduced.state_of(random.start), times, 1e-7, [&](ReducedSample const& sample) {
      reduced.temperatures_of(sample.state, temperatures);
      for (std::size_t i = 0; i < temperatures.size(); ++i)
        ASSERT_NEAR(temperatures[i], full[row][i], 2e-4) << "seed " << seed << ", t = " << sample.time;
      ++row;
    });
    ASSERT_EQ(row, times.size());
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

TEST(ReducedNetwork, SumsSeeTheTemperaturesOfNodesWhoseCapacityDependsOnThem) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    auto const random = random_network(seed);
    if (has_moving_part(random.network)) continue;
    auto const reduced = with_all_shapes(random.network);
    ReducedSums::Weights weights;
    double expected = 0.0;
    for (int i = 0; i < random.network.nodes(); ++i) {
      weights.emplace_back(i, 0.1 * (i + 1));
      expected += 0.1 * (i + 1) * random.start[std::size_t(i)];
    }
    VectorXd value;
    ReducedSums(reduced, {weights}).evaluate(reduced.state_of(random.start), value);
    ASSERT_NEAR(value[0], expected, 1e-9 * std::abs(expected)) << "seed " << seed;
  }
}

TEST(ReducedNetwork, LinearPartIsSymmetricAndNeverNegative) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    auto const random = random_network(seed);
    LinearPart const linear(random.network, plain_point(random.network));
    MatrixXd const K = linear.conductance;
    ASSERT_LT((K - K.transpose()).norm(), 1e-12 * K.norm()) << "seed " << seed;
    ASSERT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(K).eigenvalues()[0], -1e-9 * K.norm()) << "seed " << seed;
    // What leaves the nodes at equal temperatures goes through the boundaries.
    VectorXd const rise = VectorXd::Ones(K.rows());
    ASSERT_LT((K * rise - linear.boundary * VectorXd::Ones(linear.boundary.cols())).norm(), 1e-9 * K.norm());
  }
}

TEST(ReducedNetwork, RefusesWhatItCannotKnow) {
  Network const network = with_thermostat();
  EXPECT_THROW(with_all_shapes(network), InputError);
}

TEST(ReducedNetwork, RefusesShapesThatDependOnEachOther) {
  auto const random = random_network(3, {.averages = false});
  LinearPart const linear(random.network, plain_point(random.network));
  MatrixXd const twice = MatrixXd::Ones(random.network.nodes(), 2);
  EXPECT_THROW(ReducedNetwork(random.network, linear, twice, {}), InputError);
}

}  // namespace
}  // namespace thermotwin::thermal
