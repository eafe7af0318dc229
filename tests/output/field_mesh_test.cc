#include "output/field_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/output/example_geometry.h"

namespace thermotwin::output {
namespace {

using testing::ElementsAre;
using tests::block;
using tests::cylinder;
using thermal::BoxCell;
using thermal::Geometry;
using thermal::RingCell;

Eigen::Vector3d const origin = Eigen::Vector3d::Zero();
Eigen::Vector3d const oblique = Eigen::Vector3d(1, 2, 2) / 3.0;

TEST(FieldMesh, SharesPointsWithinABodyOnly) {
  // 0.1 m cells at multiples of 0.1 do not meet exactly in floating point.
  Geometry const geometry = {block("a", 0, origin, {0.7, 0.3, 0.3}, {7, 3, 3}),
                             block("b", 63, {0.7, 0, 0}, {0.1, 0.3, 0.3}, {1, 3, 3})};
  FieldMesh const mesh(geometry);
  EXPECT_EQ(mesh.points().cols(), 8 * 4 * 4 + 2 * 4 * 4);
  EXPECT_EQ(mesh.elements().size(), 72u);
  EXPECT_EQ(mesh.n_nodes(), 72);
  EXPECT_EQ(mesh.elements()[70].node, 70);
  EXPECT_EQ(mesh.elements()[70].body, 1);
  EXPECT_THAT(mesh.body_names(), ElementsAre("a", "b"));
}

TEST(FieldMesh, SharesTheCirclesOfRings) {
  FieldMesh const hollow({cylinder("h", 0, {origin, oblique, 0.3, 0.05, 0.11}, 3, 2)});
  EXPECT_EQ(hollow.points().cols(), 4 * 3 * FieldMesh::segments);
  EXPECT_EQ(hollow.elements().size(), 6u * FieldMesh::segments);
  FieldMesh const solid({cylinder("s", 0, {origin, oblique, 0.3, 0.0, 0.11}, 3, 1)});
  EXPECT_EQ(solid.points().cols(), 4 * (1 + FieldMesh::segments));
  EXPECT_EQ(solid.elements()[0].n_corners, 6);
}

TEST(FieldMesh, KeepsNodesThatHaveNoCellApart) {
  FieldMesh const mesh({block("a", 3, origin, {1, 1, 1}, {1, 1, 1})});
  EXPECT_EQ(mesh.n_nodes(), 4);
  EXPECT_EQ(mesh.node_volumes()[0], 0.0);
  EXPECT_DOUBLE_EQ(mesh.node_volumes()[3], 1.0);
}

Eigen::Matrix3Xd linear_field(Eigen::Matrix3Xd const& points) {
  Eigen::Matrix3d gradient;
  gradient << 1e-5, 2e-6, 0, -3e-6, 2e-5, 4e-6, 5e-6, 0, -1e-5;
  return (gradient * points).colwise() + Eigen::Vector3d(1e-6, 2e-6, 3e-6);
}

TEST(FieldMesh, ContinuesLinearFieldsExactlyToTheSurface) {
  BoxCell skew{origin, Eigen::Matrix3d{{0.1, 0.02, 0}, {0, 0.2, 0.01}, {0.01, 0, 0.3}}};
  thermal::BodyGeometry body{"skew", 0, {}};
  for (int i = 0; i < 27; ++i) {
    skew.corner = skew.edges * Eigen::Vector3i(i % 3, i / 3 % 3, i / 9).cast<double>();
    body.cells.push_back(skew);
  }
  FieldMesh const mesh({body});
  Eigen::Matrix3Xd const found = mesh.continued_to_points(linear_field(tests::centres({body})));
  EXPECT_LT((found - linear_field(mesh.points())).cwiseAbs().maxCoeff(), 1e-18);
}

TEST(FieldMesh, ContinuesAShaftAlongItsAxis) {
  RingCell const whole{{0.1, 0.2, 0.3}, oblique, 0.5, 0.0, 0.03};
  Geometry const geometry = {cylinder("shaft", 0, whole, 5, 2)};
  FieldMesh const mesh(geometry);
  auto const growth = [&](Eigen::Matrix3Xd const& points) -> Eigen::Matrix3Xd {
    return 1e-5 * oblique * (oblique.transpose() * (points.colwise() - whole.origin));
  };
  Eigen::Matrix3Xd const found = mesh.continued_to_points(growth(tests::centres(geometry)));
  EXPECT_LT((found - growth(mesh.points())).cwiseAbs().maxCoeff(), 1e-18);
}

TEST(FieldMesh, MovesALumpAsAWhole) {
  FieldMesh const mesh({block("lump", 0, origin, {1, 1, 1}, {1, 1, 1})});
  Eigen::Vector3d const shift(1e-6, -2e-6, 3e-6);
  EXPECT_EQ(mesh.continued_to_points(shift), shift.replicate(1, 8));
}

TEST(FieldMesh, MeansStayBetweenTheNodes) {
  FieldMesh const mesh({block("bar", 0, origin, {2, 1, 1}, {2, 1, 1})});
  Eigen::VectorXd const at_points = mesh.mean_at_points(Eigen::Vector2d(20.0, 30.0));
  for (Eigen::Index i = 0; i < at_points.size(); ++i) EXPECT_DOUBLE_EQ(at_points[i], 20.0 + 5.0 * mesh.points()(0, i));
}

}  // namespace
}  // namespace thermotwin::output
