#include "thermal/geometry.h"

#include <gtest/gtest.h>

namespace thermotwin::thermal {
namespace {

/// Whichever body comes last; nodes 1 to 3 have no cell.
TEST(Geometry, CountsNodesUpToTheLastWithACell) {
  BoxCell const cell{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()};
  EXPECT_EQ(count_nodes({{"last", 4, {cell, cell}}, {"first", 0, {cell}}}), 6);
  EXPECT_EQ(count_nodes({}), 0);
}

}  // namespace
}  // namespace thermotwin::thermal
