#include "thermal/multigrid.h"

#include <algorithm>

#include "thermal/fixed_blocks.h"
#include "thermal/grid_balance.h"

namespace thermotwin::thermal {
namespace {

constexpr int smallest_grid = 12;  ///< cells; not coarsened further

// Chebyshev's method of degree 2 on the rough part of the spectrum of D⁻¹A, which lies below 2.
constexpr float low = 0.35F, high = 2.0F;
constexpr float middle = 0.5F * (high + low), half = 0.5F * (high - low);
constexpr float rho0 = half / middle, rho1 = 1.0F / (2.0F * middle / half - rho0);
constexpr float momentum = rho1 * rho0, step = 2.0F * rho1 / half;

double mean(std::vector<float> const& values, Grid const& grid) {
  double sum = 0.0;
  for (int i = grid.first; i < grid.end(); ++i) sum += double(values[std::size_t(i)]);
  return sum / grid.count();
}

/// Visits the places (i, j, k) of a grid, the first direction fastest.
template <class Visit>
void for_places(Grid const& grid, Visit const& visit) {
  int node = grid.first;
  for (int k = 0; k < grid.n[2]; ++k)
    for (int j = 0; j < grid.n[1]; ++j)
      for (int i = 0; i < grid.n[0]; ++i) visit(std::array{i, j, k}, node++);
}

int node_at(Grid const& grid, std::array<int, 3> const& place) {
  return grid.first + place[0] + grid.n[0] * (place[1] + grid.n[1] * place[2]);
}

Grid joined(Grid const& fine, std::array<int, 3> const& by, int first) {
  Grid coarse{first, {}};
  for (std::size_t d = 0; d < 3; ++d) coarse.n[d] = (fine.n[d] + by[d] - 1) / by[d];
  return coarse;
}

std::array<int, 3> parent_of(std::array<int, 3> place, std::array<int, 3> const& by) {
  for (std::size_t d = 0; d < 3; ++d) place[d] /= by[d];
  return place;
}

/// Linear interpolation between cell centres: the parent's share, the other cell, and its share.
struct Between {
  int parent, other;
  float own, others;
};

Between between(int fine, int by, int fine_count, int coarse_count) {
  if (by == 1) return {fine, fine, 1.0F, 0.0F};
  int const parent = fine / 2, other = fine % 2 == 0 ? parent - 1 : parent + 1;
  bool const alone = parent * 2 + 1 == fine_count;
  if (alone || other < 0 || other >= coarse_count) return {parent, parent, 1.0F, 0.0F};
  return {parent, other, 0.75F, 0.25F};
}

}  // namespace

template <class Visit>
void Multigrid::for_pieces(Level const& level, Visit const& visit) {
  auto const visit_piece = [&](Piece const& piece) {
    auto const g = std::size_t(piece.grid);
    visit(level.network.grids[g], level.alike[g], piece.begin, piece.end);
  };
  if (level.network.size() < worth_a_thread) {
    for (auto const& piece : level.pieces) visit_piece(piece);
    return;
  }
  auto const count = std::ptrdiff_t(level.pieces.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t p = 0; p < count; ++p) visit_piece(level.pieces[std::size_t(p)]);
}

Multigrid::Level Multigrid::level_of(ConductionLevel network) {
  Level level;
  level.network = std::move(network);
  auto const& grids = level.network.grids;
  for (std::size_t g = 0; g < grids.size(); ++g)
    for (int begin = grids[g].first; begin < grids[g].end(); begin += int(block_length))
      level.pieces.push_back({int(g), begin, std::min(grids[g].end(), begin + int(block_length))});
  auto const n = std::size_t(level.network.size());
  for (auto* field : {&level.base, &level.inverse, &level.y}) field->resize(n);
  return level;
}

/// Along which directions cells are joined; false if none are.
bool Multigrid::plan(Level& level) {
  bool any = false;
  level.by.clear();
  for (auto const& grid : level.network.grids) {
    std::array<int, 3> by{1, 1, 1};
    std::array<double, 3> conducts{};
    for (std::size_t d = 0; d < 3; ++d)
      if (grid.n[d] > 1) conducts[d] = mean(level.network.g[d], grid);
    double const best = *std::max_element(conducts.begin(), conducts.end());
    for (std::size_t d = 0; d < 3 && grid.count() > smallest_grid; ++d)
      if (grid.n[d] > 1 && conducts[d] >= 0.3 * best) by[d] = 2, any = true;
    level.by.push_back(by);
  }
  return any;
}

void Multigrid::coarsen_grid(Level const& fine, std::size_t g, Grid const& target, ConductionLevel& coarse) {
  auto const& grid = fine.network.grids[g];
  auto const& by = fine.by[g];
  for_places(grid, [&](std::array<int, 3> const& place, int node) {
    auto const parent = std::size_t(node_at(target, parent_of(place, by)));
    coarse.capacity[parent] += fine.network.capacity[std::size_t(node)];
    coarse.outside[parent] += fine.network.outside[std::size_t(node)];
    for (int d = 0; d < 3; ++d) {
      auto const k = std::size_t(d);
      auto const& links = fine.network.g[k];
      int const here = place[k], stride = grid.stride(d), last = grid.n[k] - 1;
      if (here == last || (by[k] == 2 && here % 2 == 0)) continue;  // no link here, or it lies inside the joined cell
      float const link = links[std::size_t(node)];
      float resistance = 1.0F / link;
      if (by[k] == 2) {
        resistance += 0.5F / links[std::size_t(node - stride)];
        if (here + 2 <= last) resistance += 0.5F / links[std::size_t(node + stride)];
      }
      if (link > 0.0F) coarse.g[k][parent] += 1.0F / resistance;
    }
  });
}

ConductionLevel Multigrid::coarsened(Level const& fine) {
  ConductionLevel coarse;
  auto const& grids = fine.network.grids;
  int size = 0;
  for (std::size_t g = 0; g < grids.size(); ++g) {
    coarse.grids.push_back(joined(grids[g], fine.by[g], size));
    size = coarse.grids.back().end();
  }
  coarse.capacity.resize(std::size_t(size));
  coarse.outside.resize(std::size_t(size));
  for (auto& links : coarse.g) links.resize(std::size_t(size));
  for (std::size_t g = 0; g < grids.size(); ++g) coarsen_grid(fine, g, coarse.grids[g], coarse);

  auto const coarse_node = [&](int node) {
    auto const g = std::size_t(
        std::upper_bound(grids.begin(), grids.end(), node, [](int n, Grid const& grid) { return n < grid.first; }) -
        grids.begin() - 1);
    int const place = node - grids[g].first, nx = grids[g].n[0], ny = grids[g].n[1];
    return node_at(coarse.grids[g], parent_of({place % nx, place / nx % ny, place / nx / ny}, fine.by[g]));
  };
  for (auto const& average : fine.network.averages) {
    auto& joined_average = coarse.averages.emplace_back();
    for (auto const& [node, weight] : average) {
      int const parent = coarse_node(node);
      auto const known = std::find_if(joined_average.begin(), joined_average.end(),
                                      [&](auto const& entry) { return entry.first == parent; });
      if (known == joined_average.end())
        joined_average.emplace_back(parent, weight);
      else
        known->second += weight;
    }
  }
  coarse.average_couplings = fine.network.average_couplings;
  return coarse;
}

void Multigrid::set(ConductionLevel finest, std::span<PortCoupling const> couplings) {
  if (levels_.empty()) {
    levels_.push_back(level_of(std::move(finest)));
    while (plan(levels_.back())) {
      auto& coarse = levels_.emplace_back(level_of(coarsened(levels_.back())));
      coarse.x.resize(std::size_t(coarse.network.size()));
      coarse.b.resize(std::size_t(coarse.network.size()));
    }
  } else {
    levels_.front().network = std::move(finest);
    for (std::size_t l = 1; l < levels_.size(); ++l) levels_[l].network = coarsened(levels_[l - 1]);
  }
  for (auto& level : levels_) add_up(level);
  lay_out_coarsest(couplings);
}

/// An average's heat counts with what its own temperature does to the cell's share of it.
void Multigrid::add_up(Level& level) {
  auto const& net = level.network;
  level.around = net.outside;
  for (auto const& grid : net.grids)
    for (int d = 0; d < 3; ++d)
      for (int i = grid.first; grid.n[std::size_t(d)] > 1 && i + grid.stride(d) < grid.end(); ++i) {
        float const link = net.g[std::size_t(d)][std::size_t(i)];
        level.around[std::size_t(i)] += link;
        level.around[std::size_t(i + grid.stride(d))] += link;
      }
  for (std::size_t a = 0; a < net.averages.size(); ++a)
    for (auto const& [node, weight] : net.averages[a])
      level.around[std::size_t(node)] += weight * weight * std::max(0.0F, net.average_couplings[a]);
  level.alike.clear();
  for (auto const& grid : net.grids) {
    std::array const fields{net.capacity.data(), net.outside.data(), std::as_const(level.around).data()};
    level.alike.push_back(layers_alike<float>(grid, net.links(), fields));
  }
}

bool Multigrid::shift(double identity, double gamma) {
  identity_ = identity;
  gamma_ = gamma;
  auto const s = float(identity), y = float(gamma);
  for (auto& level : levels_)
    for_terms(level.network.size(),
              [s, y, base = level.base.data(), inverse = level.inverse.data(), around = level.around.data(),
               capacity = level.network.capacity.data(), outside = level.network.outside.data()](std::ptrdiff_t i) {
                base[i] = s * capacity[i] + y * outside[i];
                inverse[i] = 1.0F / (s * capacity[i] + y * around[i]);
              });
  coarsest_.coeffs() = identity * coarsest_capacity_.coeffs() + gamma * coarsest_conduction_.coeffs();
  return factors_->factorise(coarsest_);
}

/// All of the coarsest level as one matrix, couplings included.
void Multigrid::lay_out_coarsest(std::span<PortCoupling const> couplings) {
  auto const& net = levels_.back().network;
  int const nodes = levels_.front().network.size(), size = net.size();
  std::vector<int> coarse_of_fine(static_cast<std::size_t>(nodes));
  for (int i = 0; i < nodes; ++i) coarse_of_fine[std::size_t(i)] = i;
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
    std::vector<int> next(std::size_t(levels_[l].network.size()));
    for (std::size_t g = 0; g < levels_[l].by.size(); ++g)
      for_places(levels_[l].network.grids[g], [&](std::array<int, 3> const& place, int node) {
        next[std::size_t(node)] = node_at(levels_[l + 1].network.grids[g], parent_of(place, levels_[l].by[g]));
      });
    for (int& place : coarse_of_fine) place = next[std::size_t(place)];
  }
  auto const cells_of = [&](int port) {
    if (port < nodes) return NodeWeights{{coarse_of_fine[std::size_t(port)], 1.0F}};
    return net.averages[std::size_t(port - nodes)];
  };
  std::vector<Eigen::Triplet<double>> conduction, capacity;
  auto const add = [&](int row, int column, double value) {
    conduction.emplace_back(row, column, value);
    capacity.emplace_back(row, column, 0.0);
  };
  for (int i = 0; i < size; ++i) {
    conduction.emplace_back(i, i, net.outside[std::size_t(i)]);
    capacity.emplace_back(i, i, net.capacity[std::size_t(i)]);
  }
  for (auto const& grid : net.grids)
    for (int d = 0; d < 3; ++d)
      for (int i = grid.first; grid.n[std::size_t(d)] > 1 && i + grid.stride(d) < grid.end(); ++i) {
        double const link = net.g[std::size_t(d)][std::size_t(i)];
        int const j = i + grid.stride(d);
        add(i, i, link), add(j, j, link), add(i, j, -link), add(j, i, -link);
      }
  for (auto const& coupling : couplings)
    for (auto const& [row, row_weight] : cells_of(coupling.into))
      for (auto const& [column, column_weight] : cells_of(coupling.of))
        add(row, column, -coupling.value * double(row_weight) * double(column_weight));
  for (auto* matrix : {&coarsest_conduction_, &coarsest_capacity_}) {
    auto const& entries = matrix == &coarsest_capacity_ ? capacity : conduction;
    matrix->resize(size, size);
    matrix->setFromTriplets(entries.begin(), entries.end());
  }
  coarsest_ = coarsest_conduction_;
  factors_ = make_linear_factors(LinearSolver::sparse_direct);
}

template <class X>
void Multigrid::multiply(X const* x, X* y) const {
  auto const& level = levels_.front();
  auto const* base = level.base.data();
  auto const gamma = X(gamma_);
  for_pieces(level, [&](Grid const& grid, bool alike, int begin, int end) {
    for_balances(grid, level.network.links(), alike, x, begin, end,
                 [&](int i, int k, X heat) { y[i] = X(base[k]) * x[i] - gamma * heat; });
  });
}
template void Multigrid::multiply(float const*, float*) const;
template void Multigrid::multiply(double const*, double*) const;

void Multigrid::solve(float const* b, float* x) { cycle(0, b, x); }

void Multigrid::cycle(std::size_t depth, float const* b, float* x) {
  auto& level = levels_[depth];
  if (depth + 1 == levels_.size()) return solve_coarsest(b, x);
  auto& coarse = levels_[depth + 1];
  smooth_from_zero(level, b, x);
  restrict_residual(level, b, x, coarse);
  cycle(depth + 1, coarse.b.data(), coarse.x.data());
  add_interpolated(level, coarse, x);
  smooth(level, b, x);
}

void Multigrid::smooth_from_zero(Level& level, float const* b, float* x) const {
  auto const* inverse = level.inverse.data();
  auto const* base = level.base.data();
  auto* first = level.y.data();
  auto const gamma = float(gamma_);
  for_terms(level.network.size(), [=](std::ptrdiff_t i) { first[i] = inverse[i] * b[i] * (1.0F / middle); });
  for_pieces(level, [&](Grid const& grid, bool alike, int begin, int end) {
    for_balances(grid, level.network.links(), alike, first, begin, end, [&](int i, int k, float heat) {
      float const residual = b[i] - base[k] * first[i] + gamma * heat;
      x[i] = (1.0F + momentum) * first[i] + step * inverse[k] * residual;
    });
  });
}

void Multigrid::smooth(Level& level, float const* b, float* x) const {
  auto const* inverse = level.inverse.data();
  auto const* base = level.base.data();
  auto* first = level.y.data();
  auto const gamma = float(gamma_);
  for_pieces(level, [&](Grid const& grid, bool alike, int begin, int end) {
    for_balances(grid, level.network.links(), alike, x, begin, end, [&](int i, int k, float heat) {
      float const residual = b[i] - base[k] * x[i] + gamma * heat;
      first[i] = x[i] + inverse[k] * residual * (1.0F / middle);
    });
  });
  for_pieces(level, [&](Grid const& grid, bool alike, int begin, int end) {
    for_balances(grid, level.network.links(), alike, first, begin, end, [&](int i, int k, float heat) {
      float const residual = b[i] - base[k] * first[i] + gamma * heat;
      x[i] = first[i] + momentum * (first[i] - x[i]) + step * inverse[k] * residual;
    });
  });
}

void Multigrid::restrict_residual(Level& fine, float const* b, float const* x, Level& coarse) const {
  auto const* base = fine.base.data();
  auto* residual = fine.y.data();
  auto const gamma = float(gamma_);
  for_pieces(fine, [&](Grid const& grid, bool alike, int begin, int end) {
    for_balances(grid, fine.network.links(), alike, x, begin, end,
                 [&](int i, int k, float heat) { residual[i] = b[i] - base[k] * x[i] + gamma * heat; });
  });
  for (std::size_t g = 0; g < fine.by.size(); ++g) {
    auto const &grid = fine.network.grids[g], &target = coarse.network.grids[g];
    auto const& by = fine.by[g];
#pragma omp parallel for schedule(static) if (grid.count() >= worth_a_thread)
    for (int K = 0; K < target.n[2]; ++K)
      for (int J = 0; J < target.n[1]; ++J) {
        float* sums = coarse.b.data() + node_at(target, {0, J, K});
        std::fill_n(sums, target.n[0], 0.0F);
        for (int k = K * by[2]; k < std::min(grid.n[2], (K + 1) * by[2]); ++k)
          for (int j = J * by[1]; j < std::min(grid.n[1], (J + 1) * by[1]); ++j) {
            float const* row = residual + node_at(grid, {0, j, k});
            if (by[0] == 1)
              for (int i = 0; i < grid.n[0]; ++i) sums[i] += row[i];
            else
              for (int i = 0; i < grid.n[0] / 2; ++i) sums[i] += row[2 * i] + row[2 * i + 1];
            if (by[0] == 2 && grid.n[0] % 2 == 1) sums[grid.n[0] / 2] += row[grid.n[0] - 1];
          }
      }
  }
}

void Multigrid::add_interpolated(Level const& fine, Level const& coarse, float* x) {
  for (std::size_t g = 0; g < fine.by.size(); ++g) {
    auto const &grid = fine.network.grids[g], &source = coarse.network.grids[g];
    auto const& by = fine.by[g];
#pragma omp parallel if (grid.count() >= worth_a_thread)
    {
      std::vector<float> mixed(std::size_t(source.n[0]));
#pragma omp for schedule(static)
      for (int k = 0; k < grid.n[2]; ++k) {
        auto const z = between(k, by[2], grid.n[2], source.n[2]);
        for (int j = 0; j < grid.n[1]; ++j) {
          auto const y = between(j, by[1], grid.n[1], source.n[1]);
          auto const row = [&](int J, int K) { return coarse.x.data() + node_at(source, {0, J, K}); };
          float const *near = row(y.parent, z.parent), *along_y = row(y.other, z.parent),
                      *along_z = row(y.parent, z.other), *diagonal = row(y.other, z.other);
          for (int i = 0; i < source.n[0]; ++i)
            mixed[std::size_t(i)] = z.own * (y.own * near[i] + y.others * along_y[i]) +
                                    z.others * (y.own * along_z[i] + y.others * diagonal[i]);
          float* target = x + node_at(grid, {0, j, k});
          if (by[0] == 1) {
            for (int i = 0; i < grid.n[0]; ++i) target[i] += mixed[std::size_t(i)];
          } else {
            int const last = source.n[0] - 1;
            for (int i = 0; 2 * i + 1 < grid.n[0]; ++i) {
              float const here = mixed[std::size_t(i)];
              target[2 * i] += 0.75F * here + 0.25F * (i > 0 ? mixed[std::size_t(i - 1)] : here);
              target[2 * i + 1] += 0.75F * here + 0.25F * (i < last ? mixed[std::size_t(i + 1)] : here);
            }
            if (grid.n[0] % 2 == 1) target[grid.n[0] - 1] += mixed[std::size_t(last)];
          }
        }
      }
    }
  }
}

void Multigrid::solve_coarsest(float const* b, float* x) {
  auto const n = Eigen::Index(levels_.back().network.size());
  coarsest_b_ = Eigen::Map<Eigen::VectorXf const>(b, n).cast<double>();
  coarsest_x_.resize(n);
  if (!factors_->solve(coarsest_b_, 0.0, coarsest_x_)) coarsest_x_.setZero();
  Eigen::Map<Eigen::VectorXf>(x, n) = coarsest_x_.cast<float>();
}

}  // namespace thermotwin::thermal
