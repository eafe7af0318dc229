#include "models/network.h"

#include <fmt/format.h>

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::Map;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A network's numbers where they lie in the row of all of them.
template <class Row>
struct Layout {
  using Number = typename Row::Scalar;
  using AnyMatrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
  using AnyVector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
  using Scalar = std::conditional_t<std::is_const_v<Row>, Number const, Number>;
  using Matrix = std::conditional_t<std::is_const_v<Row>, AnyMatrix const, AnyMatrix>;
  using Vector = std::conditional_t<std::is_const_v<Row>, AnyVector const, AnyVector>;
  Map<Matrix> weights;
  Map<Vector> output_weights, thresholds;
  Scalar& output_threshold;

  Layout(Row& row, Index inputs, Index hidden)
      : weights(row.data(), hidden, inputs),
        output_weights(row.data() + hidden * inputs, hidden),
        thresholds(row.data() + hidden * (inputs + 1), hidden),
        output_threshold(row(row.size() - 1)) {}
};

}  // namespace

Index hidden_nodes(Index inputs) { return 2 * inputs + 1; }

Index network_parameters(Index inputs) { return hidden_nodes(inputs) * (inputs + 2) + 1; }

VectorXd parameters_of(NetworkForm const& form) {
  VectorXd row(form.weights.size() + 2 * form.thresholds.size() + 1);
  Layout<VectorXd> layout(row, form.weights.cols(), form.weights.rows());
  layout.weights = form.weights;
  layout.output_weights = form.output_weights;
  layout.thresholds = form.thresholds;
  layout.output_threshold = form.output_threshold;
  return row;
}

NetworkForm network_of(VectorXd const& parameters, Index inputs) {
  Layout<VectorXd const> const layout(parameters, inputs, hidden_nodes(inputs));
  NetworkForm form;
  form.weights = layout.weights;
  form.thresholds = layout.thresholds;
  form.output_weights = layout.output_weights;
  form.output_threshold = layout.output_threshold;
  return form;
}

VectorXd network_output(NetworkForm const& form, MatrixXd const& x) {
  Eigen::ArrayXXd const z = (x * form.weights.transpose()).rowwise() - form.thresholds.transpose();
  MatrixXd const hidden = (1.0 + (-z).exp()).inverse();
  return (hidden * form.output_weights).array() - form.output_threshold;
}

NetworkLoss::NetworkLoss(MatrixXd x, VectorXd y)
    : x_(std::move(x)),
      y_(std::move(y)),
      hidden_(x_.rows(), hidden_nodes(x_.cols())),
      rough_x_(x_.cast<float>()),
      rough_y_(y_.cast<float>()),
      rough_hidden_(x_.rows(), hidden_nodes(x_.cols())) {}

void NetworkLoss::forward(VectorXd const& parameters) {
  Layout<VectorXd const> const layout(parameters, x_.cols(), hidden_nodes(x_.cols()));
  hidden_.matrix().noalias() = x_ * layout.weights.transpose();
  hidden_.rowwise() -= layout.thresholds.transpose().array();
  hidden_ = (1.0 + (-hidden_).exp()).inverse();
  residual_.noalias() = hidden_.matrix() * layout.output_weights - y_;
  residual_.array() -= layout.output_threshold;
}

double NetworkLoss::operator()(VectorXd const& parameters) {
  forward(parameters);
  return 0.5 * residual_.squaredNorm();
}

double NetworkLoss::rough(VectorXd const& parameters) {
  Eigen::VectorXf const row = parameters.cast<float>();
  Layout<Eigen::VectorXf const> const layout(row, x_.cols(), hidden_nodes(x_.cols()));
  rough_hidden_.matrix().noalias() = rough_x_ * layout.weights.transpose();
  rough_hidden_.rowwise() -= layout.thresholds.transpose().array();
  rough_hidden_ = (1.0F + (-rough_hidden_).exp()).inverse();
  rough_residual_.noalias() = rough_hidden_.matrix() * layout.output_weights - rough_y_;
  rough_residual_.array() -= layout.output_threshold;
  return 0.5 * double(rough_residual_.squaredNorm());
}

double NetworkLoss::with_gradient(VectorXd const& parameters, VectorXd& gradient) {
  forward(parameters);
  gradient.resize(parameters.size());
  Layout<VectorXd const> const at(parameters, x_.cols(), hidden_nodes(x_.cols()));
  Layout<VectorXd> slope(gradient, x_.cols(), hidden_nodes(x_.cols()));
  slope.output_weights.noalias() = hidden_.matrix().transpose() * residual_;
  slope.output_threshold = -residual_.sum();
  back_ = (residual_ * at.output_weights.transpose()).array() * hidden_ * (1.0 - hidden_);
  slope.weights.noalias() = back_.matrix().transpose() * x_;
  slope.thresholds = -back_.matrix().colwise().sum().transpose();
  return 0.5 * residual_.squaredNorm();
}

NetworkSamples::NetworkSamples(std::span<Batch const> batches)
    : set(training_set(batches)),
      input(range_scaling(set.regressors, -1.0, 1.0)),
      target(range_scaling(set.error, -1.0, 1.0)) {
  require_samples(set, set.regressors.cols() + 2);
}

NetworkLoss NetworkSamples::loss() const { return {scaled(set.regressors, input), scaled(set.error, target)}; }

ErrorModel NetworkSamples::model(std::string method, VectorXd const& parameters, std::string remark) const {
  auto form = network_of(parameters, set.regressors.cols());
  form.input_offset = input.offset;
  form.input_scale = input.scale;
  form.target_offset = target.offset(0);
  form.target_scale = target.scale(0);
  if (parameters.size() >= set.error.size())
    remark += fmt::format("; {} parameters for {} samples", parameters.size(), set.error.size());
  return {std::move(method), set.inputs,       set.sample_period, static_cast<double>(parameters.size()),
          std::move(form),   std::move(remark)};
}

}  // namespace thermotwin::models
