#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "thermal/grid.h"
#include "thermal/linear_factors.h"

namespace thermotwin::thermal {

/// A weighted mean of nodes: {node, weight}.
using NodeWeights = std::vector<std::pair<int, float>>;

/// The heat that flows into one port per kelvin of another [W/K]; a port is a node, or the average number
/// `port − nodes`.
struct PortCoupling {
  int into, of;
  double value;
};

/// A conduction network as multigrid sees it: A x = (s C + γ e) x − γ Σ_j g_ij (x_j − x_i) − γ (couplings).
///
/// Arrays are in single precision: what is found with them is a correction.
struct ConductionLevel {
  std::vector<Grid> grids;
  std::vector<float> capacity;          ///< C [J/K]
  std::vector<float> outside;           ///< e: to anything that is no neighbour [W/K]
  std::array<std::vector<float>, 3> g;  ///< to the next neighbour along each direction [W/K]
  std::vector<NodeWeights> averages;
  std::vector<float> average_couplings;  ///< −∂(heat into the average)/∂(its temperature) [W/K]

  [[nodiscard]] int size() const { return int(capacity.size()); }
  [[nodiscard]] std::array<float const*, 3> links() const { return {g[0].data(), g[1].data(), g[2].data()}; }
};

/// One cycle of geometric multigrid on all grids of a network at once: an approximate inverse of A, the same linear map
/// every time, for a Krylov method.
///
/// Cells are joined by twos along every direction in which they conduct well; capacities and couplings to the outside
/// add up, links are resistances in series along that direction and conductances in parallel across it, so that each
/// level is a thermal network itself. Residuals add up, corrections are interpolated linearly; two steps of Chebyshev's
/// method damp what is rough before and after. The coarsest level holds all averages and couplings between bodies and
/// is solved exactly. Source: Trottenberg, Oosterlee & Schüller, Multigrid, 2001, §2.8, §5.1; Adams et al., J. Comput.
/// Phys. 188 (2003) 593.
class Multigrid {
 public:
  /// Takes the finest level and the couplings; coarsens.
  void set(ConductionLevel finest, std::span<PortCoupling const> couplings);
  /// s and γ; false if the coarsest level is singular.
  [[nodiscard]] bool shift(double identity, double gamma);

  [[nodiscard]] ConductionLevel const& finest() const { return levels_.front().network; }

  /// y = (s C + γ e) x − γ Σ g (x_j − x_i) on the finest level: all but couplings.
  template <class X>
  void multiply(X const* x, X* y) const;
  /// x ≈ A⁻¹ b.
  void solve(float const* b, float* x);

 private:
  struct Piece {
    int grid, begin, end;
  };
  struct Level {
    ConductionLevel network;
    std::vector<Piece> pieces;           ///< of at most block_length cells, none of them across grids
    std::vector<std::array<int, 3>> by;  ///< of each grid: how many cells are joined along each direction, to the next
    std::vector<bool> alike;             ///< of each grid: its layers (grid_balance.h)
    std::vector<float> around;           ///< all conductances of a cell added up
    std::vector<float> base, inverse;    ///< s C + γ e; 1/diagonal
    std::vector<float> x, b, y;          ///< on coarser levels: unknowns and right-hand side; scratch
  };

  [[nodiscard]] static Level level_of(ConductionLevel network);
  [[nodiscard]] static ConductionLevel coarsened(Level const& fine);
  static void coarsen_grid(Level const& fine, std::size_t grid, Grid const& target, ConductionLevel& coarse);
  [[nodiscard]] static bool plan(Level& level);
  static void add_up(Level& level);

  template <class Visit>
  static void for_pieces(Level const& level, Visit const& visit);
  void cycle(std::size_t depth, float const* b, float* x);
  void smooth_from_zero(Level& level, float const* b, float* x) const;
  void smooth(Level& level, float const* b, float* x) const;
  void restrict_residual(Level& fine, float const* b, float const* x, Level& coarse) const;
  static void add_interpolated(Level const& fine, Level const& coarse, float* x);
  void lay_out_coarsest(std::span<PortCoupling const> couplings);
  void solve_coarsest(float const* b, float* x);

  std::vector<Level> levels_;
  double identity_ = 1.0, gamma_ = 0.0;
  Eigen::SparseMatrix<double> coarsest_, coarsest_capacity_, coarsest_conduction_;
  Eigen::VectorXd coarsest_b_, coarsest_x_;
  std::unique_ptr<LinearFactors> factors_;
};

}  // namespace thermotwin::thermal
