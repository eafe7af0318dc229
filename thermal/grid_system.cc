#include "thermal/grid_system.h"

#include <algorithm>
#include <cmath>

#include "thermal/fixed_blocks.h"

namespace thermotwin::thermal {
namespace {

constexpr std::size_t most_directions = 30;  ///< of one reduction
constexpr double single_reduction = 1e-4;    ///< what one reduction in single precision is asked for at most
constexpr int most_reductions = 8;

double norm(double const* x, int n) {
  return std::sqrt(sum_of_terms(n, [x](std::ptrdiff_t i) { return x[i] * x[i]; }));
}

double dot(float const* a, float const* b, int n) {
  return sum_of_terms(n, [a, b](std::ptrdiff_t i) { return double(a[i]) * double(b[i]); });
}

}  // namespace

GridSystem::GridSystem(Network const& network)
    : network_(&network),
      nodes_(network.nodes()),
      port_temperature_(network.averages().size()),
      port_heat_(network.averages().size()) {
  for (double const c : network.capacity()) {
    capacity_.push_back(float(c));
    inverse_capacity_.push_back(float(1.0 / c));
  }
  scaled_.resize(std::size_t(nodes_));
  residual_.resize(std::size_t(nodes_));
}

void GridSystem::linearise(Linearisation const& at) {
  auto const n = std::size_t(nodes_);
  int const first_average = nodes_ + int(network_->boundaries().size());
  ConductionLevel level;
  level.grids = network_->grids();
  level.capacity.resize(n);
  level.outside.resize(n);
  for (auto& links : level.g) links.resize(n);
  level.average_couplings.resize(network_->averages().size());
  for (std::size_t i = 0; i < n; ++i) level.capacity[i] = float(network_->capacity()[i] / at.slope[Eigen::Index(i)]);
  for (std::size_t a = 0; a < network_->averages().size(); ++a) {
    auto& average = level.averages.emplace_back();
    auto const& nodes = network_->averages()[a].nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) average.emplace_back(nodes[i], float(at.weights[a][i]));
  }
  couplings_.clear();
  auto const port = [&](int index) { return index < nodes_ ? index : index - first_average + nodes_; };
  for (auto const& grid : level.grids)
    for (int column = grid.first; column < grid.end(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator it(at.coupling, column); it; ++it) {
        int const row = int(it.row()), from = std::min(row, column), offset = std::abs(row - column);
        int const d = row < grid.end() && from >= grid.first ? grid.direction(from, offset) : -1;
        if (offset == 0) {
          level.outside[std::size_t(row)] -= float(it.value());
        } else if (d >= 0) {
          level.g[std::size_t(d)][std::size_t(from)] += float(0.5 * it.value());
          level.outside[std::size_t(column)] -= float(it.value());
        } else if (row < nodes_ || row >= first_average) {
          couplings_.push_back({port(row), column, it.value()});
        }
      }
  for (std::size_t a = 0; a < level.averages.size(); ++a)
    for (Eigen::SparseMatrix<double>::InnerIterator it(at.coupling, first_average + int(a)); it; ++it) {
      int const row = int(it.row());
      if (row == first_average + int(a)) level.average_couplings[a] = float(-it.value());
      if (row < nodes_ || row >= first_average) couplings_.push_back({port(row), nodes_ + int(a), it.value()});
    }
  bool const straight = (at.slope.array() == 1.0).all();
  slope_.resize(straight ? 0 : n);
  for (std::size_t i = 0; i < slope_.size(); ++i) slope_[i] = float(at.slope[Eigen::Index(i)]);
  multigrid_.set(std::move(level), couplings_);
  gamma_ = -1.0;
}

bool GridSystem::shift(double identity, double gamma) {
  if (identity == identity_ && gamma == gamma_) return true;
  identity_ = identity;
  gamma_ = gamma;
  return multigrid_.shift(identity, gamma);
}

/// result = C⁻¹ (s C dy/dT − γ SᵀGS) temperature.
template <class X>
void GridSystem::multiply(X const* temperature, X* result) {
  multigrid_.multiply(temperature, result);
  auto const& averages = multigrid_.finest().averages;
  for (std::size_t a = 0; a < averages.size(); ++a) {
    double mean = 0.0;
    for (auto const& [node, weight] : averages[a]) mean += double(weight) * double(temperature[node]);
    port_temperature_[a] = mean;
    port_heat_[a] = 0.0;
  }
  for (auto const& [into, of, value] : couplings_) {
    double const heat = value * (of < nodes_ ? double(temperature[of]) : port_temperature_[std::size_t(of - nodes_)]);
    if (into < nodes_)
      result[into] -= X(gamma_ * heat);
    else
      port_heat_[std::size_t(into - nodes_)] += heat;
  }
  for (std::size_t a = 0; a < averages.size(); ++a)
    for (auto const& [node, weight] : averages[a]) result[node] -= X(gamma_ * double(weight) * port_heat_[a]);
  for_terms(nodes_, [result, inverse = inverse_capacity_.data()](std::ptrdiff_t i) { result[i] *= X(inverse[i]); });
}

/// Makes the newest direction orthonormal to the `count` before it; `column` receives the coefficients and the length
/// that it had.
void GridSystem::orthogonalise(std::size_t count, std::vector<double>& column) {
  float* newest = basis_[count].data();
  column.assign(count + 1, 0.0);
  for (std::size_t k = 0; k < count; ++k) column[k] = dot(newest, basis_[k].data(), nodes_);
  double const square = sum_of_blocks(nodes_, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (std::size_t k = 0; k < count; ++k) {
      float const* other = basis_[k].data();
      auto const share = float(column[k]);
#pragma omp simd
      for (auto i = begin; i < end; ++i) newest[i] -= share * other[i];
    }
    return sum_within(begin, end, [newest](std::ptrdiff_t i) { return double(newest[i]) * double(newest[i]); });
  });
  column[count] = std::sqrt(square);
  auto const inverse = float(1.0 / std::max(column[count], 1e-300));
  for_terms(nodes_, [newest, inverse](std::ptrdiff_t i) { newest[i] *= inverse; });
}

/// Adds to x what brings the norm of `residual` from `size` below `target`, or as far as single precision and the
/// number of directions allow; returns the norm that it comes to.
double GridSystem::reduce(double const* residual, double size, double target, double* x) {
  auto const direction = [&](std::vector<std::vector<float>>& set, std::size_t k) {
    while (set.size() <= k) set.emplace_back(std::size_t(nodes_));
    return set[k].data();
  };
  float* first = direction(basis_, 0);
  for_terms(nodes_, [first, residual, share = 1.0 / size](std::ptrdiff_t i) { first[i] = float(share * residual[i]); });
  std::vector<std::vector<double>> triangle;
  std::vector<double> right{size}, cosine, sine, column;
  std::size_t count = 0;
  while (count < most_directions && std::abs(right[count]) > std::max(target, single_reduction * size)) {
    float const* from = basis_[count].data();
    float* z = direction(preconditioned_, count);
    for_terms(nodes_, [from, scaled = scaled_.data(), capacity = capacity_.data()](std::ptrdiff_t i) {
      scaled[i] = capacity[i] * from[i];
    });
    multigrid_.solve(scaled_.data(), z);
    multiply(z, direction(basis_, count + 1));
    orthogonalise(count + 1, column);
    for (std::size_t k = 0; k < count; ++k) {
      double const upper = cosine[k] * column[k] + sine[k] * column[k + 1];
      column[k + 1] = cosine[k] * column[k + 1] - sine[k] * column[k];
      column[k] = upper;
    }
    double const radius = std::hypot(column[count], column[count + 1]);
    if (!(radius > 0.0) || !std::isfinite(radius)) return size;
    cosine.push_back(column[count] / radius);
    sine.push_back(column[count + 1] / radius);
    column[count] = radius;
    right.push_back(-sine[count] * right[count]);
    right[count] *= cosine[count];
    triangle.push_back(column);
    ++count;
  }
  std::vector<double> share(count);
  for (std::size_t k = count; k-- > 0;) {
    double sum = right[k];
    for (std::size_t m = k + 1; m < count; ++m) sum -= triangle[m][k] * share[m];
    share[k] = sum / triangle[k][k];
  }
  for_blocks(nodes_, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (std::size_t k = 0; k < count; ++k) {
      float const* along = preconditioned_[k].data();
      double const part = share[k];
#pragma omp simd
      for (auto i = begin; i < end; ++i) x[i] += part * double(along[i]);
    }
  });
  return std::abs(right[count]);
}

bool GridSystem::solve(double const* b, double tolerance, double* x) {
  double const size = norm(b, nodes_);
  if (size == 0.0) return std::fill_n(x, nodes_, 0.0), true;
  double const target = std::min(tolerance, 0.1 * size);
  for_terms(nodes_, [x](std::ptrdiff_t i) { x[i] = 0.0; });
  double left = size;
  for (int k = 0; left > target; ++k) {
    bool const enough = target >= single_reduction * left;
    double const reached = reduce(k == 0 ? b : residual_.data(), left, target, x);
    if (k == most_reductions || !(reached < 0.5 * left)) return false;
    left = reached;
    if (enough && left <= target) break;
    multiply(x, residual_.data());
    for_terms(nodes_, [b, residual = residual_.data()](std::ptrdiff_t i) { residual[i] = b[i] - residual[i]; });
    left = norm(residual_.data(), nodes_);
  }
  for_terms(std::ptrdiff_t(slope_.size()), [x, slope = slope_.data()](std::ptrdiff_t i) { x[i] /= double(slope[i]); });
  return true;
}

}  // namespace thermotwin::thermal
