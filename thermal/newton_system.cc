// The only file that knows SuiteSparse.
#include "thermal/newton_system.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/LU>
#include <klu.h>

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

}  // namespace

struct NewtonSystem::Factors {
  virtual ~Factors() = default;
  virtual bool factorise(SparseMatrix const& matrix) = 0;
  virtual bool solve(Eigen::Ref<VectorXd const> const& b, double tolerance, Eigen::Ref<VectorXd> x) = 0;
};

struct NewtonSystem::DenseFactors final : Factors {
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
struct NewtonSystem::SparseFactors final : Factors {
  SparseFactors() { klu_defaults(&common_); }
  SparseFactors(SparseFactors const&) = delete;
  SparseFactors& operator=(SparseFactors const&) = delete;
  ~SparseFactors() override {
    klu_free_numeric(&numeric_, &common_);
    klu_free_symbolic(&symbolic_, &common_);
  }

  bool factorise(SparseMatrix const& matrix) override {
    int const n = int(matrix.rows());
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
    return klu_solve(symbolic_, numeric_, int(x.size()), 1, x.data(), &common_) != 0;
  }

  klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
};

struct NewtonSystem::KrylovFactors final : Factors {
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

NewtonSystem::NewtonSystem(Network const& network, LinearSolver solver)
    : capacity_(network.nodes()), jacobian_(network.jacobian_pattern()), matrix_(jacobian_) {
  for (int i = 0; i < network.nodes(); ++i)
    capacity_[i] = network.signals()[std::size_t(i)] ? 0.0 : network.capacity()[std::size_t(i)];
  has_heat_ = (capacity_.array() > 0.0).cast<double>();
  total_capacity_ = capacity_.sum();
  if (solver == LinearSolver::dense)
    factors_ = std::make_unique<DenseFactors>();
  else if (solver == LinearSolver::sparse_direct)
    factors_ = std::make_unique<SparseFactors>();
  else
    factors_ = std::make_unique<KrylovFactors>();
}

NewtonSystem::~NewtonSystem() = default;

void NewtonSystem::linearise(Evaluation& evaluation, double const* state, double const* input) {
  evaluation.jacobian(state, input, jacobian_, &power_);
  power_ /= total_capacity_;
}

bool NewtonSystem::factorise(double gamma) {
  gamma_ = gamma;
  matrix_.coeffs() = -gamma * jacobian_.coeffs();
  for (Eigen::Index i = 0; i < matrix_.rows(); ++i) matrix_.coeffRef(i, i) += 1.0;
  return factors_->factorise(matrix_);
}

bool NewtonSystem::solve(std::span<double const> b, double tolerance, std::span<double> x) {
  Eigen::Map<VectorXd const> const right(b.data(), Eigen::Index(b.size()));
  Eigen::Map<VectorXd> all(x.data(), Eigen::Index(x.size()));
  VectorXd const copy = right;
  if (!factors_->solve(copy.head(capacity_.size()), tolerance, all.head(capacity_.size()))) return false;
  keep_balance(copy, all);
  return true;
}

/// Energies of x, after the uniform shift of all temperatures that makes the balance Σ Cᵢ xᵢ/ΣC + lost + withdrawn −
/// supplied of x that of b.
void NewtonSystem::keep_balance(Eigen::Ref<VectorXd const> const& b, Eigen::Ref<VectorXd> x) const {
  Eigen::Index const n = capacity_.size();
  Eigen::Vector4d const sign(-1.0, 1.0, 1.0, 0.0);
  auto temperatures = x.head(n);
  x.tail<energies>() = b.tail<energies>() + gamma_ * (power_ * temperatures);
  double const defect =
      capacity_.dot(b.head(n) - temperatures) / total_capacity_ + sign.dot(b.tail<energies>() - x.tail<energies>());
  Eigen::Vector4d const power_of_shift = power_ * has_heat_;
  temperatures += defect / (1.0 + gamma_ * sign.dot(power_of_shift)) * has_heat_;
  x.tail<energies>() = b.tail<energies>() + gamma_ * (power_ * temperatures);
}

}  // namespace thermotwin::thermal
