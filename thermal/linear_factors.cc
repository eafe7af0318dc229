// The only file that knows SuiteSparse.
#include "thermal/linear_factors.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <klu.h>
#include <vector>

namespace thermotwin::thermal {

using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

namespace {

/// Incomplete LU without fill: L U = Aᵀ on the pattern of A, the columns of A taken as rows of Aᵀ, so that A ≈ UᵀLᵀ.
/// Right for I − γJ of a conduction network, whose diagonal dominates. Source: Saad, Iterative Methods for Sparse
/// Linear Systems, 2nd ed. 2003, §10.3.2.
class IncompleteFactors {
 public:
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic };

  template <class Matrix>
  IncompleteFactors& analyzePattern(Matrix const&) {
    return *this;
  }
  template <class Matrix>
  IncompleteFactors& compute(Matrix const& matrix) {
    return factorize(matrix);
  }
  [[nodiscard]] Eigen::ComputationInfo info() const { return info_; }

  template <class Matrix>
  IncompleteFactors& factorize(Matrix const& matrix) {
    factors_ = matrix;
    int const n = int(factors_.rows());
    int const* start = factors_.outerIndexPtr();
    int const* column = factors_.innerIndexPtr();
    double* value = factors_.valuePtr();
    diagonal_.resize(std::size_t(n));
    std::vector<int> slot(std::size_t(n), -1);
    info_ = Eigen::Success;
    for (int i = 0; i < n; ++i) {
      for (int k = start[i]; k < start[i + 1]; ++k) slot[std::size_t(column[k])] = k;
      for (int k = start[i]; k < start[i + 1] && column[k] < i; ++k) {
        int const pivot = diagonal_[std::size_t(column[k])];
        value[k] /= value[pivot];
        for (int m = pivot + 1; m < start[column[k] + 1]; ++m)
          if (int const target = slot[std::size_t(column[m])]; target >= 0) value[target] -= value[k] * value[m];
      }
      diagonal_[std::size_t(i)] = slot[std::size_t(i)];
      if (slot[std::size_t(i)] < 0 || value[slot[std::size_t(i)]] == 0.0) return fail();
      for (int k = start[i]; k < start[i + 1]; ++k) slot[std::size_t(column[k])] = -1;
    }
    return *this;
  }

  template <class Right>
  [[nodiscard]] VectorXd solve(Right const& b) const {
    VectorXd x = b;
    int const n = int(x.size());
    int const* start = factors_.outerIndexPtr();
    int const* column = factors_.innerIndexPtr();
    double const* value = factors_.valuePtr();
    for (int i = 0; i < n; ++i) {
      int const pivot = diagonal_[std::size_t(i)];
      x[i] /= value[pivot];
      for (int k = pivot + 1; k < start[i + 1]; ++k) x[column[k]] -= value[k] * x[i];
    }
    for (int i = n - 1; i >= 0; --i)
      for (int k = start[i]; k < diagonal_[std::size_t(i)]; ++k) x[column[k]] -= value[k] * x[i];
    return x;
  }

 private:
  IncompleteFactors& fail() {
    info_ = Eigen::NumericalIssue;
    return *this;
  }

  SparseMatrix factors_;
  std::vector<int> diagonal_;
  Eigen::ComputationInfo info_ = Eigen::InvalidInput;
};

struct DenseFactors final : LinearFactors {
  bool factorise(SparseMatrix const& matrix) override {
    lu_.compute(matrix.toDense());
    return true;
  }
  bool solve(Eigen::Ref<VectorXd const> const& b, double, Eigen::Ref<VectorXd> x) override {
    x = lu_.solve(b);
    return x.allFinite();
  }
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

/// KLU: orders once, pivots at the first factorisation, and keeps the pivots while they are good.
struct SparseFactors final : LinearFactors {
  /// The matrices are of one block, and their rows of one size.
  SparseFactors() {
    klu_defaults(&common_);
    common_.btf = 0;
    common_.scale = -1;
  }
  SparseFactors(SparseFactors const&) = delete;
  SparseFactors& operator=(SparseFactors const&) = delete;
  ~SparseFactors() override {
    klu_free_numeric(&numeric_, &common_);
    klu_free_symbolic(&symbolic_, &common_);
  }

  bool factorise(SparseMatrix const& matrix) override {
    int const n = int(matrix.rows());
    extracted_ = false;
    auto* outer = const_cast<int*>(matrix.outerIndexPtr());
    auto* inner = const_cast<int*>(matrix.innerIndexPtr());
    auto* values = const_cast<double*>(matrix.valuePtr());
    if (!symbolic_) symbolic_ = klu_analyze(n, outer, inner, &common_);
    bool const good = numeric_ && klu_refactor(outer, inner, values, symbolic_, numeric_, &common_) &&
                      klu_rcond(symbolic_, numeric_, &common_) && common_.rcond > 1e-12;
    if (good) return true;
    klu_free_numeric(&numeric_, &common_);
    numeric_ = klu_factor(outer, inner, values, symbolic_, &common_);
    return numeric_ != nullptr;
  }
  bool solve(Eigen::Ref<VectorXd const> const& b, double, Eigen::Ref<VectorXd> x) override {
    x = b;
    return klu_solve(symbolic_, numeric_, int(x.size()), 1, x.data(), &common_) != 0 && x.allFinite();
  }
  /// klu_solve takes four columns at a time, and reads and writes them for every entry of the factors.
  bool solve_columns(double, NodeByParameter& x) override {
    if (!extract()) return false;
    Eigen::Index const rest = x.cols() % together, whole = x.cols() - rest;
    for (Eigen::Index first = 0; first < whole; first += together) solve_together(x.data() + first, x.cols());
    if (rest > 0) {
      rest_.setZero(x.rows(), together);
      rest_.leftCols(rest) = x.rightCols(rest);
      solve_together(rest_.data(), together);
      x.rightCols(rest) = rest_.leftCols(rest);
    }
    return std::isfinite(x.sum());  // asks every entry, by fours; allFinite goes from row to row
  }

 private:
  using ByRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  using Four [[gnu::vector_size(32)]] = double;
  static constexpr int fours = 4;
  static constexpr Eigen::Index together = 4 * fours;  ///< columns of which a row stays in registers
  using Row = Four[fours];

  static void read(double const* from, Row& row) {
#pragma GCC unroll 4
    for (int q = 0; q < fours; ++q) std::memcpy(&row[q], from + 4 * q, sizeof row[q]);
  }
  static void write(Row const& row, double* to) {
#pragma GCC unroll 4
    for (int q = 0; q < fours; ++q) std::memcpy(to + 4 * q, &row[q], sizeof row[q]);
  }
  /// sum −= Σ f_k y_k over these entries f of a factor.
  static void subtract(ByRows const& factor, int first, int end, double const* y, Row& sum) {
    for (int p = first; p < end; ++p) {
      Row other;
      read(y + factor.innerIndexPtr()[p] * together, other);
#pragma GCC unroll 4
      for (int q = 0; q < fours; ++q) sum[q] -= factor.valuePtr()[p] * other[q];
    }
  }

  /// In rows of x that are `stride` apart. The diagonal is the last of a row of L, and one; of U it is the first.
  void solve_together(double* x, Eigen::Index stride) {
    Eigen::Index const n = lower_.rows();
    solution_.resize(std::size_t(n * together));
    double* y = solution_.data();
    Row sum;
    for (Eigen::Index k = 0; k < n; ++k) {
      read(x + row_of_[k] * stride, sum);
      subtract(lower_, lower_.outerIndexPtr()[k], lower_.outerIndexPtr()[k + 1] - 1, y, sum);
      write(sum, y + k * together);
    }
    for (Eigen::Index k = n; k-- > 0;) {
      read(y + k * together, sum);
      subtract(upper_, upper_.outerIndexPtr()[k] + 1, upper_.outerIndexPtr()[k + 1], y, sum);
#pragma GCC unroll 4
      for (int q = 0; q < fours; ++q) sum[q] *= inverse_pivot_[k];
      write(sum, y + k * together);
      write(sum, x + column_of_[k] * stride);
    }
  }

  /// P A Q = L U.
  bool extract() {
    if (extracted_) return true;
    if (!numeric_) return false;
    int const n = symbolic_->n;
    SparseMatrix lower(n, n), upper(n, n);
    lower.resizeNonZeros(numeric_->lnz);
    upper.resizeNonZeros(numeric_->unz);
    row_of_.resize(n);
    column_of_.resize(n);
    if (!klu_extract(numeric_, symbolic_, lower.outerIndexPtr(), lower.innerIndexPtr(), lower.valuePtr(),
                     upper.outerIndexPtr(), upper.innerIndexPtr(), upper.valuePtr(), nullptr, nullptr, nullptr,
                     row_of_.data(), column_of_.data(), nullptr, nullptr, &common_))
      return false;
    lower_ = lower;
    upper_ = upper;
    inverse_pivot_.resize(n);
    for (int k = 0; k < n; ++k) inverse_pivot_[k] = 1.0 / upper_.valuePtr()[upper_.outerIndexPtr()[k]];
    return extracted_ = true;
  }

  klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
  bool extracted_ = false;
  ByRows lower_, upper_;
  VectorXd inverse_pivot_;
  Eigen::VectorXi row_of_, column_of_;
  std::vector<double> solution_;
  NodeByParameter rest_;
};

struct KrylovFactors final : LinearFactors {
  KrylovFactors() { solver_.setMaxIterations(300); }
  bool factorise(SparseMatrix const& matrix) override {
    solver_.compute(matrix);
    return solver_.info() == Eigen::Success;
  }
  bool solve(Eigen::Ref<VectorXd const> const& b, double tolerance, Eigen::Ref<VectorXd> x) override {
    double const size = b.norm();
    if (size == 0.0) {
      x.setZero();
      return true;
    }
    solver_.setTolerance(std::min(0.1, tolerance / size));
    x = solver_.solve(b);
    return solver_.info() == Eigen::Success;
  }
  Eigen::BiCGSTAB<SparseMatrix, IncompleteFactors> solver_;
};

}  // namespace

bool LinearFactors::solve_columns(double tolerance, NodeByParameter& x) {
  return solve_one_by_one(tolerance, x, [&](VectorXd const& b, double own, VectorXd& y) { return solve(b, own, y); });
}

std::unique_ptr<LinearFactors> make_linear_factors(LinearSolver solver) {
  if (solver == LinearSolver::dense) return std::make_unique<DenseFactors>();
  if (solver == LinearSolver::sparse_direct) return std::make_unique<SparseFactors>();
  return std::make_unique<KrylovFactors>();
}

double factorisation_effort(SparseMatrix const& pattern) {
  auto* outer = const_cast<int*>(pattern.outerIndexPtr());
  auto* inner = const_cast<int*>(pattern.innerIndexPtr());
  klu_common common;
  klu_defaults(&common);
  klu_symbolic* symbolic = klu_analyze(int(pattern.rows()), outer, inner, &common);
  double const flops = symbolic ? symbolic->est_flops : 0.0;
  klu_free_symbolic(&symbolic, &common);
  return flops / double(pattern.nonZeros());
}

}  // namespace thermotwin::thermal
