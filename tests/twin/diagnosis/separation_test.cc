#include "twin/diagnosis/separation.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/diagnosis/expected_noise.h"
#include "twin/diagnosis/score.h"

namespace thermotwin::twin {
namespace {

/// Two runs of the lumped machine, and three effects that it does not have.
struct Bench {
  Bench() : first(tests::measured(tests::v450(), tests::two_speeds())), second(first) {
    second.name = "again";
    data = {bin(first, 600.0), bin(second, 600.0)};
    estimation.emplace(expected_estimation(tests::v450(), data));
    fit = estimation->fit(estimation->prior_mean(), 0);
    auto const all = hypotheses(tests::v450(), Machine::build(tests::v450()));
    for (auto const* label : {"heat at head_front", "heat at head_rear", "copper_loss at motor"})
      for (auto const& hypothesis : all)
        if (hypothesis.label() == label) {
          chosen.push_back(hypothesis);
          break;
        }
    columns = signatures(*estimation, fit, chosen);
    estimation->whiten(columns);
  }
  [[nodiscard]] Blocks all() const {
    return {std::vector<bool>(2, true), std::vector<bool>(estimation->channels().size(), true)};
  }

  MeasuredRun first, second;
  std::vector<BinnedRun> data;
  std::optional<Estimation> estimation;
  Fit fit;
  std::vector<Hypothesis> chosen;
  Eigen::MatrixXd columns;
};

TEST(Separation, WithAllBlocksIsTheInformationAndTheCosineOfTheScore) {
  Bench const bench;
  ASSERT_EQ(bench.chosen.size(), 3U);
  auto const products = Separation(*bench.estimation, bench.fit, bench.columns).products(bench.all());
  Remainder const remainder(bench.fit, bench.columns);
  auto const scores = remainder.scores(bench.chosen);
  auto const alike = remainder.cosines(0);
  for (Eigen::Index k = 0; k < 3; ++k) {
    double const information = scores[std::size_t(k)].information;
    EXPECT_NEAR(products(k, k), information, 1e-6 * information) << k;
    EXPECT_NEAR(cosine(products, 0, k), alike[k], 1e-6) << k;
    EXPECT_NEAR(seen(products, k, -2.0), 2.0 * std::sqrt(information), 1e-6 * std::sqrt(information)) << k;
  }
}

/// d_ij is what is left of signature i when j of any size is taken away.
TEST(Separation, ApartIsTheDistanceToTheNearestRival) {
  Bench const bench;
  auto const products = Separation(*bench.estimation, bench.fit, bench.columns).products(bench.all());
  double least = INFINITY;
  for (double rival = -3.0; rival <= 3.0; rival += 1e-3)
    least = std::min(least, products(0, 0) - 2.0 * rival * products(0, 1) + rival * rival * products(1, 1));
  EXPECT_NEAR(apart(products, 0, 1, 1.0), std::sqrt(least), 1e-3 * std::sqrt(products(0, 0)));
  EXPECT_LE(apart(products, 0, 1, 1.0), seen(products, 0, 1.0));
  EXPECT_NEAR(apart(products, 0, 0, 1.0), 0.0, 1e-6 * seen(products, 0, 1.0));
}

TEST(Separation, MoreRunsAndMoreChannelsNeverBlur) {
  Bench const bench;
  Separation const separation(*bench.estimation, bench.fit, bench.columns);
  auto const whole = separation.products(bench.all());
  auto fewer_runs = bench.all();
  fewer_runs.runs[1] = false;
  auto fewer_channels = bench.all();
  fewer_channels.channels[0] = fewer_channels.channels[3] = false;
  for (auto const& use : {fewer_runs, fewer_channels}) {
    auto const part = separation.products(use);
    for (Eigen::Index k = 0; k < 3; ++k) EXPECT_LT(seen(part, k, 1.0), seen(whole, k, 1.0)) << k;
    EXPECT_LE(apart(part, 0, 1, 1.0), apart(whole, 0, 1, 1.0) * (1.0 + 1e-9));
  }
}

}  // namespace
}  // namespace thermotwin::twin
