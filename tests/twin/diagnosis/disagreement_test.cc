#include "twin/diagnosis/disagreement.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/diagnosis/expected_noise.h"
#include "twin/diagnosis/regimes.h"

namespace thermotwin::twin {
namespace {

using testing::ElementsAre;

/// The fifteen comparisons of Benjamini and Hochberg (1995), table on page 295: four at a rate of 5 %.
TEST(Discoveries, AreThoseOfThePaper) {
  auto const found = discoveries({0.3240, 0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344, 0.0459,
                                  0.4262, 0.5719, 0.6528, 0.7590, 1.0000},
                                 0.05);
  EXPECT_EQ(std::count(found.begin(), found.end(), true), 4);
  EXPECT_TRUE(found[1] && found[2] && found[3] && found[4]);
  EXPECT_TRUE(discoveries({}, 0.05).empty());
}

/// Two speeds and a rest of the very machine that the twin is, but for one sensor that shows a kelvin more at 2500 rpm.
class DisagreementTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Value const document = tests::v450();
    runs = {tests::measured(document, tests::two_speeds())};
    tests::add_noise(runs[0], 0.05, 0.1e-6, 7);
    auto& sensor = *std::find_if(runs[0].channels.begin(), runs[0].channels.end(),
                                 [](auto const& channel) { return channel.name == "T4"; });
    for (Eigen::Index i = 0; i < runs[0].time.size(); ++i)
      if (runs[0].time[i] > 80.0 * 60.0 && runs[0].time[i] <= 130.0 * 60.0) sensor.values[i] += 1.0;
    rows = {bin(runs[0], 300.0)};
    auto const estimation = expected_estimation(document, rows);
    cells = disagreements(estimation, truth(estimation), Machine::build(document));
  }

  /// Every number as the file says, and every change when its sample says.
  static Eigen::VectorXd truth(Estimation const& estimation) {
    Eigen::VectorXd x = estimation.prior_mean();
    for (std::size_t u = 0; u < estimation.unknowns().size(); ++u)
      if (estimation.unknowns()[u].kind == Unknown::Kind::moments) x[Eigen::Index(u)] = 0.0;
    return x;
  }

  static std::vector<MeasuredRun> runs;
  static std::vector<BinnedRun> rows;
  static std::vector<Disagreement> cells;
};

std::vector<MeasuredRun> DisagreementTest::runs;
std::vector<BinnedRun> DisagreementTest::rows;
std::vector<Disagreement> DisagreementTest::cells;

TEST_F(DisagreementTest, IsGreatestWhereAndWhenTheSensorShowsMore) {
  auto const& worst = *std::max_element(cells.begin(), cells.end(), [](auto const& a, auto const& b) {
    return std::pair(a.cut == "speed", a.power) < std::pair(b.cut == "speed", b.power);
  });
  EXPECT_EQ(worst.channel, "T4");
  EXPECT_EQ(worst.part, "2500 rpm");
  EXPECT_TRUE(worst.significant);
  EXPECT_NEAR(worst.mean, 1.0, 0.1);
  EXPECT_GE(worst.rms, worst.mean);
}

TEST_F(DisagreementTest, IsNotSignificantAnywhereElse) {
  for (auto const& cell : cells)
    if (cell.channel != "T4") {
      EXPECT_FALSE(cell.significant) << cell.channel << " " << cell.part;
      EXPECT_LT(cell.power, 1.5) << cell.channel << " " << cell.part;
    }
}

TEST_F(DisagreementTest, PowerIsThatOfTheWholeRunWhereverItIsCut) {
  std::map<std::string, std::map<std::string, double>> least, most;
  for (auto const& cell : cells) {
    auto& low = least[cell.channel].try_emplace(cell.cut, INFINITY).first->second;
    auto& high = most[cell.channel].try_emplace(cell.cut, 0.0).first->second;
    low = std::min(low, cell.power);
    high = std::max(high, cell.power);
  }
  for (auto const& [channel, cuts] : least)
    for (auto const& [cut, low] : cuts)
      for (auto const& [other, high] : most[channel]) EXPECT_LE(low, high) << channel << " " << cut << " " << other;
}

TEST_F(DisagreementTest, RegimesFollowTheMachine) {
  auto const speeds = speed_regimes(runs[0], rows[0].time);
  EXPECT_THAT(speeds.names, ElementsAre("idle", "2500 rpm", "4000 rpm", "5000 rpm"));
  auto const regimes = thermal_regimes(rows[0]);
  for (Eigen::Index row = 0; row < rows[0].time.size(); ++row) {
    auto const& speed = speeds.names[speeds.of_row[std::size_t(row)]];
    auto const& regime = regimes.names[regimes.of_row[std::size_t(row)]];
    if (speed == "5000 rpm" && rows[0].time[row] < 3600.0) {
      EXPECT_EQ(regime, "warm-up") << rows[0].time[row];
    }
    if (speed == "idle") {
      EXPECT_THAT(regime, testing::AnyOf("cool-down", "idle")) << rows[0].time[row];
    }
  }
  auto const windows = time_windows(rows[0]);
  EXPECT_EQ(windows.names.size(), 12U);
  EXPECT_EQ(windows.names.front(), "0-0.333 h");
  EXPECT_TRUE(std::is_sorted(windows.of_row.begin(), windows.of_row.end()));
  EXPECT_EQ(windows.of_row.back(), 11U);
}

}  // namespace
}  // namespace thermotwin::twin
