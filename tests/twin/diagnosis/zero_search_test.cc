#include "twin/diagnosis/zero_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/diagnosis/expected_noise.h"

namespace thermotwin::twin {
namespace {

/// By how much channels stand off in the second of two runs, from a time on.
struct Off {
  std::map<std::string, double> by;
  double from = 0.0;
};

/// Two runs of a machine, noise as of good instruments.
std::vector<MeasuredRun> two_runs(Value const& truth, Off const& off) {
  std::vector<MeasuredRun> runs = {tests::measured(truth, tests::two_speeds()),
                                   tests::measured(truth, tests::two_speeds("50 min", "80 min", "60 min", "50 min"))};
  for (auto& channel : runs[1].channels)
    if (auto const own = off.by.find(channel.name); own != off.by.end())
      for (Eigen::Index i = 0; i < runs[1].time.size(); ++i)
        if (runs[1].time[i] >= off.from) channel.values[i] += own->second;
  tests::add_noise(runs[0], 0.02, 0.05e-6, 3);
  tests::add_noise(runs[1], 0.02, 0.05e-6, 4);
  return runs;
}

/// What is found beside the machine of the file: of each zero its name, and by how much it changed.
std::map<std::string, double> found(Value const& truth, Off const& off) {
  auto const runs = two_runs(truth, off);
  std::vector<BinnedRun> const data = {bin(runs[0], 300.0), bin(runs[1], 300.0)};
  auto const estimation = expected_estimation(tests::v450(), data);
  auto const freed = with_changed_zeros(estimation, estimation.fit(estimation.prior_mean()), 11.0);
  std::map<std::string, double> zeros;
  if (!freed) return zeros;
  auto const& unknowns = freed->estimation.unknowns();
  for (std::size_t u = 0; u < unknowns.size(); ++u)
    if (unknowns[u].kind == Unknown::Kind::zero) zeros[unknowns[u].name] = freed->fit.x[Eigen::Index(u)];
  return zeros;
}

TEST(ZeroSearch, FindsNoneWhereNoneChanged) { EXPECT_TRUE(found(tests::v450(), {}).empty()); }

/// Of two runs it is either.
TEST(ZeroSearch, FindsASensorOfAnotherOffset) {
  auto const zeros = found(tests::v450(), {{{"T8", 0.6}}});
  ASSERT_EQ(zeros.size(), 1u);
  EXPECT_THAT(zeros.begin()->first, testing::MatchesRegex("T8 in run [12], beside the others"));
  bool const of_first = zeros.begin()->first.find("run 1") != std::string::npos;
  EXPECT_NEAR(zeros.begin()->second, of_first ? -0.6 : 0.6, 0.15);
}

/// Between the samples at 90 min and at 91.
TEST(ZeroSearch, FindsWhenAProbeWasKnocked) {
  auto const zeros = found(tests::v450(), {{{"E_Z", -12e-6}}, 5412.0});
  ASSERT_EQ(zeros.size(), 1u);
  EXPECT_EQ(zeros.begin()->first, "E_Z from 1.51 h of run 2 on");
  EXPECT_NEAR(zeros.begin()->second, -12e-6, 0.6e-6);
}

/// So does a machine that was warm when the run began.
TEST(ZeroSearch, FindsNoneWhereAllStandOffAlike) {
  Off warm;
  for (int i = 1; i <= 9; ++i) warm.by["T" + std::to_string(i)] = 1.5 + 0.02 * i;
  EXPECT_TRUE(found(tests::v450(), warm).empty());
}

/// Heat that no file knows moves sensors, and none from the start.
TEST(ZeroSearch, FindsNoneOfHeat) {
  EXPECT_TRUE(found(tests::with_table(tests::v450(), R"(
    [[heat]]
    name = "pump"
    at = "head_rear"
    power = "40 W")"),
                    {})
                  .empty());
}

/// An unknown between those that are linear and the effects: what stood behind it moves by one.
TEST(ZeroSearch, LeavesEffectsTheirPlaces) {
  auto const runs = two_runs(tests::v450(), {});
  std::vector<BinnedRun> const data = {bin(runs[0], 300.0), bin(runs[1], 300.0)};
  Value const document = tests::v450();
  auto const all = hypotheses(document, Machine::build(document));
  auto const plain = expected_estimation(document, data).with({all.front()});
  auto const freed = plain.with_zeros({{1, 2, 0.0, 1.0}});
  EXPECT_EQ(freed.unknowns().back().kind, Unknown::Kind::amplitude);
  EXPECT_EQ(freed.unknowns()[freed.unknowns().size() - 2].kind, Unknown::Kind::zero);
  Eigen::VectorXd x = plain.prior_mean();
  x[x.size() - 1] = 0.25;
  Eigen::VectorXd const longer = plain.with_zeros(x, 1);
  ASSERT_EQ(std::size_t(longer.size()), freed.unknowns().size());
  EXPECT_EQ(longer[longer.size() - 1], 0.25);
  EXPECT_EQ(longer[longer.size() - 2], 0.0);
}

}  // namespace
}  // namespace thermotwin::twin
