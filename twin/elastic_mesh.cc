#include "twin/elastic_mesh.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace thermotwin::twin {
namespace {

using Eigen::Vector3d;

/// Where the nodes of an element are, in halves of a cell.
constexpr int offsets[20][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
                                {0, 2, 2}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2},
                                {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};

/// Shape function of a node of the brick at ξ ∈ [−1, 1]³ (Zienkiewicz & Taylor, The Finite Element Method,
/// serendipity).
double shape(int node, Vector3d const& xi) {
  double product = 1.0, sum = -2.0, middle = 1.0;
  for (int d = 0; d < 3; ++d) {
    double const at = offsets[node][d] - 1.0;
    if (at == 0.0)
      middle = 1.0 - xi[d] * xi[d];
    else
      product *= 0.5 * (1.0 + at * xi[d]);
    sum += at * xi[d];
  }
  return node < 8 ? product * sum : product * middle;
}

double position(std::vector<double> const& edges, int half_steps) {
  auto const cell = std::size_t(half_steps / 2);
  return half_steps % 2 ? 0.5 * (edges[cell] + edges[cell + 1]) : edges[cell];
}

/// Three-point Gauss rule over a rectangle: calls visit(point, area).
template <class Visit>
void integrate(Eigen::AlignedBox3d const& rectangle, Visit visit) {
  constexpr double places[3] = {-0.7745966692414834, 0.0, 0.7745966692414834};
  constexpr double shares[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  Vector3d const size = rectangle.sizes();
  Eigen::Index normal = 0;
  size.minCoeff(&normal);
  Eigen::Index const u = (normal + 1) % 3, v = (normal + 2) % 3;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Vector3d point = rectangle.center();
      point[u] += 0.5 * places[i] * size[u];
      point[v] += 0.5 * places[j] * size[v];
      visit(point, shares[i] * shares[j] * size[u] * size[v]);
    }
}

}  // namespace

ElasticMesh::ElasticMesh(thermal::Body const& block) : corner_(block.origin), edges_(block.edges) {
  for (int cell = 0; cell < block.nodes(); ++cell) {
    auto const place = place_of(cell);
    auto& element = elements_.emplace_back();
    for (int a = 0; a < 20; ++a) {
      std::array<int, 3> half{};
      for (std::size_t d = 0; d < 3; ++d) half[d] = 2 * place[d] + offsets[a][d];
      element[std::size_t(a)] = node(half);
      nodes_[node(half)] = {position(edges_[0], half[0]), position(edges_[1], half[1]), position(edges_[2], half[2])};
    }
  }
}

std::array<int, 3> ElasticMesh::place_of(int cell) const {
  int const nx = int(edges_[0].size()) - 1, ny = int(edges_[1].size()) - 1;
  return {cell % nx, cell / nx % ny, cell / nx / ny};
}

int ElasticMesh::node(std::array<int, 3> const& half) const {
  int const nx = 2 * int(edges_[0].size()) - 1, ny = 2 * int(edges_[1].size()) - 1;
  return 1 + half[0] + nx * (half[1] + ny * half[2]);
}

std::array<int, 3> ElasticMesh::corners() const {
  int const x = 2 * (int(edges_[0].size()) - 1), y = 2 * (int(edges_[1].size()) - 1);
  return {node({0, 0, 0}), node({x, 0, 0}), node({0, y, 0})};
}

void ElasticMesh::add_traction(std::map<int, Vector3d>& forces, thermal::Site const& face,
                               Load const& at_centre) const {
  Vector3d const centre = centre_of(face);
  Vector3d const mean = at_centre.head<3>() / face.area();
  Vector3d const turn = second_moment(face).inverse() * at_centre.tail<3>();
  for (auto const& contact : face.contacts) {
    auto const& element = elements_[std::size_t(contact.node)];
    Vector3d const low = nodes_.at(element[0]), high = nodes_.at(element[6]);
    integrate(contact.box, [&](Vector3d const& point, double area) {
      Vector3d const force = area * (mean + turn.cross(point - centre));
      Vector3d const xi = 2.0 * (point - corner_ - low).cwiseQuotient(high - low) - Vector3d::Ones();
      for (int a = 0; a < 20; ++a)
        if (double const n = shape(a, xi); std::abs(n) > 1e-12)
          forces.try_emplace(element[std::size_t(a)], Vector3d::Zero()).first->second += n * force;
    });
  }
}

std::map<int, Vector3d> ElasticMesh::forces(ElasticBlock const& block, Load const& load) const {
  std::map<int, Vector3d> result;
  add_traction(result, block.loaded, load);
  Load reaction = -load;
  Vector3d const force = load.head<3>();
  reaction.tail<3>() -= (centre_of(block.loaded) - centre_of(block.fixed)).cross(force);
  add_traction(result, block.fixed, reaction);
  return result;
}

}  // namespace thermotwin::twin
