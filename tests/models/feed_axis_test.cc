#include "models/feed_axis.h"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double zero = 0.01798;  // [m]

/// Paper 000's test: 13 targets over 600 mm, every 15 min; the screw's error is K(ΔT) (P − P₀), with noise, and the
/// last target has its reversal fault.
AxisRecord feed_run(double feed, std::uint64_t seed, double noise) {
  std::mt19937_64 generator(seed);
  constexpr Eigen::Index instants = 17;
  AxisRecord record{"feed",
                    VectorXd::LinSpaced(instants, 0, 14400),
                    {"nut", "bearing"},
                    {"nut", "bearing"},
                    MatrixXd(instants, 2),
                    VectorXd::LinSpaced(13, 0, 0.6),
                    MatrixXd(instants, 13)};
  for (Eigen::Index t = 0; t < instants; ++t) {
    double const minute = 15.0 * double(t);
    record.temperature_rise(t, 0) = 9.0 * feed * (1 - std::exp(-minute / 45.0));
    record.temperature_rise(t, 1) = 6.0 * feed * (1 - std::exp(-minute / 80.0));
    double const slope = -7.0 * record.temperature_rise(t, 0) - 5.0 * record.temperature_rise(t, 1);
    for (Eigen::Index q = 0; q < 13; ++q)
      record.error(t, q) = slope * (record.position(q) - zero) + noise * normal(generator);
    record.error(t, 12) += t > 0 ? 1.5 : 0.0;
  }
  return record;
}

TEST(AxisLines, AreLeastSquares) {
  AxisRecord const record{"line",
                          Eigen::Vector2d(0, 60),
                          {},
                          {},
                          MatrixXd(2, 0),
                          Eigen::Vector3d(0, 0.1, 0.2),
                          (MatrixXd(2, 3) << 1, 3, 5, 0, 3, 3).finished()};
  auto const lines = axis_lines(record);
  EXPECT_LT((lines.slope - Eigen::Vector2d(20, 15)).norm(), 1e-12);
  EXPECT_LT((lines.intercept - Eigen::Vector2d(1, 0.5)).norm(), 1e-12);
}

TEST(FeedAxis, FindsTheZeroWithinTwoMillimetres) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<AxisRecord> const records{feed_run(1.0, seed, 0.5), feed_run(1.5, seed + 50, 0.5)};
    EXPECT_NEAR(zero_position(records), zero, 0.0061) << "the faulty target moves it";
    std::vector<AxisRecord> clean = records;
    for (auto& record : clean) {
      record.position.conservativeResize(12);
      record.error.conservativeResize(Eigen::NoChange, 12);
    }
    EXPECT_NEAR(zero_position(clean), zero, 0.002);
  }
}

FeedAxisModel fitted(std::vector<AxisRecord> const& records) {
  std::vector<Batch> batches;
  for (auto const& record : records) batches.push_back(slope_batch(record));
  return {model_method("linear").fit(batches, {}), zero_position(records)};
}

TEST(FeedAxis, IsExactWithoutNoise) {
  std::vector<AxisRecord> records{feed_run(1.0, 1, 0.0), feed_run(1.5, 2, 0.0)};
  for (auto& record : records) {
    record.position.conservativeResize(12);
    record.error.conservativeResize(Eigen::NoChange, 12);
  }
  auto const model = fitted(records);
  EXPECT_NEAR(model.zero_position, zero, 1e-12);
  EXPECT_LT((model.predict(records[1]) - records[1].error).cwiseAbs().maxCoeff(), 1e-9);
}

/// Paper 000's level on 0 to 550 mm: RMSE < 1.05 um, largest < 2.1 um, mean < 1 um, at a feed that was not used.
TEST(FeedAxis, ReachesThePapersLevelAtAnotherFeed) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    std::vector<AxisRecord> records{feed_run(1.0, seed, 0.5), feed_run(2.0, seed + 10, 0.5)};
    for (auto& record : records) {
      record.position.conservativeResize(12);
      record.error.conservativeResize(Eigen::NoChange, 12);
    }
    auto const model = fitted(records);
    auto const other = feed_run(1.5, seed + 20, 0.5);
    for (Eigen::Index const instant : {4, 10}) {
      auto const at = model.at_instant(other, instant, 0.0, 0.55);
      EXPECT_LT(at.rmse, 1.05);
      EXPECT_LT(at.max, 2.1);
      EXPECT_LT(at.mae, 1.0);
    }
    EXPECT_GT(model.at_instant(other, 10, 0.0, 0.6).max, model.at_instant(other, 10, 0.0, 0.55).max);
  }
}

TEST(FeedAxis, RefusesWhatIsNoRecord) {
  auto const good = feed_run(1.0, 1, 0.5);
  auto other = good;
  other.error.conservativeResize(17, 12);
  EXPECT_THROW(axis_lines(other), std::invalid_argument);
  other = good;
  other.error(3, 3) = std::nan("");
  EXPECT_THROW(slope_batch(other), std::invalid_argument);
  other = good;
  other.position.setConstant(0.3);
  EXPECT_THROW(axis_lines(other), std::invalid_argument);
  other = good;
  other.error.setZero();
  EXPECT_THROW(static_cast<void>(zero_position(std::span(&other, 1))), std::invalid_argument);
}

}  // namespace
}  // namespace thermotwin::models
