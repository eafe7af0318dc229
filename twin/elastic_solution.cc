#include "twin/elastic_solution.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <fmt/format.h>
#include <sstream>
#include <stdexcept>
#include <string>

#include "thermal/error.h"
#include "twin/calculix.h"
#include "twin/elastic_mesh.h"

namespace thermotwin::twin {
namespace {

/// Stresses do not depend on it; this one keeps displacements and forces at sizes that print well.
constexpr double youngs_modulus = 1e11;

struct Share {
  int index;
  double weight;
};

/// Linear interpolation between stations, straight beyond the outermost.
std::vector<Share> interpolate(std::vector<double> const& stations, double x) {
  int const n = int(stations.size());
  if (n == 1) return {{0, 1.0}};
  int left = 0;
  while (left < n - 2 && stations[std::size_t(left) + 1] < x) ++left;
  double const a = stations[std::size_t(left)], b = stations[std::size_t(left) + 1];
  double const t = (x - a) / (b - a);
  return {{left, 1.0 - t}, {left + 1, t}};
}

/// For each cell along a direction, the shares of its two Gauss points.
std::vector<std::array<std::vector<Share>, 2>> gauss_shares(std::vector<double> const& edges,
                                                            std::vector<double> const& stations) {
  std::vector<std::array<std::vector<Share>, 2>> shares;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    double const middle = 0.5 * (edges[i] + edges[i + 1]), half = 0.5 * (edges[i + 1] - edges[i]) / std::sqrt(3.0);
    shares.push_back({interpolate(stations, middle - half), interpolate(stations, middle + half)});
  }
  return shares;
}

/// Adds tr σ V of one Gauss point to the cells around it.
class CellSums {
 public:
  explicit CellSums(thermal::Body const& body) : body_(body), sums_(std::size_t(body.nodes()), 0.0) {
    for (std::size_t d = 0; d < 3; ++d) shares_[d] = gauss_shares(body.edges[d], body.stations[d]);
  }

  /// Gauss points are numbered from 0, x fastest.
  void add(int cell, int point, double trace) {
    int const nx = body_.count(0), ny = body_.count(1);
    auto const& along_x = shares_[0][std::size_t(cell % nx)][std::size_t(point % 2)];
    auto const& along_y = shares_[1][std::size_t(cell / nx % ny)][std::size_t(point / 2 % 2)];
    auto const& along_z = shares_[2][std::size_t(cell / nx / ny)][std::size_t(point / 4)];
    double const amount = trace * volume(body_.cells[std::size_t(cell)]) / 8.0;
    for (auto const& k : along_z)
      for (auto const& j : along_y)
        for (auto const& i : along_x)
          sums_[std::size_t(body_.cell(i.index, j.index, k.index))] += amount * i.weight * j.weight * k.weight;
  }
  [[nodiscard]] std::vector<double> const& sums() const { return sums_; }

 private:
  thermal::Body const& body_;
  std::array<std::vector<std::array<std::vector<Share>, 2>>, 3> shares_;
  std::vector<double> sums_;
};

std::vector<double> sum_stresses(thermal::Body const& body, std::string const& printed) {
  CellSums cells(body);
  std::istringstream lines(printed);
  int found = 0;
  for (std::string line; std::getline(lines, line);) {
    int element = 0, point = 0;
    double xx = 0.0, yy = 0.0, zz = 0.0;
    if (std::istringstream words(line); !(words >> element >> point >> xx >> yy >> zz)) continue;
    cells.add(element - 1, point - 1, xx + yy + zz);
    ++found;
  }
  if (found != 8 * body.nodes())
    throw std::runtime_error(
        fmt::format("ccx printed {} stresses for '{}'; {} are due", found, body.name, 8 * body.nodes()));
  return cells.sums();
}

/// Gauss point of a cell, numbered from 0, x fastest.
Eigen::Vector3d gauss_point(thermal::Cell const& cell, int point) {
  Eigen::Vector3d const side(point % 2 - 0.5, point / 2 % 2 - 0.5, point / 4 % 2 - 0.5);
  return centre(cell) + std::get<thermal::BoxCell>(cell).edges * side / std::sqrt(3.0);
}

void require_beam(ElasticBlock const& block) {
  Eigen::Vector3d const way = centre_of(block.loaded) - centre_of(block.fixed);
  Eigen::Vector3d const n = block.loaded.normal;
  auto const& edges = block.body.edges;
  double const length = Eigen::Vector3d(edges[0].back(), edges[1].back(), edges[2].back()).dot(n.cwiseAbs());
  double const section = edges[0].back() * edges[1].back() * edges[2].back() / length;
  double const tolerance = 1e-9 * section;
  if ((way - length * n).norm() > 1e-9 || std::abs(block.fixed.area() - section) > tolerance ||
      std::abs(block.loaded.area() - section) > tolerance)
    throw thermal::InputError(fmt::format("'{}' is no beam between {} and {}: two whole opposite faces are due",
                                          block.body.name, block.fixed.place, block.loaded.place));
}

}  // namespace

std::vector<double> solve_unit_load(ElasticBlock const& block, int load) {
  ElasticMesh const mesh(block.body);
  std::string const deck = calculix_model(mesh, youngs_modulus, block.poisson_ratio, 0.0) + "*STEP\n*STATIC\n" +
                           calculix_loads(mesh.forces(block, Load::Unit(load))) + "*EL PRINT,ELSET=ALL\nS\n*END STEP\n";
  return sum_stresses(block.body, run_calculix(deck));
}

std::vector<double> beam_solution(ElasticBlock const& block, Load const& load) {
  require_beam(block);
  Eigen::Vector3d const n = block.loaded.normal, end = centre_of(block.loaded);
  Eigen::Vector3d const force = load.head<3>(), moment = load.tail<3>();
  Eigen::Matrix3d const stiffness = second_moment(block.loaded).inverse();
  CellSums cells(block.body);
  for (int cell = 0; cell < block.body.nodes(); ++cell)
    for (int point = 0; point < 8; ++point) {
      Eigen::Vector3d const from_end = gauss_point(block.body.cells[std::size_t(cell)], point) - end;
      Eigen::Vector3d const back = from_end.dot(n) * n, across = from_end - back;
      Eigen::Vector3d const turn = stiffness * (moment - back.cross(force));
      cells.add(cell, point, n.dot(force / block.loaded.area() + turn.cross(across)));
    }
  return cells.sums();
}

}  // namespace thermotwin::twin
