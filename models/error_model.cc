#include "models/error_model.h"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

#include "models/gaussian_kernel.h"
#include "models/network.h"
#include "models/scaling.h"
#include "models/training_set.h"

namespace thermotwin::models {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double period_tolerance = 1e-3;

struct Prediction {
  Batch const& batch;  ///< with the model's inputs only

  VectorXd operator()(LinearForm const& form) const {
    VectorXd const prediction = with_lags(batch, form.lags) * form.coefficients.reshaped();
    return prediction.array() + form.intercept;
  }
  VectorXd operator()(KernelForm const& form) const {
    MatrixXd const x = scaled(batch.temperature_rise, form.input_offset, form.input_scale);
    VectorXd const f = gaussian_kernel(squared_distances(x, form.support), form.g) * form.weights;
    return form.target_offset + form.target_scale * (f.array() + form.intercept);
  }
  VectorXd operator()(NetworkForm const& form) const {
    MatrixXd const x = scaled(batch.temperature_rise, form.input_offset, form.input_scale);
    return form.target_offset + form.target_scale * network_output(form, x).array();
  }
};

void check_period(ErrorModel const& model, Batch const& batch) {
  auto const* form = std::get_if<LinearForm>(&model.form);
  if (!form || form->lags.back() == 0) return;
  double const period = sample_period(batch);
  if (std::abs(period - model.sample_period) > period_tolerance * model.sample_period)
    throw std::invalid_argument(
        fmt::format("batch '{}' has a sample every {:.6g} s; the lags of the model '{}' count "
                    "samples of {:.6g} s",
                    batch.name, period, model.method, model.sample_period));
}

}  // namespace

VectorXd ErrorModel::predict(Batch const& batch) const {
  check(batch);
  check_period(*this, batch);
  auto const own = with_sensors(batch, columns_of(batch, inputs));
  return std::visit(Prediction{own}, form);
}

int ErrorModel::unclaimed_instants() const {
  auto const* linear = std::get_if<LinearForm>(&form);
  return linear ? linear->unfitted : 0;
}

}  // namespace thermotwin::models
