#include "output/label_places.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace thermotwin::output {
namespace {

using Box = Eigen::AlignedBox2d;

constexpr double radius = 9.0;
Eigen::Vector2d const page(1600.0, 1000.0), size(34.0, 24.0);

TEST(LabelPlaces, OfADotAloneIsBesideIt) {
  auto const places = label_places({{{800.0, 500.0}, size}}, radius, page);
  ASSERT_EQ(places.size(), 1U);
  EXPECT_GT(places[0].x(), 800.0 + radius);
  EXPECT_LT(places[0].x(), 800.0 + 3 * radius);
  EXPECT_LT(std::abs(places[0].y() + 12.0 - 500.0), 15.0);
}

TEST(LabelPlaces, CoverNeitherOneAnotherNorADot) {
  std::vector<Label> labels;
  for (int i = 0; i < 8; ++i) labels.push_back({{800.0, 500.0 + 7.0 * i}, size});
  auto const places = label_places(labels, radius, page);
  for (std::size_t i = 0; i < places.size(); ++i) {
    Box const box(places[i], places[i] + size);
    EXPECT_LT((box.center() - labels[i].dot).norm(), 150.0) << i;
    for (std::size_t j = 0; j < places.size(); ++j) {
      bool const apart = i == j || box.intersection(Box(places[j], places[j] + size)).isEmpty();
      EXPECT_TRUE(apart) << i << ", " << j;
      EXPECT_FALSE(box.contains(labels[j].dot)) << i << ", " << j;
    }
  }
}

TEST(LabelPlaces, StayOnThePage) {
  for (Eigen::Vector2d const& dot : {Eigen::Vector2d(2.0, 2.0), Eigen::Vector2d(1598.0, 998.0)}) {
    auto const place = label_places({{dot, size}}, radius, page)[0];
    EXPECT_TRUE(Box(Eigen::Vector2d::Zero(), page).contains(Box(place, place + size)));
  }
}

}  // namespace
}  // namespace thermotwin::output
