#include "models/network.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/back_propagation.h"
#include "models/genetic_back_propagation.h"
#include "models/genetic_search.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Paper 003's shape: 70 samples of five temperatures in warm-up, a stop, and a warm-up again.
Batch duty(std::uint64_t seed, Eigen::Index instants = 70, Eigen::Index inputs = 5) {
  std::mt19937_64 generator(seed);
  MatrixXd rise(instants, inputs);
  VectorXd error = VectorXd::Zero(instants);
  for (Eigen::Index j = 0; j < inputs; ++j) {
    double const minutes = 8.0 + 15.0 * double(j);
    double x = 0;
    for (Eigen::Index t = 0; t < instants; ++t) {
      bool const runs = t < 25 || (t >= 30 && t < 60);
      rise(t, j) = x + 0.03 * normal(generator);
      error(t) += (3.0 - double(j)) * x;
      x += ((runs ? 15.0 / (1.0 + double(j)) : 0.0) - x) * 2.0 / minutes;
    }
  }
  for (auto& e : error) e += 3.0 * std::sin(e / 8.0) + 0.3 * normal(generator);
  return batch_of(rise, error);
}

TEST(Network, HasSeventyEightNumbersForFiveInputs) {
  EXPECT_EQ(hidden_nodes(5), 11);
  EXPECT_EQ(network_parameters(5), 78);
}

TEST(Network, NumbersGoToTheFormAndBack) {
  VectorXd const numbers = random_parameters(78, 3);
  auto const form = network_of(numbers, 5);
  EXPECT_EQ(form.weights.size() + form.output_weights.size(), 66);
  EXPECT_EQ(parameters_of(form), numbers);
}

TEST(Network, OutputIsTheEquation) {
  auto const form = network_of(random_parameters(network_parameters(2), 4), 2);
  MatrixXd const x = (MatrixXd(2, 2) << 0.3, -0.7, 1.0, 0.2).finished();
  VectorXd const y = network_output(form, x);
  for (int t = 0; t < 2; ++t) {
    double sum = -form.output_threshold;
    for (int j = 0; j < 5; ++j)
      sum += form.output_weights(j) / (1.0 + std::exp(form.thresholds(j) - form.weights.row(j).dot(x.row(t))));
    EXPECT_NEAR(y(t), sum, 1e-14);
  }
}

TEST(NetworkLoss, GradientIsThatOfDifferences) {
  auto loss = NetworkSamples(std::vector{duty(1)}).loss();
  VectorXd const at = random_parameters(78, 5);
  VectorXd gradient;
  EXPECT_EQ(loss.with_gradient(at, gradient), loss(at));
  EXPECT_NEAR(loss.rough(at), loss(at), 1e-5 * loss(at));
  for (Eigen::Index k = 0; k < 78; ++k) {
    double const step = 1e-5;
    double const difference =
        (loss(at + step * VectorXd::Unit(78, k)) - loss(at - step * VectorXd::Unit(78, k))) / (2 * step);
    EXPECT_NEAR(gradient(k), difference, 1e-6 * (1.0 + std::abs(difference))) << k;
  }
}

TEST(Descent, NeverEndsAboveItsStart) {
  auto loss = NetworkSamples(std::vector{duty(2)}).loss();
  for (std::uint64_t seed : {1, 2, 3}) {
    VectorXd const start = random_parameters(78, seed);
    auto const found = descend(loss, start, {.epochs = 300});
    EXPECT_LT(found.loss, 0.05 * loss(start));
    EXPECT_EQ(found.loss, loss(found.parameters));
  }
}

TEST(Descent, StopsAtItsGoal) {
  auto loss = NetworkSamples(std::vector{duty(2)}).loss();
  auto const found = descend(loss, random_parameters(78, 1), {.goal = 0.01});
  EXPECT_LE(found.loss, 0.01 * 70);
  EXPECT_LT(found.epochs, 2000);
}

TEST(Chromosome, GenesAndNumbersGoBothWays) {
  Chromosome chromosome;
  for (std::uint32_t k = 0; k < 78; ++k) chromosome.push_back(std::uint16_t(k * 851));
  EXPECT_EQ(encode(decode(chromosome)), chromosome);
  VectorXd const numbers = random_parameters(78, 6);
  EXPECT_LE((decode(encode(numbers)) - numbers).cwiseAbs().maxCoeff(), 0.5 * 2.0 / 65535 + 1e-15);
  EXPECT_EQ(decode({0, 65535}), Eigen::Vector2d(-1, 1));
  EXPECT_EQ(encode(Eigen::Vector2d(-7, 7)), (Chromosome{0, 65535}));
}

TEST(GeneticSearch, KeepsItsBestAndComesNearAPeak) {
  VectorXd const peak = 0.8 * random_parameters(12, 7);
  auto const fitness = [&](VectorXd const& x) { return 1.0 / ((x - peak).squaredNorm() + 1e-9); };
  for (std::uint64_t seed : {1, 2, 3}) {
    auto const search = genetic_search(12, fitness, seed);
    EXPECT_TRUE(std::is_sorted(search.fitness.begin(), search.fitness.end()));
    EXPECT_EQ(fitness(search.best.back()), search.fitness.back());
    EXPECT_LT((search.best.back() - peak).norm(), 0.2 * (search.best.front() - peak).norm());
  }
}

TEST(GeneticSearch, IsTheSameForTheSameSeed) {
  auto const fitness = [](VectorXd const& x) { return -x.squaredNorm(); };
  GeneticOptions const few{.generations = 20};
  EXPECT_EQ(genetic_search(8, fitness, 5, few).best.back(), genetic_search(8, fitness, 5, few).best.back());
  EXPECT_NE(genetic_search(8, fitness, 5, few).best.back(), genetic_search(8, fitness, 6, few).best.back());
}

/// methods.md §11, C4, of the models as they are fitted: at or below the median of twenty random starts. A start that
/// is no better than these is so in half of the draws, and in ten of twelve or more twice in a hundred times.
TEST(NetworkModel, EndsLowerFromAGeneticSearchThanFromRandomStarts) {
  constexpr int draws = 12;
  int lower = 0;
  for (std::uint64_t draw = 1; draw <= draws; ++draw) {
    std::vector const batches{duty(draw)};
    auto const loss = [&](ErrorModel const& model) { return (model.predict(batches[0]) - batches[0].error).norm(); };
    VectorXd random(20);
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
      random[Eigen::Index(seed) - 1] = loss(fit_back_propagation(batches, {.seed = 100 * draw + seed}));
    std::sort(random.begin(), random.end());
    if (loss(fit_genetic_back_propagation(batches, {.seed = draw})) <= 0.5 * (random[9] + random[10])) ++lower;
  }
  EXPECT_GE(lower, 10);
}

/// Only so do starts compare.
TEST(NetworkModel, DescendsAsLongFromAnyStart) {
  std::vector const batches{duty(1)};
  EXPECT_THAT(fit_genetic_back_propagation(batches, {}).remark, testing::HasSubstr(" 2 descents of 5000 epochs"));
  EXPECT_THAT(fit_back_propagation(batches, {}).remark, testing::HasSubstr(" 5000 epochs"));
}

TEST(NetworkModel, SaysThatItHasMoreParametersThanSamples) {
  EXPECT_THAT(fit_back_propagation(std::vector{duty(1)}, {}).remark,
              testing::HasSubstr("78 parameters for 70 samples"));
  EXPECT_THAT(fit_back_propagation(std::vector{duty(1, 90)}, {}).remark, testing::Not(testing::HasSubstr("samples")));
}

TEST(NetworkModel, DependsOnItsSeedOnly) {
  std::vector const batches{duty(4, 70, 2)};
  auto const predicted = [&](std::uint64_t seed) {
    return fit_back_propagation(batches, {.seed = seed}).predict(batches[0]);
  };
  EXPECT_EQ(predicted(1), predicted(1));
  EXPECT_NE(predicted(1), predicted(2));
}

}  // namespace
}  // namespace thermotwin::models
