// The only file that knows LIBSVM.
#include "models/support_vector.h"

#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <libsvm/svm.h>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "models/contiguous_folds.h"
#include "models/gaussian_kernel.h"
#include "models/scaling.h"
#include "models/training_set.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int lowest_exponent = -4, highest_exponent = 4;
constexpr double final_tolerance = 1e-6;

struct GridPoint {
  double cost = 1, g = 1;
};

svm_parameter parameters_of(SupportVectorOptions const& options) {
  svm_parameter parameters{};
  parameters.svm_type = EPSILON_SVR;
  parameters.kernel_type = PRECOMPUTED;
  parameters.C = options.cost;
  parameters.p = options.epsilon;
  parameters.eps = options.tolerance;
  parameters.cache_size = 200;
  parameters.shrinking = 1;
  return parameters;
}

void silence() {
  static bool const once = [] {
    svm_set_print_string_function([](char const*) {});
    return true;
  }();
  static_cast<void>(once);
}

/// Squared error on the folds left out; gives up as soon as it exceeds `enough`.
double validation_error(SupportVectorSolver const& solver, MatrixXd const& kernel, VectorXd const& target,
                        std::vector<Fold> const& folds, SupportVectorOptions const& options, double enough) {
  double sum = 0;
  for (auto const& fold : folds) {
    auto const fit = solver.solve(target, rows_outside(fold, target.size()), options);
    VectorXd const centred = target.segment(fold.first, fold.count).array() - fit.intercept;
    sum += (centred - kernel.middleRows(fold.first, fold.count) * fit.weights).squaredNorm();
    if (sum > enough) break;
  }
  return sum;
}

GridPoint best_of_grid(MatrixXd const& distances, VectorXd const& target, int fold_count) {
  auto const folds = contiguous_folds(target.size(), fold_count);
  double least = std::numeric_limits<double>::infinity();
  GridPoint best;
  for (int i = lowest_exponent; i <= highest_exponent; ++i) {
    double const g = std::exp2(i);
    MatrixXd const kernel = gaussian_kernel(distances, g);
    SupportVectorSolver const solver(kernel);
    for (int j = lowest_exponent; j <= highest_exponent; ++j) {
      SupportVectorOptions const options{.cost = std::exp2(j)};
      double const error = validation_error(solver, kernel, target, folds, options, least);
      if (error < least) {
        least = error;
        best = {options.cost, g};
      }
    }
  }
  return best;
}

std::vector<Index> numbers_to(Index count) {
  std::vector<Index> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), Index{0});
  return numbers;
}

}  // namespace

SupportVectorSolver::SupportVectorSolver(MatrixXd const& kernel) : samples_(kernel.rows()) {
  nodes_.reserve(static_cast<std::size_t>(samples_ * (samples_ + 1)));
  for (Index i = 0; i < samples_; ++i) {
    nodes_.push_back({0, static_cast<double>(i + 1)});
    for (Index j = 0; j < samples_; ++j) nodes_.push_back({static_cast<int>(j) + 1, kernel(j, i)});
  }
}

SupportVectorRegression SupportVectorSolver::solve(VectorXd const& target, std::vector<Index> const& rows,
                                                   SupportVectorOptions const& options) const {
  static_assert(sizeof(Node) == sizeof(svm_node) && offsetof(Node, value) == offsetof(svm_node, value));
  silence();
  std::vector<double> y;
  std::vector<svm_node*> x;
  for (Index const row : rows) {
    y.push_back(target(row));
    // LIBSVM's interface is not const, but training only reads the nodes.
    x.push_back(
        reinterpret_cast<svm_node*>(const_cast<Node*>(&nodes_[static_cast<std::size_t>(row * (samples_ + 1))])));
  }
  svm_problem const problem{static_cast<int>(rows.size()), y.data(), x.data()};
  auto const parameters = parameters_of(options);
  if (auto const* complaint = svm_check_parameter(&problem, &parameters)) throw std::invalid_argument(complaint);
  auto const destroy = [](svm_model* model) { svm_free_and_destroy_model(&model); };
  std::unique_ptr<svm_model, decltype(destroy)> const model(svm_train(&problem, &parameters), destroy);
  SupportVectorRegression fit{VectorXd::Zero(samples_), -model->rho[0]};
  for (int k = 0; k < model->l; ++k)
    fit.weights(rows[static_cast<std::size_t>(model->sv_indices[k] - 1)]) = model->sv_coef[0][k];
  return fit;
}

ErrorModel fit_support_vector(std::span<Batch const> batches, FitOptions const& options) {
  auto const set = training_set(batches);
  require_samples(set, set.regressors.cols() + 2);
  auto const input = standard_scaling(set.regressors), target = standard_scaling(set.error);
  MatrixXd const x = scaled(set.regressors, input);
  VectorXd const y = scaled(set.error, target);
  MatrixXd const distances = squared_distances(x, x);
  auto const best = best_of_grid(distances, y, options.folds);
  auto const fit = SupportVectorSolver(gaussian_kernel(distances, best.g))
                       .solve(y, numbers_to(y.size()), {.cost = best.cost, .tolerance = final_tolerance});

  KernelForm form;
  std::vector<Index> support;
  Index free = 0;
  for (Index i = 0; i < y.size(); ++i) {
    if (fit.weights(i) == 0) continue;
    support.push_back(i);
    if (std::abs(fit.weights(i)) < best.cost) ++free;
  }
  form.support = x(support, Eigen::all);
  form.weights = fit.weights(support);
  form.intercept = fit.intercept;
  form.g = best.g;
  form.input_offset = input.offset;
  form.input_scale = input.scale;
  form.target_offset = target.offset(0);
  form.target_scale = target.scale(0);
  // Degrees of freedom of an ε-SVR: its free support vectors (Gunter & Zhu, Neural Computation 19 (2007) 1633).
  return {"support_vector",  set.inputs,
          set.sample_period, static_cast<double>(free),
          std::move(form),   fmt::format("C = {:g}, g = {:g}, {} support vectors", best.cost, best.g, support.size())};
}

}  // namespace thermotwin::models
