#include "twin/volumetric/field_prediction.h"

#include <array>
#include <cmath>
#include <ctime>
#include <fmt/format.h>

#include "models/back_propagation.h"
#include "models/contiguous_folds.h"
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
constexpr double to_um = 1e6;

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
      auto const batch = batch_of(coordinates(given.cols()), to_um * given.row(i).transpose());
      double const start = processor_time();
      auto const model = models::fit_back_propagation({&batch, 1}, {.seed = seed});
      prediction.training_time += processor_time() - start;
      prediction.remark = model.remark;
      shown.row(i) = model.predict(batch_of(fine, VectorXd::Zero(fine.size()))).transpose() / to_um;
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
struct Setting {
  double variance, gamma;
};

MatrixXd kernel_between(VectorXd const& a, VectorXd const& b, double variance) {
  return models::gaussian_kernel(models::squared_distances(a, b), 1.0 / (2.0 * variance));
}

models::LeastSquaresSupportVector trained(VectorXd const& u, VectorXd const& y, Setting const& setting) {
  return models::solve_least_squares(kernel_between(u, u, setting.variance), y, setting.gamma);
}

/// On −1 … 1 along the axis.
FieldPrediction with_setting(std::string_view name, NineFunctions const& measured, Setting const& setting) {
  FieldPrediction prediction{std::string(name), dense(measured), 0.0, ""};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto const& given = measured.values[axis];
    auto& shown = prediction.functions.values[axis];
    VectorXd const u = coordinates(given.cols()), fine = coordinates(shown.cols());
    MatrixXd const between = kernel_between(fine, u, setting.variance);
    for (Eigen::Index i = 0; i < 3; ++i) {
      double const start = processor_time();
      auto const fit = trained(u, given.row(i).transpose(), setting);
      prediction.training_time += processor_time() - start;
      shown.row(i) = ((between * fit.weights).array() + fit.intercept).transpose();
    }
  }
  prediction.remark = fmt::format("γ = {:g}, σ² = {:g}", setting.gamma, setting.variance);
  return prediction;
}

FieldPrediction as_in_the_paper(NineFunctions const& measured, std::uint64_t) {
  return with_setting("ls_svm", measured, {0.2, 56.2});
}

/// Σ of the squared error of what each of five stretches was predicted to be by the rest [µm²].
double left_out_error(VectorXd const& u, VectorXd const& y, Setting const& setting) {
  double sum = 0.0;
  for (auto const& fold : models::contiguous_folds(u.size(), int(std::min<Eigen::Index>(5, u.size())))) {
    auto const rows = models::rows_outside(fold, u.size());
    VectorXd const rest = u(rows), left_out = u.segment(fold.first, fold.count);
    auto const fit = trained(rest, y(rows), setting);
    VectorXd const found = (kernel_between(left_out, rest, setting.variance) * fit.weights).array() + fit.intercept;
    sum += (found - y.segment(fold.first, fold.count)).squaredNorm();
  }
  return to_um * to_um * sum;
}

Setting chosen(NineFunctions const& measured) {
  Setting best{0.2, 56.2};
  double least = std::numeric_limits<double>::infinity();
  for (double const variance : {0.08, 0.2, 0.4, 0.8, 2.0, 4.0})
    for (double const gamma : {1.0, 3.0, 10.0, 30.0, 1e2, 1e3, 1e4, 1e5}) {
      double sum = 0.0;
      for (auto const& values : measured.values)
        for (Eigen::Index i = 0; i < 3; ++i)
          sum += left_out_error(coordinates(values.cols()), values.row(i).transpose(), {variance, gamma});
      if (sum < least) {
        least = sum;
        best = {variance, gamma};
      }
    }
  return best;
}

FieldPrediction with_chosen_setting(NineFunctions const& measured, std::uint64_t) {
  double const start = processor_time();
  Setting const setting = chosen(measured);
  double const searching = processor_time() - start;
  auto prediction = with_setting("ls_svm_chosen", measured, setting);
  prediction.training_time += searching;
  return prediction;
}

constexpr std::array methods = {
    PredictionMethod{"interpolation", "straight lines through the measured points", interpolated},
    PredictionMethod{"ls_svm", "LS-SVM, γ = 56.2, σ² = 0.2", as_in_the_paper},
    PredictionMethod{"ls_svm_chosen", "LS-SVM, γ and σ² by blocked cross-validation", with_chosen_setting},
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
  VectorXd const shown = to_um * difference.errors.reshaped(), expected = to_um * real.errors.reshaped();
  difference.errors -= real.errors;
  return {difference.root_mean_square(), difference.largest(), models::metrics(expected, shown).mape};
}

}  // namespace thermotwin::twin
