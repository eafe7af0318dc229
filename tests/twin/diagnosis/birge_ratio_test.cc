#include "twin/diagnosis/birge_ratio.h"

#include <gtest/gtest.h>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/diagnosis/expected_noise.h"

namespace thermotwin::twin {
namespace {

constexpr double from_mean = 2.0;  // prior deviations

/// A fit to a run of the machine of the file, as the tests below would have it.
struct Question {
  Question() : run(tests::measured(tests::v450(), tests::two_speeds())) {
    data.push_back(bin(run, 300.0));
    estimation.emplace(expected_estimation(tests::v450(), data));
  }
  /// Every second number and lag is known exactly and `from_mean` from its prior; the others are as their priors are.
  [[nodiscard]] Fit half_known() const {
    auto const& unknowns = estimation->unknowns();
    Fit fit;
    fit.x = estimation->prior_mean();
    fit.covariance = Eigen::MatrixXd::Zero(fit.x.size(), fit.x.size());
    for (std::size_t u = 0; u < unknowns.size(); ++u) {
      auto const i = Eigen::Index(u);
      double const deviation = unknowns[u].deviation;
      if (u % 2 == 0)
        fit.x[i] += from_mean * deviation;
      else
        fit.covariance(i, i) = deviation * deviation;
    }
    return fit;
  }

  MeasuredRun run;
  std::vector<BinnedRun> data;
  std::optional<Estimation> estimation;
};

TEST(BirgeRatio, IsHowFarTheKnownNumbersAreFromTheirPriors) {
  Question const question;
  EXPECT_NEAR(squared_birge_ratio(*question.estimation, question.half_known()), from_mean * from_mean, 1e-12);
}

/// A sensor may be glued on with any offset, and a room be warmer than its record: that says nothing of the machine.
TEST(BirgeRatio, IsOfTheFileAlone) {
  Question const question;
  Fit fit = question.half_known();
  auto const& unknowns = question.estimation->unknowns();
  for (std::size_t u = 0; u < unknowns.size(); ++u)
    if (unknowns[u].kind == Unknown::Kind::offset || unknowns[u].kind == Unknown::Kind::air)
      fit.x[Eigen::Index(u)] += 10.0 * unknowns[u].deviation;
  EXPECT_NEAR(squared_birge_ratio(*question.estimation, fit), from_mean * from_mean, 1e-12);
}

TEST(BirgeRatio, OneNumberThatHasLeftTheFileIsSeenAmongManyThatHaveNot) {
  Question const question;
  auto const& unknowns = question.estimation->unknowns();
  Fit fit = question.half_known();
  EXPECT_FALSE(has_left_file(*question.estimation, fit)) << "each by 2 prior deviations";
  for (std::size_t u = 0; u < unknowns.size(); ++u) {
    fit.x = question.estimation->prior_mean();
    fit.x[Eigen::Index(u)] -= 3.1 * unknowns[u].deviation;
    EXPECT_EQ(has_left_file(*question.estimation, fit), unknowns[u].kind == Unknown::Kind::number) << unknowns[u].name;
  }
}

TEST(BirgeRatio, IsOneWhereTheFileIsRight) {
  Question const question;
  auto const& estimation = *question.estimation;
  EXPECT_EQ(squared_birge_ratio(estimation, estimation.fit(estimation.prior_mean())), 1.0);
}

/// A joint that the file does not have: many numbers together do what it does.
TEST(BirgeRatio, IsAboveOneWhereNumbersStandInForAnotherForm) {
  Value const truth = tests::with_table(tests::v450(), R"(
    [[joint]]
    name = "bolt"
    from = "motor"
    to = "bed"
    conductance = "30 W/K")");
  MeasuredRun const run = tests::measured(truth, tests::two_speeds());
  std::vector<BinnedRun> const data = {bin(run, 300.0)};
  auto const estimation = expected_estimation(tests::v450(), data);
  EXPECT_GT(squared_birge_ratio(estimation, estimation.fit(estimation.prior_mean())), 1.5);
}

}  // namespace
}  // namespace thermotwin::twin
