#include "twin/diagnosis/start.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/diagnosis/expected_noise.h"

namespace thermotwin::twin {
namespace {

class StartTest : public testing::Test {
 protected:
  /// Nobody knows by how much the tool follows the rear of the head.
  static Value without_drawings() {
    Value document = tests::v450();
    set_parameter(document, "displacement.E_X.segment.0.weight", "0");
    return document;
  }
  MeasuredRun const run = tests::measured(tests::v450(), tests::two_speeds());
  std::vector<BinnedRun> const data{bin(run, 300.0)};
};

TEST_F(StartTest, IsOneWithDrawings) {
  auto const estimation = expected_estimation(tests::v450(), data);
  ASSERT_EQ(starts(estimation).size(), 1);
  EXPECT_EQ(starts(estimation)[0], estimation.prior_mean());
}

TEST_F(StartTest, WithoutDrawingsAreATenthOfThePriorsFromTheirMeans) {
  auto const estimation = expected_estimation(without_drawings(), data);
  auto const all = starts(estimation);
  ASSERT_EQ(all.size(), 5);
  EXPECT_EQ(all[0], estimation.prior_mean());
  for (std::size_t s = 1; s < all.size(); ++s) {
    double squares = 0.0;
    for (std::size_t u = 0; u < estimation.unknowns().size(); ++u) {
      auto const& unknown = estimation.unknowns()[u];
      double const x = all[s][Eigen::Index(u)];
      EXPECT_GE(x, unknown.lower);
      EXPECT_LE(x, unknown.upper);
      squares += std::pow((x - unknown.mean) / unknown.deviation, 2);
    }
    EXPECT_NEAR(std::sqrt(squares / double(all[s].size())), 0.1, 0.02) << s;
    EXPECT_NE(all[s], all[s - 1]);
  }
}

TEST_F(StartTest, OfAllFitsTheLikeliestIsTaken) {
  auto const estimation = expected_estimation(without_drawings(), data);
  auto const best = best_fit(estimation, 2);  // too few to end alike
  double least = INFINITY, most = -INFINITY;
  for (auto const& start : starts(estimation)) {
    double const evidence = estimation.fit(start, 2).evidence;
    least = std::min(least, evidence);
    most = std::max(most, evidence);
  }
  EXPECT_EQ(best.evidence, least);
  EXPECT_GT(most, least);
}

}  // namespace
}  // namespace thermotwin::twin
