#include "twin/campaign/latin_hypercube.h"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <set>

namespace thermotwin::twin {
namespace {

TEST(LatinHypercube, HoldsOneSampleInEachStripOfEachDimension) {
  for (std::int64_t count : {1, 2, 3, 5, 16, 17, 1000})
    for (auto const* name : {"a", "b"}) {
      std::set<std::int64_t> strips;
      for (std::int64_t k = 0; k < count; ++k) {
        double const x = latin_hypercube(k, count, 3, name);
        ASSERT_TRUE(x >= 0.0 && x < 1.0);
        strips.insert(std::int64_t(x * double(count)));
      }
      EXPECT_EQ(std::int64_t(strips.size()), count);
    }
}

/// Uncorrelated: the sample correlation of two dimensions of n samples has deviation 1/sqrt(n).
TEST(LatinHypercube, DimensionsAndSeedsHaveNothingInCommon) {
  constexpr std::int64_t count = 4000;
  auto const correlation = [](auto const& a, auto const& b) {
    double sum = 0.0;
    for (std::int64_t k = 0; k < count; ++k) sum += (a(k) - 0.5) * (b(k) - 0.5);
    return 12.0 * sum / double(count);
  };
  auto const x = [](std::int64_t k) { return latin_hypercube(k, count, 1, "x"); };
  EXPECT_NEAR(correlation(x, x), 1.0, 0.01);
  EXPECT_NEAR(correlation(x, [](auto k) { return latin_hypercube(k, count, 1, "y"); }), 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(correlation(x, [](auto k) { return latin_hypercube(k, count, 2, "x"); }), 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(correlation(x, [&](auto k) { return x((k + 1) % count); }), 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(correlation(x, [](auto k) { return double(k) / count; }), 0.0, 4.0 / std::sqrt(count));
}

}  // namespace
}  // namespace thermotwin::twin
