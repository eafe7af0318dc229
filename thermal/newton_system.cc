#include "thermal/newton_system.h"

#include <algorithm>

#include "thermal/fixed_blocks.h"

namespace thermotwin::thermal {

using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

NewtonSystem::NewtonSystem(Network const& network, LinearSolver solver)
    : network_(network),
      nodes_(network.nodes()),
      averages_(int(network.averages().size())),
      capacity_(Eigen::Map<VectorXd const>(network.capacity().data(), nodes_)) {
  for (int i = 0; i < nodes_; ++i)
    if (network.signals()[std::size_t(i)]) capacity_[i] = 0.0;
  has_heat_ = (capacity_.array() > 0.0).cast<double>();
  total_capacity_ = capacity_.sum();
  unit_capacity_ = total_capacity_ / nodes_;
  if (solver == LinearSolver::multigrid) {
    grids_ = std::make_unique<GridSystem>(network);
  } else {
    factors_ = make_linear_factors(solver);
    lay_out();
  }
}

void NewtonSystem::lay_out() {
  auto const& net = network_;
  auto const& coupling = net.port_pattern();
  int const first_average = nodes_ + int(net.boundaries().size()), size = nodes_ + 2 * averages_;
  // Of a port: the row in which its heat is balanced, the column in which its temperature stands; −1 for a boundary.
  auto const column_of = [&](int port) {
    return port < nodes_ ? port : port < first_average ? -1 : nodes_ + port - first_average;
  };
  auto const row_of = [&](int port) { return port < first_average ? column_of(port) : column_of(port) + averages_; };
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < size; ++i) entries.emplace_back(i, i, 1.0);
  for (int a = 0; a < averages_; ++a) {
    int const mean = nodes_ + a, share = mean + averages_;
    entries.emplace_back(mean, share, 0.0);  // where incomplete factors keep what the nodes carry between the two
    entries.emplace_back(share, mean, 0.0);
    for (int node : net.averages()[std::size_t(a)].nodes) {
      entries.emplace_back(mean, node, 0.0);
      entries.emplace_back(node, share, 0.0);
    }
  }
  auto const for_couplings = [&](auto visit) {
    for (int port = 0; port < coupling.outerSize(); ++port)
      for (SparseMatrix::InnerIterator it(coupling, port); it; ++it) visit(row_of(int(it.row())), column_of(port));
  };
  for_couplings([&](int row, int column) {
    if (row >= 0 && column >= 0) entries.emplace_back(row, column, 0.0);
  });
  matrix_.resize(size, size);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  matrix_.makeCompressed();

  auto const slot = [&](int row, int column) {
    int const* begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
    int const* end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column + 1];
    return int(std::lower_bound(begin, end, row) - matrix_.innerIndexPtr());
  };
  for (int i = 0; i < size; ++i) diagonal_slots_.push_back(slot(i, i));
  for_couplings(
      [&](int row, int column) { coupling_slots_.push_back(row >= 0 && column >= 0 ? slot(row, column) : -1); });
  for (int a = 0; a < averages_; ++a) {
    auto& slots = weight_slots_.emplace_back();
    for (int node : net.averages()[std::size_t(a)].nodes)
      slots.push_back({slot(nodes_ + a, node), slot(node, nodes_ + averages_ + a)});
  }
}

void NewtonSystem::linearise(Evaluation& evaluation, double const* state, double const* input) {
  evaluation.linearise(state, input, at_);
  take_power();
  if (grids_)
    grids_->linearise(at_);
  else
    fill_matrix();
}

void NewtonSystem::fill_matrix() {
  auto const& net = network_;
  rate_.setZero(matrix_.nonZeros());
  fixed_.setZero(matrix_.nonZeros());
  auto const* slot = coupling_slots_.data();
  for (int port = 0; port < at_.coupling.outerSize(); ++port) {
    double const slope = port < nodes_ ? at_.slope[port] : 1.0;
    for (SparseMatrix::InnerIterator it(at_.coupling, port); it; ++it, ++slot)
      if (*slot >= 0)
        rate_[*slot] +=
            it.value() * slope / (it.row() < nodes_ ? net.capacity()[std::size_t(it.row())] : unit_capacity_);
  }
  for (int a = 0; a < averages_; ++a) {
    auto const& nodes = net.averages()[std::size_t(a)].nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      double const weight = at_.weights[std::size_t(a)][i];
      auto const& slots = weight_slots_[std::size_t(a)][i];
      fixed_[slots.mean] -= weight * at_.slope[nodes[i]];
      fixed_[slots.share] -= weight * unit_capacity_ / net.capacity()[std::size_t(nodes[i])];
    }
  }
  for (int i = nodes_; i < nodes_ + 2 * averages_; ++i) fixed_[diagonal_slots_[std::size_t(i)]] += 1.0;
}

void NewtonSystem::take_power() {
  int const first_average = nodes_ + int(network_.boundaries().size());
  for (int a = 0; a < averages_; ++a) {
    auto const& nodes = network_.averages()[std::size_t(a)].nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      at_.power.col(nodes[i]) += at_.weights[std::size_t(a)][i] * at_.power.col(first_average + a);
  }
  power_nodes_.clear();
  for (int i = 0; i < nodes_; ++i)
    if (!at_.power.col(i).isZero(0.0)) power_nodes_.push_back(i);
  power_.resize(energies, Eigen::Index(power_nodes_.size()));
  power_of_shift_.setZero();
  for (std::size_t k = 0; k < power_nodes_.size(); ++k) {
    int const i = power_nodes_[k];
    power_.col(Eigen::Index(k)) = at_.power.col(i) * at_.slope[i] / total_capacity_;
    power_of_shift_ += has_heat_[i] * power_.col(Eigen::Index(k));
  }
}

bool NewtonSystem::factorise(double identity, double gamma) {
  gamma_ = gamma;
  if (grids_) return grids_->shift(identity, gamma);
  matrix_.coeffs() = fixed_ - gamma * rate_;
  for (int i = 0; i < nodes_; ++i) matrix_.valuePtr()[diagonal_slots_[std::size_t(i)]] += identity;
  return factors_->factorise(matrix_);
}

bool NewtonSystem::factorise(double gamma) { return factorise(1.0, gamma); }

bool NewtonSystem::factorise_steady() { return factorise(0.0, 1.0); }

bool NewtonSystem::solve_nodes(VectorXd const& b, double tolerance, VectorXd& x) {
  x.resize(nodes_);
  return solve_nodes(b.data(), tolerance, x.data());
}

bool NewtonSystem::solve_nodes(double const* b, double tolerance, double* x) {
  if (grids_) return grids_->solve(b, tolerance, x);
  right_.setZero(matrix_.rows());
  right_.head(nodes_) = Eigen::Map<VectorXd const>(b, nodes_);
  all_.resize(matrix_.rows());
  if (!factors_->solve(right_, tolerance, all_)) return false;
  Eigen::Map<VectorXd>(x, nodes_) = all_.head(nodes_);
  return true;
}

bool NewtonSystem::solve_nodes(double tolerance, NodeByParameter& x) {
  if (grids_)
    return solve_one_by_one(tolerance, x, [&](VectorXd const& b, double own, VectorXd& y) {
      return grids_->solve(b.data(), own, y.data());
    });
  if (averages_ == 0) return factors_->solve_columns(tolerance, x);
  all_columns_.setZero(matrix_.rows(), x.cols());
  all_columns_.topRows(nodes_) = x;
  if (!factors_->solve_columns(tolerance, all_columns_)) return false;
  x = all_columns_.topRows(nodes_);
  return true;
}

bool NewtonSystem::solve(std::span<double const> b, double tolerance, std::span<double> x) {
  right_side_.assign(b.begin(), b.end());  // x may be b
  if (!solve_nodes(right_side_.data(), tolerance, x.data())) return false;
  keep_balance(right_side_.data(), x.data());
  return true;
}

Eigen::Vector4d NewtonSystem::power_of(double const* temperature) const {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (std::size_t k = 0; k < power_nodes_.size(); ++k)
    sum += power_.col(Eigen::Index(k)) * temperature[power_nodes_[k]];
  return sum;
}

/// Energies of x, after the uniform shift of all temperatures that makes the balance Σ Cᵢ xᵢ/ΣC + lost + withdrawn −
/// supplied of x that of b.
void NewtonSystem::keep_balance(double const* b, double* x) const {
  Eigen::Vector4d const sign(-1.0, 1.0, 1.0, 0.0);
  Eigen::Map<Eigen::Vector4d const> const b_energies(b + nodes_);
  Eigen::Map<Eigen::Vector4d> x_energies(x + nodes_);
  double const missing = sum_of_terms(nodes_, [&](std::ptrdiff_t i) { return capacity_[i] * (b[i] - x[i]); });
  Eigen::Vector4d const power = power_of(x);
  double const defect = missing / total_capacity_ - gamma_ * sign.dot(power);
  double const shift = defect / (1.0 + gamma_ * sign.dot(power_of_shift_));
  for_terms(nodes_, [x, shift, has_heat = has_heat_.data()](std::ptrdiff_t i) { x[i] += shift * has_heat[i]; });
  x_energies = b_energies + gamma_ * (power + shift * power_of_shift_);
}

/// Whether nearly all nodes stand in grids of three directions.
bool mostly_blocks(Network const& network) {
  int inside = 0;
  for (auto const& grid : network.grids())
    if (grid.n[2] > 1) inside += grid.count();
  return inside > 0.5 * network.nodes();
}

LinearSolver choose_solver(Network const& network) {
  if (network.nodes() <= 12) return LinearSolver::dense;
  if (network.nodes() > 2000 && mostly_blocks(network)) return LinearSolver::multigrid;
  NewtonSystem const system(network, LinearSolver::sparse_direct);
  bool const fills_in = factorisation_effort(system.pattern()) > 100.0;
  return fills_in ? LinearSolver::preconditioned_krylov : LinearSolver::sparse_direct;
}

}  // namespace thermotwin::thermal
