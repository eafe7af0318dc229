#include "output/surface.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <set>

#include "tests/output/example_geometry.h"

namespace thermotwin::output {
namespace {

using tests::block;
using tests::cylinder;

Eigen::Vector3d corner(FieldMesh const& mesh, Surface const& surface, int point) {
  return mesh.points().col(surface.points[std::size_t(point)]);
}

/// Gauss: the volume inside is Σ (a × b) · c / 6 over the triangles, if they are closed and turned outwards.
double enclosed_volume(FieldMesh const& mesh, Surface const& surface, Surface::Extent const& body) {
  double sum = 0.0;
  for (int t = body.first_triangle; t < body.first_triangle + body.triangles; ++t) {
    auto const& [a, b, c] = surface.triangles[std::size_t(t)];
    sum += corner(mesh, surface, a).cross(corner(mesh, surface, b)).dot(corner(mesh, surface, c)) / 6.0;
  }
  return sum;
}

TEST(Surface, OfABlockHasNothingFromInside) {
  FieldMesh const mesh({block("block", 0, {0.1, 0.2, 0.3}, {1.0, 2.0, 3.0}, {2, 3, 4})});
  auto const surface = surface_of(mesh);
  EXPECT_EQ(surface.triangles.size(), 2u * 2u * (2 * 3 + 3 * 4 + 4 * 2));
  EXPECT_EQ(surface.points.size(), std::size_t(3 * 4 * 5 - 1 * 2 * 3));
  EXPECT_EQ(surface.edges.size(), std::size_t(4 * (2 + 3 + 4)));
  EXPECT_NEAR(enclosed_volume(mesh, surface, surface.bodies[0]), 6.0, 1e-12);
}

TEST(Surface, OfARingIsClosedAndHasFourRims) {
  thermal::RingCell const whole{{0.0, 0.0, 0.1}, Eigen::Vector3d::UnitX(), 0.5, 0.05, 0.1};
  FieldMesh const mesh({cylinder("ring", 0, whole, 5, 3)});
  auto const surface = surface_of(mesh);
  EXPECT_EQ(surface.edges.size(), std::size_t(4 * FieldMesh::segments));
  EXPECT_NEAR(enclosed_volume(mesh, surface, surface.bodies[0]), thermal::volume(whole), 1e-12);
}

TEST(Surface, OfASolidCylinderIsClosed) {
  thermal::RingCell const whole{{0.0, 0.0, 0.0}, Eigen::Vector3d::UnitZ(), 0.5, 0.0, 0.1};
  FieldMesh const mesh({cylinder("bar", 0, whole, 4, 2)});
  auto const surface = surface_of(mesh);
  EXPECT_EQ(surface.edges.size(), std::size_t(2 * FieldMesh::segments));
  EXPECT_NEAR(enclosed_volume(mesh, surface, surface.bodies[0]), thermal::volume(whole), 1e-12);
}

TEST(Surface, KeepsBodiesApartAndInOrder) {
  auto const geometry = tests::machine();
  FieldMesh const mesh(geometry);
  auto const surface = surface_of(mesh);
  ASSERT_EQ(surface.bodies.size(), geometry.size());
  int point = 0, triangle = 0, edge = 0;
  for (std::size_t b = 0; b < geometry.size(); ++b) {
    auto const& body = surface.bodies[b];
    EXPECT_EQ(body.first_point, point);
    EXPECT_EQ(body.first_triangle, triangle);
    EXPECT_EQ(body.first_edge, edge);
    for (int t = 0; t < body.triangles; ++t)
      for (int const p : surface.triangles[std::size_t(triangle + t)]) {
        EXPECT_GE(p, point);
        EXPECT_LT(p, point + body.points);
      }
    double volume = 0.0;
    for (auto const& cell : geometry[b].cells) volume += thermal::volume(cell);
    EXPECT_NEAR(enclosed_volume(mesh, surface, body), volume, 1e-9) << geometry[b].name;
    point += body.points;
    triangle += body.triangles;
    edge += body.edges;
  }
  EXPECT_EQ(std::set<int>(surface.points.begin(), surface.points.end()).size(), surface.points.size());
}

}  // namespace
}  // namespace thermotwin::output
