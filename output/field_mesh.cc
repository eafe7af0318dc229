#include "output/field_mesh.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace thermotwin::output {
namespace {

using thermal::BoxCell;
using thermal::RingCell;

/// Corners as coordinates; they become numbers of shared points when the body is whole.
struct Solid {
  std::vector<Eigen::Vector3d> corners;  ///< 8 or 6
  int node;
};

class Solids {
 public:
  explicit Solids(std::vector<Solid>& into, int node) : into_(into), node_(node) {}

  void operator()(BoxCell const& box) const {
    Eigen::Matrix3d edges = box.edges;
    if (edges.determinant() < 0) edges.col(0).swap(edges.col(1));
    Eigen::Vector3d const a = edges.col(0), b = edges.col(1), c = edges.col(2), o = box.corner;
    into_.push_back({{o, o + a, o + a + b, o + b, o + c, o + a + c, o + a + b + c, o + b + c}, node_});
  }

  void operator()(RingCell const& ring) const {
    for (int k = 0; k < FieldMesh::segments; ++k) into_.push_back({segment(ring, k), node_});
  }

 private:
  static std::vector<Eigen::Vector3d> segment(RingCell const& ring, int k) {
    Eigen::Vector3d const top = ring.height * ring.axis;
    auto const inner = [&](int at) { return on_circle(ring, ring.inner_radius, at); };
    auto const outer = [&](int at) { return on_circle(ring, ring.outer_radius, at); };
    Eigen::Vector3d const a = outer(k), b = outer(k + 1);
    if (ring.inner_radius > 0) {
      Eigen::Vector3d const c = inner(k + 1), d = inner(k);
      return {d, a, b, c, d + top, a + top, b + top, c + top};
    }
    return {ring.origin, b, a, ring.origin + top, b + top, a + top};
  }

  static Eigen::Vector3d on_circle(RingCell const& ring, double radius, int k) {
    constexpr double phi = 2 * std::numbers::pi / FieldMesh::segments;
    static double const equal_area = std::sqrt(phi / std::sin(phi));
    double const angle = phi * (k % FieldMesh::segments);
    Eigen::Vector3d const x = ring.axis.unitOrthogonal();
    return ring.origin + equal_area * radius * (std::cos(angle) * x + std::sin(angle) * ring.axis.cross(x));
  }

  std::vector<Solid>& into_;
  int node_;
};

/// Numbers the values so that those within a nanometre share a number.
std::vector<int> numbered(std::vector<double> const& values) {
  constexpr double same = 1e-9;
  std::vector<int> order(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  auto const value = [&](int i) { return values[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return value(a) < value(b); });
  std::vector<int> numbers(values.size());
  int number = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && value(order[i]) - value(order[i - 1]) > same) ++number;
    numbers[static_cast<std::size_t>(order[i])] = number;
  }
  return numbers;
}

/// For each corner the number of its point, counted from 0 in the order of first use.
std::vector<int> shared_points(std::vector<Eigen::Vector3d> const& corners) {
  std::array<std::vector<int>, 3> numbers;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (auto const& corner : corners) values.push_back(corner[axis]);
    numbers[static_cast<std::size_t>(axis)] = numbered(values);
  }
  std::map<std::array<int, 3>, int> known;
  std::vector<int> points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    auto const next = static_cast<int>(known.size());
    points.push_back(known.try_emplace({numbers[0][i], numbers[1][i], numbers[2][i]}, next).first->second);
  }
  return points;
}

/// The pseudo-inverse; directions in which nothing extends give 0.
Eigen::Matrix3d inverse_where_possible(Eigen::Matrix3d const& symmetric) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> const solver(symmetric);
  double const threshold = 1e-10 * solver.eigenvalues().maxCoeff();
  Eigen::Vector3d inverse = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    if (solver.eigenvalues()[i] > threshold) inverse[i] = 1 / solver.eigenvalues()[i];
  return solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

FieldMesh::FieldMesh(thermal::Geometry const& geometry)
    : points_(3, 0),
      node_volumes_(Eigen::VectorXd::Zero(thermal::count_nodes(geometry))),
      node_centres_(Eigen::Matrix3Xd::Zero(3, thermal::count_nodes(geometry))),
      neighbours_(static_cast<std::size_t>(thermal::count_nodes(geometry))) {
  for (auto const& body : geometry) {
    add_body(body, static_cast<int>(body_names_.size()));
    body_names_.push_back(body.name);
  }
}

void FieldMesh::add_body(thermal::BodyGeometry const& body, int number) {
  std::vector<Solid> solids;
  int node = body.first_node;
  for (auto const& cell : body.cells) {
    std::visit(Solids(solids, node), cell);
    node_volumes_[node] = thermal::volume(cell);
    node_centres_.col(node) = thermal::centre(cell);
    ++node;
  }
  std::vector<Eigen::Vector3d> corners;
  for (auto const& solid : solids) corners.insert(corners.end(), solid.corners.begin(), solid.corners.end());
  auto const numbers = shared_points(corners);
  auto const first_point = static_cast<int>(points_.cols());
  int const n_new = numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end()) + 1;
  points_.conservativeResize(3, first_point + n_new);
  for (std::size_t i = 0; i < corners.size(); ++i) points_.col(first_point + numbers[i]) = corners[i];

  auto const first_element = elements_.size();
  std::size_t at = 0;
  for (auto const& solid : solids) {
    Element element{{}, static_cast<int>(solid.corners.size()), solid.node, number};
    for (std::size_t i = 0; i < solid.corners.size(); ++i) element.corners[i] = first_point + numbers[at++];
    elements_.push_back(element);
  }
  find_neighbours(first_element);
}

void FieldMesh::find_neighbours(std::size_t first_element) {
  std::map<int, std::set<int>> nodes_at;
  auto const each_corner = [&](auto const& act) {
    for (auto element = elements_.begin() + static_cast<std::ptrdiff_t>(first_element); element != elements_.end();
         ++element)
      for (int i = 0; i < element->n_corners; ++i) act(element->corners[static_cast<std::size_t>(i)], element->node);
  };
  each_corner([&](int point, int node) { nodes_at[point].insert(node); });
  std::map<int, std::set<int>> touching;
  each_corner([&](int point, int node) { touching[node].insert(nodes_at[point].begin(), nodes_at[point].end()); });
  for (auto const& touch : touching) {
    int const node = touch.first;
    auto const& others = touch.second;
    Eigen::Matrix3d extent = Eigen::Matrix3d::Zero();
    auto const offset = [&](int other) -> Eigen::Vector3d {
      return node_centres_.col(other) - node_centres_.col(node);
    };
    for (int const other : others) extent += offset(other) * offset(other).transpose();
    Eigen::Matrix3d const inverse = inverse_where_possible(extent);
    auto& neighbours = neighbours_[static_cast<std::size_t>(node)];
    for (int const other : others)
      if (other != node) neighbours.push_back({other, inverse * offset(other)});
  }
}

Eigen::VectorXd FieldMesh::mean_at_points(Eigen::VectorXd const& of_nodes) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(points_.cols());
  Eigen::VectorXd count = Eigen::VectorXd::Zero(points_.cols());
  for (auto const& element : elements_)
    for (int i = 0; i < element.n_corners; ++i) {
      int const point = element.corners[static_cast<std::size_t>(i)];
      sum[point] += of_nodes[element.node];
      count[point] += 1;
    }
  return sum.cwiseQuotient(count);
}

Eigen::Matrix3Xd FieldMesh::continued_to_points(Eigen::Matrix3Xd const& of_nodes) const {
  std::vector<Eigen::Matrix3d> gradients(neighbours_.size(), Eigen::Matrix3d::Zero());
  for (std::size_t node = 0; node < neighbours_.size(); ++node)
    for (auto const& [other, weight] : neighbours_[node])
      gradients[node] += (of_nodes.col(other) - of_nodes.col(static_cast<Eigen::Index>(node))) * weight.transpose();

  Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, points_.cols());
  Eigen::RowVectorXd count = Eigen::RowVectorXd::Zero(points_.cols());
  for (auto const& element : elements_)
    for (int i = 0; i < element.n_corners; ++i) {
      int const point = element.corners[static_cast<std::size_t>(i)];
      Eigen::Vector3d const from_centre = points_.col(point) - node_centres_.col(element.node);
      sum.col(point) += of_nodes.col(element.node) + gradients[static_cast<std::size_t>(element.node)] * from_centre;
      count[point] += 1;
    }
  return sum.array().rowwise() / count.array();
}

}  // namespace thermotwin::output
