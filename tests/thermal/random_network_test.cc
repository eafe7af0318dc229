#include "tests/thermal/random_network.h"

#include <cstring>
#include <gtest/gtest.h>

namespace thermotwin::thermal {
namespace {

std::vector<double> const times{0.0, 300.0, 1000.0, 3000.0};
constexpr LinearSolver every_solver[] = {LinearSolver::dense, LinearSolver::sparse_direct,
                                         LinearSolver::preconditioned_krylov, LinearSolver::multigrid};

std::vector<double> input_at(Network const& network, double t) {
  std::vector<double> all(4), input;
  auto const course = random_course();
  course.evaluate(t, all);
  for (int i = 0; i < network.given_channels(); ++i)
    for (std::size_t k = 0; k < 4; ++k)
      if (course.channels()[k].name == network.channel_names()[std::size_t(i)]) input.push_back(all[k]);
  return input;
}

std::vector<double> state_of(RandomNetwork const& random) {
  std::vector<double> state;
  for (int i = 0; i < random.network.nodes(); ++i)
    state.push_back(random.network.state_of_temperature(i, random.start[std::size_t(i)]));
  return state;
}

TEST(RandomNetwork, EveryRunKeepsItsEnergy) {
  double worst = 0.0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    auto const random = random_network(seed);
    auto const summary = integrate(random.network, random_course(), random.start, times, {}, [&](Sample const& s) {
      ASSERT_GE(s.energy.supplied, 0.0);
      ASSERT_GE(s.energy.withdrawn, 0.0);
    });
    ASSERT_LT(summary.energy_imbalance(), 1e-9) << "seed " << seed;
    worst = std::max(worst, summary.energy_imbalance());
  }
  RecordProperty("worst_imbalance", std::to_string(worst));
}

TEST(RandomNetwork, TheBalanceClosesWithEverySolverAndLooseTolerances) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    auto const random = random_network(seed);
    for (auto solver : every_solver) {
      IntegrationOptions options = tight(1e-3);
      options.solver = solver;
      auto const summary = integrate(random.network, random_course(), random.start, times, options, [](auto&) {});
      ASSERT_LT(summary.energy_imbalance(), 1e-9) << "seed " << seed << ", " << name_of(solver);
    }
  }
}

TEST(RandomNetwork, SolversAgree) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    auto const random = random_network(seed);
    std::vector<std::vector<double>> ends;
    for (auto solver : every_solver) {
      IntegrationOptions options = tight(1e-9);
      options.solver = solver;
      integrate(random.network, random_course(), random.start, times, options, [&](Sample const& s) {
        if (s.time == times.back()) ends.emplace_back(s.temperatures.begin(), s.temperatures.end());
      });
    }
    for (std::size_t i = 0; i < ends[0].size(); ++i) {
      ASSERT_NEAR(ends[0][i], ends[1][i], 1e-5) << "seed " << seed;
      ASSERT_NEAR(ends[0][i], ends[2][i], 1e-5) << "seed " << seed;
      ASSERT_NEAR(ends[0][i], ends[3][i], 1e-5) << "seed " << seed;
    }
  }
}

TEST(RandomNetwork, InternalFlowsCancelToRoundOff) {
  for (unsigned seed = 0; seed < 1000; ++seed) {
    auto const random = random_network(seed);
    auto const& network = random.network;
    Evaluation evaluation(network);
    auto const input = input_at(network, 100.0);
    std::vector<double> rate(std::size_t(network.nodes()));
    auto const power = evaluation.rate_and_power(state_of(random).data(), input.data(), rate.data());
    double sum = 0.0, gross = 0.0;
    for (std::size_t i = 0; i < rate.size(); ++i) {
      sum += network.capacity()[i] * rate[i];
      gross += std::abs(network.capacity()[i] * rate[i]);
    }
    ASSERT_NEAR(sum, power.supplied - power.withdrawn - power.lost, 1e-12 * (gross + power.exchanged)) << seed;
  }
}

TEST(RandomNetwork, WithoutSourcesNothingLeavesTheRangeOfStartAndSurroundings) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    auto const random = random_network(seed, {.averages = false, .sources = false});
    integrate(random.network, random_course(), random.start, times, {}, [&](Sample const& s) {
      for (int i = 0; i < random.network.nodes(); ++i) {
        ASSERT_GE(s.temperatures[std::size_t(i)], random.coldest - 1e-3) << "seed " << seed << " t " << s.time;
        ASSERT_LE(s.temperatures[std::size_t(i)], random.warmest + 1e-3) << "seed " << seed << " t " << s.time;
      }
    });
  }
}

TEST(RandomNetwork, JacobianAgreesWithCentralDifferences) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    auto const random = random_network(seed);
    auto const& network = random.network;
    Evaluation evaluation(network);
    auto const input = input_at(network, 800.0);
    auto state = state_of(random);
    Eigen::MatrixXd const exact = evaluation.jacobian(state.data(), input.data());
    double const step = 2e-4;
    int const n = network.nodes();
    Eigen::VectorXd plus(n), minus(n);
    for (int k = 0; k < n; ++k) {
      double const y = state[std::size_t(k)];
      state[std::size_t(k)] = y + step;
      evaluation.rate(state.data(), input.data(), plus.data());
      state[std::size_t(k)] = y - step;
      evaluation.rate(state.data(), input.data(), minus.data());
      state[std::size_t(k)] = y;
      double const scale = exact.col(k).cwiseAbs().maxCoeff();
      for (int i = 0; i < n; ++i)
        ASSERT_NEAR((plus[i] - minus[i]) / (2 * step), exact(i, k), 1e-6 * scale) << "seed " << seed;
    }
  }
}

TEST(RandomNetwork, LinearisationKeepsTheBalanceTermByTerm) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    auto const random = random_network(seed);
    auto const& network = random.network;
    Evaluation evaluation(network);
    auto const input = input_at(network, 800.0);
    auto const state = state_of(random);
    Linearisation at;
    evaluation.linearise(state.data(), input.data(), at);
    int const n = network.nodes(), boundaries = int(network.boundaries().size());
    for (int port = 0; port < network.temperatures(); ++port) {
      double into_bodies = 0.0, gross = 0.0;
      for (Eigen::SparseMatrix<double>::InnerIterator it(at.coupling, port); it; ++it) {
        if (it.row() < n || it.row() >= n + boundaries) into_bodies += it.value();
        gross += std::abs(it.value());
      }
      ASSERT_NEAR(into_bodies, at.power(0, port) - at.power(1, port) - at.power(2, port), 1e-13 * gross)
          << "seed " << seed;
    }
  }
}

TEST(RandomNetwork, TheSameRunGivesTheSameBytes) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    auto const once = [&] {
      auto const random = random_network(seed);
      std::vector<double> all;
      integrate(random.network, random_course(), random.start, times, {}, [&](Sample const& s) {
        all.insert(all.end(), s.temperatures.begin(), s.temperatures.end());
        all.push_back(s.energy.lost);
      });
      return all;
    };
    auto const first = once(), second = once();
    ASSERT_EQ(first.size(), second.size());
    ASSERT_EQ(0, std::memcmp(first.data(), second.data(), first.size() * sizeof(double))) << "seed " << seed;
  }
}

TEST(RandomNetwork, SteadyStateIsWhereNothingMoves) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    auto const random = random_network(seed);
    auto const& network = random.network;
    auto const input = input_at(network, 800.0);
    auto const steady = steady_state(network, input, random.start);
    std::vector<double> state, rate(steady.size());
    for (int i = 0; i < network.nodes(); ++i) state.push_back(network.state_of_temperature(i, steady[std::size_t(i)]));
    Evaluation(network).rate(state.data(), input.data(), rate.data());
    for (double r : rate) ASSERT_NEAR(r, 0.0, 1e-9) << "seed " << seed;
  }
}

}  // namespace
}  // namespace thermotwin::thermal
