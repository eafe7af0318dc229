#include "models/information_screen.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/planted_noise.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(InformationScreen, EachComponentKeepsItsTwoBest) {
  std::vector<std::string> const components{"nut", "motor", "nut", "nut", "bed", "bed", "nut"};
  VectorXd const information = (VectorXd(7) << 0.1, 0.01, 0.5, 0.3, 0.2, -0.1, 0.5).finished();
  EXPECT_THAT(best_within_components(components, information), ElementsAre(1, 2, 4, 5, 6));
  EXPECT_THAT(best_within_components(components, information, 1), ElementsAre(1, 2, 4));
}

/// On the nut one sensor of four reads the state that the error follows; the others their own; the bed is noise.
Batch nut_and_bed(std::uint64_t seed, Index informative) {
  Noise noise(seed);
  VectorXd const state = thermal_state(80, 12, 20, noise);
  MatrixXd rise(80, 6);
  for (Index i = 0; i < 4; ++i)
    rise.col(i) = 5 * (i == informative ? state : thermal_state(80, 12, 20, noise)) + 0.1 * noise.series(80);
  rise.rightCols(2) = 0.1 * noise.series(160).reshaped(80, 2);
  Batch batch = batch_of(rise, 20 * state + 0.5 * noise.series(80));
  batch.components = {"nut", "nut", "nut", "nut", "bed", "bed"};
  return batch;
}

TEST(InformationScreen, PlantedInformativeSensorIsKept) {
  int kept = 0, significant = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    auto const informative = static_cast<Index>(seed % 4);
    Batch const batch = nut_and_bed(seed, informative);
    auto const screen = screen_by_information(candidates({&batch, 1}, {}), seed);
    if (std::count(screen.kept.begin(), screen.kept.end(), informative) == 1) ++kept;
    if (screen.p_value(informative) <= 0.05) ++significant;
  }
  EXPECT_GE(kept, 95);
  EXPECT_GE(significant, 95);
}

TEST(InformationScreen, SensorOfNoiseHasALargePValueAndIsNamed) {
  int independent = 0, named = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Batch const batch = nut_and_bed(seed, 0);
    auto const screen = screen_by_information(candidates({&batch, 1}, {}), seed);
    if (screen.p_value(4) > 0.05) ++independent;
    if (screen.p_value(4) >= 0.05 && screen.remark.find("T5") != std::string::npos) ++named;
  }
  EXPECT_GE(independent, 90);
  EXPECT_GE(named, 85);
}

/// methods.md §11, B1, where minutes resemble their neighbours.
TEST(InformationScreen, IndependentSensorsOfLongMemoryHaveLargePValuesByBlocks) {
  constexpr Index sensors = 10;
  int by_samples = 0, by_blocks = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Noise noise(seed);
    VectorXd const error = autoregressive(200, 0.9, noise);
    MatrixXd rise(200, sensors);
    for (Index i = 0; i < sensors; ++i) rise.col(i) = autoregressive(200, 0.9, noise);
    Batch const batch = batch_of(rise, error);
    auto const screen = screen_by_information(candidates({&batch, 1}, {}), seed);
    by_samples += int((screen.p_value.array() > 0.05).count());
    by_blocks += int((screen.block_p_value.array() > 0.05).count());
  }
  EXPECT_LT(by_samples, 600);
  EXPECT_GE(by_blocks, 900);
}

TEST(InformationScreen, SensorThatFollowsTheErrorHasASmallPValueByBlocks) {
  int significant = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Noise noise(seed);
    VectorXd const error = autoregressive(200, 0.9, noise), sensor = error + noise.series(200);
    Batch const batch = batch_of(sensor, error);
    significant += screen_by_information(candidates({&batch, 1}, {}), seed).block_p_value(0) <= 0.05;
  }
  EXPECT_GE(significant, 45);
}

TEST(InformationScreen, SaysWhereBinsRankNothing) {
  VectorXd const t = VectorXd::LinSpaced(11, 0, 10);  // eleven instants, two bins, all monotone
  MatrixXd rise(11, 3);
  rise << t, 1.1 * t, t + 0.01 * t.array().square().matrix();
  Batch const batch = batch_of(rise, t);
  EXPECT_THAT(screen_by_information(candidates({&batch, 1}, {}), 1).remark,
              HasSubstr("their information ranks nothing"));
}

/// One reading far off leaves a sensor's others in one bin of equal width; its neighbours remain its neighbours.
TEST(InformationScreen, SaysWhereNeighboursDisagree) {
  Noise noise(1);
  VectorXd const error = noise.series(300);
  MatrixXd rise(300, 3);
  rise << error + 0.1 * noise.series(300), error + noise.series(300), error + noise.series(300);
  Batch batch = batch_of(rise, error);
  auto const agreed = screen_by_information(candidates({&batch, 1}, {}), 1);
  EXPECT_THAT(agreed.kept, Contains(0));
  batch.temperature_rise(17, 0) = 200.0;
  auto const screen = screen_by_information(candidates({&batch, 1}, {}), 1);
  EXPECT_THAT(screen.kept, ElementsAre(1, 2));
  EXPECT_THAT(screen.remark, HasSubstr("by nearest neighbours the components would keep T1, T"));
}

TEST(InformationScreen, SaysNothingOfNeighboursThatAgree) {
  Noise noise(2);
  VectorXd const error = noise.series(300);
  MatrixXd rise(300, 3);
  rise << error + 0.1 * noise.series(300), error + 0.3 * noise.series(300), noise.series(300);
  Batch const batch = batch_of(rise, error);
  auto const screen = screen_by_information(candidates({&batch, 1}, {}), 1);
  EXPECT_THAT(screen.kept, ElementsAre(0, 1));
  EXPECT_THAT(screen.remark, testing::Not(HasSubstr("nearest neighbours")));
}

/// Of three blocks there are six orders: no p can be small, and no sensor is suspected for that.
TEST(InformationScreen, SuspectsNobodyOnARecordThatIsTooShort) {
  auto const remark = [](Index samples) {
    VectorXd const t = VectorXd::LinSpaced(samples, 0.0, double(samples - 1));
    VectorXd const error = (t.array() / 12.0).sin();
    MatrixXd rise(samples, 2);
    rise << error, (t.array() / 12.0 + 0.5).sin().matrix();
    Batch const batch = batch_of(rise, error);
    return screen_by_information(candidates({&batch, 1}, {}), 1).remark;
  };
  EXPECT_THAT(remark(120),
              HasSubstr("too short a record to tell more of what is independent of the error: its 120 samples are "));
  EXPECT_THAT(remark(1200), testing::Not(HasSubstr("too short")));
}

TEST(InformationScreen, MemoryIsWhereTheAutocorrelationFalls) {
  Noise noise(1);
  EXPECT_EQ(memory_of(noise.series(500)), 1);
  VectorXd const wave = VectorXd::NullaryExpr(600, [](Index i) { return std::sin(2 * std::numbers::pi * i / 60.0); });
  EXPECT_NEAR(static_cast<double>(memory_of(wave)), 60 * std::acos(1 / std::exp(1.0)) / (2 * std::numbers::pi), 1.0);
}

TEST(InformationScreen, SelectionRanksTheScreenedAndFillsUpToTheCount) {
  Batch const batch = nut_and_bed(7, 2);
  auto const usual = select_by_mutual_information({&batch, 1}, {});
  EXPECT_EQ(usual.sensors.size(), 4U);
  EXPECT_EQ(usual.sensors.front(), 2);
  EXPECT_EQ(usual.score.size(), 6);
  for (int count = 1; count <= 6; ++count) {
    auto const chosen = select_by_mutual_information({&batch, 1}, {.count = count}).sensors;
    EXPECT_EQ(chosen.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(chosen.front(), 2);
  }
  EXPECT_EQ(select_by_mutual_information({&batch, 1}, {.count = {}, .seed = 5}).score,
            select_by_mutual_information({&batch, 1}, {.count = {}, .seed = 5}).score);
}

}  // namespace
}  // namespace thermotwin::models
