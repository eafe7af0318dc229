#include "models/least_squares_support_vector.h"

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "models/gaussian_kernel.h"
#include "models/scaling.h"
#include "models/training_set.h"

namespace thermotwin::models {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double paper_gamma = 56.2, paper_variance = 0.2;

}  // namespace

LeastSquaresSupportVector solve_least_squares(MatrixXd const& kernel, VectorXd const& target, double gamma) {
  auto const samples = target.size();
  MatrixXd a = kernel;
  a.diagonal().array() += 1.0 / gamma;
  Eigen::LLT<Eigen::Ref<MatrixXd>> const factor(a);
  VectorXd const eta = factor.solve(VectorXd::Ones(samples)), nu = factor.solve(target);
  LeastSquaresSupportVector fit;
  fit.intercept = nu.sum() / eta.sum();
  fit.weights = nu - fit.intercept * eta;
  double const trace = factor.matrixL().solve(MatrixXd::Identity(samples, samples)).squaredNorm();
  fit.parameters = static_cast<double>(samples) - (trace - eta.squaredNorm() / eta.sum()) / gamma;
  return fit;
}

LeastSquaresSupportVectors solve_least_squares_leaving_out(MatrixXd const& kernel, MatrixXd const& targets,
                                                           double gamma) {
  MatrixXd a = kernel, inverse = MatrixXd::Identity(kernel.rows(), kernel.cols());
  a.diagonal().array() += 1.0 / gamma;
  Eigen::LLT<Eigen::Ref<MatrixXd>>(a).solveInPlace(inverse);
  VectorXd const eta = inverse.rowwise().sum();
  double const sum = eta.sum();
  LeastSquaresSupportVectors fit;
  fit.intercepts = eta.transpose() * targets / sum;
  fit.weights = inverse * targets - eta * fit.intercepts;
  VectorXd const own = inverse.diagonal().array() - eta.array().square() / sum;
  fit.left_out = own.cwiseInverse().asDiagonal() * fit.weights;
  return fit;
}

ErrorModel fit_least_squares_support_vector(std::span<Batch const> batches, FitOptions const&) {
  auto const set = training_set(batches);
  require_samples(set, set.regressors.cols() + 2);
  require_kernel_room(set.error.size());
  auto const input = range_scaling(set.regressors, 0.0, 1.0), target = range_scaling(set.error, 0.0, 1.0);
  KernelForm form;
  form.support = scaled(set.regressors, input);
  form.g = 1.0 / (2.0 * paper_variance);
  auto const kernel = gaussian_kernel(squared_distances(form.support, form.support), form.g);
  auto const fit = solve_least_squares(kernel, scaled(set.error, target), paper_gamma);
  form.weights = fit.weights;
  form.intercept = fit.intercept;
  form.input_offset = input.offset;
  form.input_scale = input.scale;
  form.target_offset = target.offset(0);
  form.target_scale = target.scale(0);
  return {"least_squares_support_vector",
          set.inputs,
          set.sample_period,
          fit.parameters,
          std::move(form),
          fmt::format("γ = {:g}, σ² = {:g}, {:.1f} effective parameters", paper_gamma, paper_variance, fit.parameters)};
}

}  // namespace thermotwin::models
