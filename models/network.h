#pragma once

#include <Eigen/Core>
#include <string>

#include "models/error_model.h"
#include "models/scaling.h"
#include "models/training_set.h"

namespace thermotwin::models {

/// Nodes of the hidden layer for M inputs: 2M + 1 (Kolmogorov's rule; paper 003).
Eigen::Index hidden_nodes(Eigen::Index inputs);

/// Numbers of the network M-(2M+1)-1: weights and thresholds; 78 for five inputs.
Eigen::Index network_parameters(Eigen::Index inputs);

/// All numbers of a network in one row: W by columns, v, θ, θ₀ (the first 66 of 78 are weights), and back.
Eigen::VectorXd parameters_of(NetworkForm const& form);
NetworkForm network_of(Eigen::VectorXd const& parameters, Eigen::Index inputs);

/// y = v·s(W x − θ) − θ₀ for each row x of scaled inputs.
Eigen::VectorXd network_output(NetworkForm const& form, Eigen::MatrixXd const& x);

/// E = ½ Σ_t (ŷ_t − y_t)² of a network over scaled samples, as a function of its parameters.
class NetworkLoss {
 public:
  NetworkLoss(Eigen::MatrixXd x, Eigen::VectorXd y);

  [[nodiscard]] Eigen::Index samples() const { return y_.size(); }
  [[nodiscard]] Eigen::Index parameters() const { return network_parameters(x_.cols()); }
  double operator()(Eigen::VectorXd const& parameters);
  /// E in single precision, a part in 10⁵, in half the time: ranks the many of a genetic search.
  double rough(Eigen::VectorXd const& parameters);
  /// E, and ∂E/∂parameters in `gradient`.
  double with_gradient(Eigen::VectorXd const& parameters, Eigen::VectorXd& gradient);

 private:
  void forward(Eigen::VectorXd const& parameters);

  Eigen::MatrixXd x_;
  Eigen::VectorXd y_, residual_;
  Eigen::ArrayXXd hidden_, back_;
  Eigen::MatrixXf rough_x_;
  Eigen::VectorXf rough_y_, rough_residual_;
  Eigen::ArrayXXf rough_hidden_;
};

/// A training set with inputs and target between −1 and 1.
struct NetworkSamples {
  TrainingSet set;
  Scaling input, target;

  explicit NetworkSamples(std::span<Batch const> batches);
  [[nodiscard]] NetworkLoss loss() const;
  /// The model that these parameters are; its remark ends with what it has more parameters than samples, if it does.
  [[nodiscard]] ErrorModel model(std::string method, Eigen::VectorXd const& parameters, std::string remark) const;
};

}  // namespace thermotwin::models
