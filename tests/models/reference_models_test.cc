#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numeric>

#include "models/fuzzy_c_means.h"
#include "models/gaussian_kernel.h"
#include "models/principal_component.h"
#include "models/ridge.h"
#include "models/support_vector.h"
#include "tests/models/simulated_batch.h"
#include "tests/output/temporary_directory.h"

// ε-SVR, principal components and ridge against scikit-learn on the same numbers; fuzzy c-means against the iteration
// of methods.md §4.3 in numpy.

namespace thermotwin::models {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What the script prints for this question.
VectorXd reference(std::string const& question, Batch const& batch) {
  tests::TemporaryDirectory const directory;
  auto const table = directory / "table.txt";
  std::string text;
  for (Eigen::Index t = 0; t < batch.error.size(); ++t) {
    for (double const reading : batch.temperature_rise.row(t)) text += fmt::format("{} ", reading);
    text += fmt::format("{}\n", batch.error(t));
  }
  tests::put(table, text);
  auto const command = fmt::format("/usr/bin/python3 {}/tests/models/reference_models.py {} < {}",
                                   THERMOTWIN_SOURCE_DIR, question, table.string());
  std::vector<double> numbers;
  auto* const pipe = popen(command.c_str(), "r");
  for (double number = 0; std::fscanf(pipe, "%lf", &number) == 1;) numbers.push_back(number);
  EXPECT_EQ(pclose(pipe), 0) << command;
  return VectorXd::Map(numbers.data(), Eigen::Index(numbers.size()));
}

/// Readings and error of mean 0 and variance near 1: a warm-up with a bend.
Batch fixture(std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  MatrixXd rise(90, 3);
  for (Eigen::Index j = 0; j < 3; ++j)
    rise.col(j) = (warm_up(3, 12.0 + 20.0 * double(j), 90, 0.05, generator).array() - 2.0);
  VectorXd error = rise.col(0) + (2.0 * rise.col(2).array()).sin().matrix();
  for (auto& e : error) e += 0.05 * normal(generator);
  return batch_of(rise, error);
}

/// The rows that they were fitted to, and thirty others: every third is left out, so that they stand last in the table.
TEST(ReferenceModels, SupportVectorsPredictWhatScikitLearnPredicts) {
  auto batch = fixture(1);
  std::vector<Eigen::Index> order(90), rows(60);
  std::iota(order.begin(), order.end(), 0);
  std::stable_partition(order.begin(), order.end(), [](Eigen::Index row) { return row % 3 != 2; });
  batch = batch_of(batch.temperature_rise(order, Eigen::all), batch.error(order));
  std::iota(rows.begin(), rows.end(), 0);
  auto const distances = squared_distances(batch.temperature_rise, batch.temperature_rise);
  for (auto const& [cost, g] : {std::pair{1.0, 0.5}, {16.0, 0.0625}, {0.0625, 4.0}}) {
    MatrixXd const kernel = gaussian_kernel(distances, g);
    auto const fit =
        SupportVectorSolver(kernel).solve(batch.error, rows, {.cost = cost, .epsilon = 0.05, .tolerance = 1e-9});
    VectorXd const ours = (kernel * fit.weights).array() + fit.intercept;
    auto const theirs = reference(fmt::format("support_vector {} {} 0.05 {}", cost, g, rows.size()), batch);
    ASSERT_EQ(theirs.size(), 90);
    EXPECT_LT((ours - theirs).head(60).cwiseAbs().maxCoeff(), 1e-6) << cost << ' ' << g;
    EXPECT_LT((ours - theirs).tail(30).cwiseAbs().maxCoeff(), 1e-6) << cost << ' ' << g << ", rows not fitted to";
  }
}

TEST(ReferenceModels, PrincipalComponentsAreScikitLearns) {
  auto const batch = fixture(2);
  auto const ours = principal_components(batch.temperature_rise);
  auto const variances = reference("principal_components", batch);
  ASSERT_EQ(variances.size(), 3);
  EXPECT_LT((ours.variances - variances).cwiseAbs().maxCoeff(), 1e-10);
  auto const directions = reference("directions", batch);
  ASSERT_EQ(directions.size(), 9);
  EXPECT_LT((ours.directions.reshaped() - directions).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(ReferenceModels, RidgePredictsWhatScikitLearnPredicts) {
  auto const batch = fixture(3);
  auto const fit = ridge_regression(batch.temperature_rise, batch.error, contiguous_folds(90, 5));
  VectorXd const ours = (batch.temperature_rise * fit.coefficients).array() + fit.intercept;
  auto const theirs = reference(fmt::format("ridge {}", fit.penalty), batch);
  ASSERT_EQ(theirs.size(), 90);
  EXPECT_LT((ours - theirs).cwiseAbs().maxCoeff(), 1e-8);
}

/// From the memberships after the first iteration on: memberships and centres where both stand.
TEST(ReferenceModels, FuzzyCMeansEndWhereNumpyDoes) {
  MatrixXd const points = fixture(4).temperature_rise;
  for (auto const& [clusters, exponent] : {std::pair{3, 2.0}, {4, 1.6}, {2, 2.7}}) {
    FuzzyOptions options{.exponent = exponent, .tolerance = 1e-12, .iterations = 1, .starts = 1};
    auto const first = fuzzy_c_means(points, clusters, options);
    options.iterations = 10'000;
    auto const ours = fuzzy_c_means(points, clusters, options);
    MatrixXd table(points.rows(), points.cols() + clusters);
    table << points, first.membership.transpose();
    auto const theirs =
        reference(fmt::format("c_means {} {}", clusters, exponent), batch_of(table, VectorXd::Zero(points.rows())));
    auto const shares = clusters * points.rows(), numbers = shares + clusters * points.cols();
    ASSERT_EQ(theirs.size(), numbers);
    EXPECT_LT((ours.membership.reshaped<Eigen::RowMajor>() - theirs.head(shares)).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT((ours.centres.reshaped<Eigen::RowMajor>() - theirs.tail(numbers - shares)).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_GT((ours.membership - first.membership).cwiseAbs().maxCoeff(), 1e-3);  // there was a way to go
  }
}

}  // namespace
}  // namespace thermotwin::models
