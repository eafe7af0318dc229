#include "output/surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace thermotwin::output {
namespace {

using Corners = std::vector<int>;  ///< three or four, anticlockwise from outside

/// The faces of VTK's hexahedron and wedge, seen from outside.
std::vector<Corners> faces_of(Element const& element) {
  static std::vector<Corners> const hexahedron = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                  {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  static std::vector<Corners> const wedge = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  auto faces = element.n_corners == 6 ? wedge : hexahedron;
  for (auto& face : faces)
    for (int& corner : face) corner = element.corners[std::size_t(corner)];
  return faces;
}

/// Faces that no second element has, in the order in which they are met.
std::vector<Corners> outer_faces(std::vector<Element> const& elements, std::size_t first, std::size_t end) {
  std::vector<Corners> faces;
  std::map<Corners, std::optional<std::size_t>> seen;
  for (std::size_t e = first; e < end; ++e)
    for (auto& face : faces_of(elements[e])) {
      Corners key = face;
      std::sort(key.begin(), key.end());
      auto const [at, is_new] = seen.try_emplace(key, faces.size());
      if (!is_new) at->second.reset();
      faces.push_back(std::move(face));
    }
  std::vector<std::size_t> kept;
  for (auto const& [key, face] : seen)
    if (face) kept.push_back(*face);
  std::sort(kept.begin(), kept.end());
  std::vector<Corners> outer;
  for (std::size_t const face : kept) outer.push_back(faces[face]);
  return outer;
}

Eigen::Vector3d normal(Corners const& face, Eigen::Matrix3Xd const& points) {
  Eigen::Vector3d const a = points.col(face[1]) - points.col(face[0]);
  Eigen::Vector3d const b = points.col(face[2]) - points.col(face[0]);
  return a.cross(b).normalized();
}

/// Sides of faces that meet another at more than the angle, or none.
std::vector<std::array<int, 2>> sharp_edges(std::vector<Corners> const& faces, Eigen::Matrix3Xd const& points) {
  static double const least_cosine = std::cos(40.0 * std::numbers::pi / 180.0);
  std::map<std::array<int, 2>, std::vector<Eigen::Vector3d>> sides;
  for (auto const& face : faces)
    for (std::size_t i = 0; i < face.size(); ++i) {
      int const a = face[i], b = face[(i + 1) % face.size()];
      sides[{std::min(a, b), std::max(a, b)}].push_back(normal(face, points));
    }
  std::vector<std::array<int, 2>> edges;
  for (auto const& [side, normals] : sides)
    if (normals.size() != 2 || normals[0].dot(normals[1]) < least_cosine) edges.push_back(side);
  return edges;
}

}  // namespace

Surface surface_of(FieldMesh const& mesh) {
  Surface surface;
  auto const& elements = mesh.elements();
  std::size_t first = 0;
  for (int body = 0; body < int(mesh.body_names().size()); ++body) {
    std::size_t end = first;
    while (end < elements.size() && elements[end].body == body) ++end;
    auto const faces = outer_faces(elements, first, end);
    first = end;

    Surface::Extent extent{int(surface.points.size()), 0, int(surface.triangles.size()), 0,
                           int(surface.edges.size()),  0};
    std::map<int, int> numbers;
    auto const number = [&](int point) {
      auto const [at, is_new] = numbers.try_emplace(point, int(surface.points.size()));
      if (is_new) surface.points.push_back(point);
      return at->second;
    };
    for (auto const& face : faces)
      for (std::size_t i = 2; i < face.size(); ++i)
        surface.triangles.push_back({number(face[0]), number(face[i - 1]), number(face[i])});
    for (auto const& [a, b] : sharp_edges(faces, mesh.points())) surface.edges.push_back({number(a), number(b)});
    extent.points = int(surface.points.size()) - extent.first_point;
    extent.triangles = int(surface.triangles.size()) - extent.first_triangle;
    extent.edges = int(surface.edges.size()) - extent.first_edge;
    surface.bodies.push_back(extent);
  }
  return surface;
}

}  // namespace thermotwin::output
