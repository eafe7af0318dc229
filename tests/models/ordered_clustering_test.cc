#include "models/ordered_clustering.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "tests/models/planted_noise.h"

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::ElementsAre;
using Classes = std::vector<std::vector<Index>>;

MatrixXd child_growth() {
  return (MatrixXd(11, 1) << 9.3, 1.8, 1.9, 1.7, 1.5, 1.3, 1.4, 2.0, 1.9, 2.3, 2.1).finished();
}

std::vector<Index> begins(Classes const& classes) {
  std::vector<Index> result;
  for (auto const& members : classes) result.push_back(members.front() + 1);
  return result;
}

/// ψ*(k) over all 2^(l−1) ways to cut l objects in a row.
VectorXd by_brute_force(MatrixXd const& diameters) {
  Index const count = diameters.rows();
  VectorXd least = VectorXd::Constant(count, std::numeric_limits<double>::infinity());
  for (unsigned cuts = 0; cuts < 1U << (count - 1); ++cuts) {
    double sum = 0;
    Index classes = 0, begin = 0;
    for (Index i = 0; i < count; ++i)
      if (i == count - 1 || (cuts >> i & 1U) != 0) {
        sum += diameters(begin, i);
        begin = i + 1;
        ++classes;
      }
    least(classes - 1) = std::min(least(classes - 1), sum);
  }
  return least;
}

double loss_of(Classes const& classes, MatrixXd const& diameters) {
  double sum = 0;
  for (auto const& members : classes) sum += diameters(members.front(), members.back());
  return sum;
}

TEST(OrderedClustering, GoldenLossesAndPartitions) {
  OrderedPartitions const partitions(class_diameters(child_growth()));
  std::vector<double> const golden{52.182, 0.909, 0.367, 0.127, 0.065, 0.045, 0.030, 0.015, 0.010, 0.005, 0};
  for (std::size_t i = 0; i < golden.size(); ++i)
    EXPECT_NEAR(partitions.loss()(static_cast<Index>(i)), golden[i], 0.0005 + 1e-9);
  EXPECT_THAT(begins(partitions.classes(1)), ElementsAre(1));
  EXPECT_THAT(begins(partitions.classes(2)), ElementsAre(1, 2));
  EXPECT_THAT(begins(partitions.classes(3)), ElementsAre(1, 2, 8));
  EXPECT_THAT(begins(partitions.classes(4)), ElementsAre(1, 2, 5, 8));
}

TEST(OrderedClustering, DiametersAreTheSumsOfSquares) {
  Noise noise(2);
  MatrixXd const objects = noise.series(21).reshaped(7, 3);
  MatrixXd const diameters = class_diameters(objects);
  for (Index a = 0; a < 7; ++a)
    for (Index c = a; c < 7; ++c) {
      auto const part = objects.middleRows(a, c - a + 1);
      EXPECT_NEAR(diameters(a, c), (part.rowwise() - part.colwise().mean()).squaredNorm(), 1e-13);
    }
}

TEST(OrderedClustering, EqualsBruteForceUpToTwelveObjects) {
  for (Index count = 1; count <= 12; ++count) {
    Noise noise(static_cast<std::uint64_t>(count));
    MatrixXd const diameters = class_diameters(noise.series(4 * count).reshaped(count, 4));
    OrderedPartitions const partitions(diameters);
    VectorXd const least = by_brute_force(diameters);
    for (int k = 1; k <= count; ++k) {
      EXPECT_NEAR(partitions.loss()(k - 1), least(k - 1), 1e-12);
      EXPECT_EQ(partitions.classes(k).size(), static_cast<std::size_t>(k));
      EXPECT_NEAR(loss_of(partitions.classes(k), diameters), least(k - 1), 1e-12);
    }
  }
}

TEST(OrderedClustering, OfEqualSumsTheSmallestBeginCounts) {
  MatrixXd const same = MatrixXd::Ones(4, 2), steps = (MatrixXd(3, 1) << 0, 1, 2).finished();
  EXPECT_THAT(begins(OrderedPartitions(class_diameters(same)).classes(2)), ElementsAre(1, 2));
  EXPECT_THAT(begins(OrderedPartitions(class_diameters(steps)).classes(2)), ElementsAre(1, 2));
}

TEST(OrderedClustering, PlantedContiguousGroupsComeBack) {
  int recovered = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Noise noise(seed);
    MatrixXd rise(60, 9);  // groups of 2, 4 and 3 sensors at 2, 5 and 9 K, in an order that the columns do not show
    std::vector<double> const level{5, 2, 9, 5, 9, 5, 2, 9, 5};
    for (Index sensor = 0; sensor < 9; ++sensor)
      for (Index i = 0; i < 60; ++i)
        rise(i, sensor) = (level[static_cast<std::size_t>(sensor)] + 0.1 * static_cast<double>(sensor)) *
                              (1 - std::exp(-static_cast<double>(i) / 15)) +
                          0.3 * noise();
    auto const order = ascending(rise);
    Classes classes = OrderedPartitions(class_diameters(normalised(rise(Eigen::all, order)))).classes(3);
    for (auto& members : classes) {
      for (auto& member : members) member = order[static_cast<std::size_t>(member)];
      std::sort(members.begin(), members.end());
    }
    if (classes == Classes{{1, 6}, {0, 3, 5, 8}, {2, 4, 7}}) ++recovered;
  }
  EXPECT_GE(recovered, 95);
}

TEST(OrderedClustering, NormalisationsAreWhatTheySayAndDropInstantsWithoutRange) {
  MatrixXd const rise = (MatrixXd(3, 3) << 0, 0, 0, 1, 2, 5, 2, 6, 4).finished();  // the first row: all start at 0
  EXPECT_TRUE(normalised(rise).isApprox((MatrixXd(3, 2) << 0, 0, 0.25, 1, 1, 0.5).finished()));
  EXPECT_TRUE(normalised(rise, Normalisation::over_time).isApprox((MatrixXd(3, 2) << 0, 1, 0, 1, 1, 0).finished()));
  MatrixXd const z = normalised(rise, Normalisation::z_score);
  EXPECT_EQ(z.cols(), 2);
  EXPECT_LT(z.colwise().mean().cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_TRUE(z.colwise().squaredNorm().isApprox(Eigen::RowVector2d(3, 3)));
}

/// Six sensors of which, for 20 min, three stand at 1 K and three at 5 K, for 30 min five at 2 K and one at 10 K, and
/// in one instant two at 1.5 K and four at 20 K. Between the sensors' ranges, parting them in the middle takes 20 · 3/2
/// + 30/6 + 2/3 of the loss, parting off the hottest 20 · 3/10 + 30 · 5/6 + 1/30; over their deviations, which are
/// smaller in the 30 min, 120 + 36 + 3 and 24 + 180 + 1/7. Over time, the instant at 20 K leaves of the four nothing
/// but itself.
TEST(OrderedClustering, NormalisationsPartTheSameSensorsDifferently) {
  MatrixXd rise(51, 6);
  rise.topRows(20) = Eigen::RowVectorXd{{1, 1, 1, 5, 5, 5}}.replicate(20, 1);
  rise.middleRows(20, 30) = Eigen::RowVectorXd{{2, 2, 2, 2, 2, 10}}.replicate(30, 1);
  rise.bottomRows(1) = Eigen::RowVectorXd{{1.5, 1.5, 20, 20, 20, 20}};
  auto const parted = [&](MatrixXd const& objects) {
    return begins(OrderedPartitions(class_diameters(objects)).classes(2));
  };
  EXPECT_THAT(parted(normalised(rise)), ElementsAre(1, 4));
  EXPECT_THAT(parted(normalised(rise, Normalisation::z_score)), ElementsAre(1, 6));
  EXPECT_THAT(parted(normalised(rise, Normalisation::over_time)), ElementsAre(1, 3));
}

TEST(OrderedClustering, RefusesClassesThatCannotBe) {
  OrderedPartitions const partitions(class_diameters(child_growth()));
  EXPECT_THROW(static_cast<void>(partitions.classes(0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(partitions.classes(12)), std::invalid_argument);
  EXPECT_THROW(OrderedPartitions(MatrixXd(0, 0)), std::invalid_argument);
}

}  // namespace
}  // namespace thermotwin::models
