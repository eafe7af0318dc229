#include "twin/volumetric/field_prediction.h"

#include <array>
#include <ctime>
#include <fmt/format.h>
#include <limits>
#include <utility>
#include <vector>

#include "models/back_propagation.h"
#include "models/gaussian_kernel.h"
#include "models/least_squares_support_vector.h"
#include "models/metrics.h"
#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::twin {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int points_per_step = 10;
constexpr double um_per_m = 1e6;

/// The coordinate of evenly spaced points, from −1 to 1.
VectorXd coordinates(Eigen::Index points) { return VectorXd::LinSpaced(points, -1.0, 1.0); }

NineFunctions dense(NineFunctions const& measured) {
  NineFunctions result{measured.workspace, {}};
  for (std::size_t axis = 0; axis < 3; ++axis)
    result.values[axis].resize(3, points_per_step * (measured.values[axis].cols() - 1) + 1);
  return result;
}

double processor_time() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// One function of a coordinate as a run with one sensor.
models::Batch batch_of(VectorXd const& coordinate, VectorXd const& error_um) {
  return {"function", VectorXd::LinSpaced(coordinate.size(), 0.0, double(coordinate.size() - 1)),
          {"u"},      {"axis"},
          coordinate, error_um};
}

FieldPrediction by_network(NineFunctions const& measured, std::uint64_t seed) {
  FieldPrediction prediction{"network", dense(measured), 0.0, ""};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto const& given = measured.values[axis];
    auto& shown = prediction.functions.values[axis];
    VectorXd const fine = coordinates(shown.cols());
    for (Eigen::Index i = 0; i < 3; ++i) {
      auto const batch = batch_of(coordinates(given.cols()), um_per_m * given.row(i).transpose());
      double const start = processor_time();
      auto const model = models::fit_back_propagation({&batch, 1}, {.seed = seed});
      prediction.training_time += processor_time() - start;
      prediction.remark = model.remark;
      shown.row(i) = model.predict(batch_of(fine, VectorXd::Zero(fine.size()))).transpose() / um_per_m;
    }
  }
  return prediction;
}

FieldPrediction interpolated(NineFunctions const& measured, std::uint64_t) {
  FieldPrediction prediction{"interpolation", dense(measured), 0.0, "straight lines"};
  for (int axis = 0; axis < 3; ++axis) {
    auto& shown = prediction.functions.values[std::size_t(axis)];
    for (Eigen::Index j = 0; j < shown.cols(); ++j)
      shown.col(j) = measured.at(axis, prediction.functions.position(axis, j));
  }
  return prediction;
}

/// σ² and γ of a Gaussian LS-SVM.
struct Hyperparameters {
  double variance, gamma;
};

MatrixXd kernel_between(VectorXd const& a, VectorXd const& b, double variance) {
  return models::gaussian_kernel(models::squared_distances(a, b), 1.0 / (2.0 * variance));
}

/// The nine functions as columns; they have the same points.
MatrixXd columns_of(NineFunctions const& measured) {
  MatrixXd columns(measured.values[0].cols(), 9);
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    columns.middleCols(3 * axis, 3) = measured.values[std::size_t(axis)].transpose();
  return columns;
}

struct Trained {
  Hyperparameters setting;
  models::LeastSquaresSupportVectors fit;
};

/// With the setting of least squared error of the points left out, one at a time, over all nine functions.
Trained best_of(std::span<double const> variances, std::span<double const> gammas, NineFunctions const& measured) {
  MatrixXd const targets = columns_of(measured);
  VectorXd const u = coordinates(targets.rows());
  MatrixXd const distances = models::squared_distances(u, u);
  Trained best;
  double least = std::numeric_limits<double>::infinity();
  for (double const variance : variances) {
    MatrixXd const kernel = models::gaussian_kernel(distances, 1.0 / (2.0 * variance));
    for (double const gamma : gammas) {
      auto fit = models::solve_least_squares_leaving_out(kernel, targets, gamma);
      if (double const error = fit.left_out.squaredNorm(); error < least) {
        least = error;
        best = {{variance, gamma}, std::move(fit)};
      }
    }
  }
  return best;
}

FieldPrediction by_ls_svm(std::string_view name, std::span<double const> variances, std::span<double const> gammas,
                          NineFunctions const& measured) {
  FieldPrediction prediction{std::string(name), dense(measured), 0.0, ""};
  double const start = processor_time();
  auto const [setting, fit] = best_of(variances, gammas, measured);
  prediction.training_time = processor_time() - start;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    auto& shown = prediction.functions.values[std::size_t(axis)];
    MatrixXd const between =
        kernel_between(coordinates(shown.cols()), coordinates(fit.weights.rows()), setting.variance);
    shown =
        ((between * fit.weights.middleCols(3 * axis, 3)).rowwise() + fit.intercepts.segment(3 * axis, 3)).transpose();
  }
  prediction.remark = fmt::format("γ = {:g}, σ² = {:g}", setting.gamma, setting.variance);
  return prediction;
}

FieldPrediction as_in_the_paper(NineFunctions const& measured, std::uint64_t) {
  return by_ls_svm("ls_svm", std::array{0.2}, std::array{56.2}, measured);
}

FieldPrediction with_chosen_setting(NineFunctions const& measured, std::uint64_t) {
  return by_ls_svm("ls_svm_chosen", std::array{0.2, 0.4, 0.8, 1.6}, std::array{1.0, 10.0, 1e2, 1e3, 1e4, 1e5},
                   measured);
}

constexpr std::array methods = {
    PredictionMethod{"interpolation", "straight lines through the measured points", interpolated},
    PredictionMethod{"ls_svm", "LS-SVM, γ = 56.2, σ² = 0.2", as_in_the_paper},
    PredictionMethod{"ls_svm_chosen", "LS-SVM, γ and σ² by leaving one point out", with_chosen_setting},
    PredictionMethod{"network", "1-3-1 by back-propagation", by_network},
};

}  // namespace

std::span<PredictionMethod const> prediction_methods() { return methods; }

PredictionMethod const& prediction_method(std::string_view name) {
  std::vector<std::string> names;
  for (auto const& method : methods) {
    if (method.name == name) return method;
    names.emplace_back(method.name);
  }
  throw thermal::InputError(
      fmt::format("unknown method of prediction '{}'; {}", name, thermal::did_you_mean(std::string(name), names)));
}

PredictionScore score(FieldPrediction const& prediction, ErrorFunction const& truth, VolumeGrid const& grid) {
  auto const predicted = [&](Eigen::Vector3d const& q) { return prediction.functions.error(q); };
  ErrorField const real = without_rigid_motion(sample(truth, grid.positions()));
  ErrorField difference = without_rigid_motion(sample(predicted, grid.positions()));
  VectorXd const shown = um_per_m * difference.errors.reshaped(), expected = um_per_m * real.errors.reshaped();
  difference.errors -= real.errors;
  return {difference.root_mean_square(), difference.largest(), models::metrics(expected, shown).mape};
}

}  // namespace thermotwin::twin
