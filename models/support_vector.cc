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

std::vector<Index> numbers_to(Index count) {
  std::vector<Index> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), Index{0});
  return numbers;
}

/// Inputs and target of mean 0 and variance 1 among the rows that are fitted.
struct StandardSamples {
  Scaling input, target;
  MatrixXd x;
  VectorXd y;

  StandardSamples(MatrixXd const& regressors, VectorXd const& error)
      : input(standard_scaling(regressors)),
        target(standard_scaling(error)),
        x(scaled(regressors, input)),
        y(scaled(error, target)) {}
};

/// A fold that is left out, and what is fitted for it.
struct LeftOut {
  StandardSamples fitted;
  VectorXd wanted;
  MatrixXd among, across;  ///< squared distances of the rows fitted, and of the fold's rows from them

  LeftOut(TrainingSet const& set, Fold const& fold, std::vector<Index> const& rest)
      : fitted(set.regressors(rest, Eigen::all), set.error(rest)),
        wanted(scaled(set.error.segment(fold.first, fold.count), fitted.target)),
        among(squared_distances(fitted.x, fitted.x)),
        across(squared_distances(scaled(set.regressors.middleRows(fold.first, fold.count), fitted.input), fitted.x)) {}
};

/// The same with kernels of one g.
struct Validation {
  LeftOut const& fold;
  SupportVectorSolver solver;
  MatrixXd kernel;

  Validation(LeftOut const& left_out, double g)
      : fold(left_out), solver(gaussian_kernel(fold.among, g)), kernel(gaussian_kernel(fold.across, g)) {}
  /// [µm²]
  [[nodiscard]] double squared_error(double cost) const {
    auto const& y = fold.fitted.y;
    auto const fit = solver.solve(y, numbers_to(y.size()), {.cost = cost});
    VectorXd const missed = fold.wanted - ((kernel * fit.weights).array() + fit.intercept).matrix();
    return missed.squaredNorm() * fold.fitted.target.scale.squaredNorm();
  }
};

/// Of all folds; gives up as soon as it exceeds `enough`.
double validation_error(std::vector<Validation> const& validations, double cost, double enough) {
  double sum = 0;
  for (auto const& validation : validations) {
    sum += validation.squared_error(cost);
    if (sum > enough) break;
  }
  return sum;
}

GridPoint best_of_grid(TrainingSet const& set, int fold_count) {
  std::vector<LeftOut> folds;
  for (auto const& fold : folds_of_runs(set.run_lengths, fold_count))
    folds.emplace_back(set, fold, rows_outside(fold, set.error.size()));
  double least = std::numeric_limits<double>::infinity();
  GridPoint best;
  for (int i = lowest_exponent; i <= highest_exponent; ++i) {
    double const g = std::exp2(i);
    std::vector<Validation> validations;
    for (auto const& fold : folds) validations.emplace_back(fold, g);
    for (int j = lowest_exponent; j <= highest_exponent; ++j) {
      double const cost = std::exp2(j), error = validation_error(validations, cost, least);
      if (error < least) {
        least = error;
        best = {cost, g};
      }
    }
  }
  return best;
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
  require_kernel_room(set.error.size());
  auto const best = best_of_grid(set, options.folds);
  StandardSamples const samples(set.regressors, set.error);
  auto const& [input, target, x, y] = samples;
  auto const fit = SupportVectorSolver(gaussian_kernel(squared_distances(x, x), best.g))
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
