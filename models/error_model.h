#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "models/batch.h"

namespace thermotwin::models {

/// ŷ_t = b₀ + Σ_j Σ_l B_jl x_{j,t−lag_l}. Every linear method ends here (regression, ridge, principal components,
/// distributed lags). Instants before a run's first repeat its first row: before a run the machine rests, ΔT = 0.
struct LinearForm {
  double intercept = 0;          ///< [µm]
  std::vector<int> lags{0};      ///< [samples], ascending, none negative
  Eigen::MatrixXd coefficients;  ///< p × lags [µm/K]; column l multiplies the readings lags[l] samples ago
  int unfitted = 0;              ///< first instants of each batch that were history in the fit and nothing else
};

/// f(x) = Σ_k a_k exp(−g ‖x_k − x‖²) + b on scaled inputs and target: ε-SVR and LS-SVM.
struct KernelForm {
  Eigen::MatrixXd support;  ///< n × p, scaled
  Eigen::VectorXd weights;  ///< n
  double intercept = 0;
  double g = 1;                                ///< 1/σ² (ε-SVR), 1/(2σ²) (LS-SVM)
  Eigen::VectorXd input_offset, input_scale;   ///< p: x = (ΔT − offset) / scale
  double target_offset = 0, target_scale = 1;  ///< y = offset + scale f [µm]
};

/// h = s(W x − θ), y = v·h − θ₀ on scaled inputs and target, s the logistic function: methods.md §6.2.
struct NetworkForm {
  Eigen::MatrixXd weights;     ///< hidden × p
  Eigen::VectorXd thresholds;  ///< hidden
  Eigen::VectorXd output_weights;
  double output_threshold = 0;
  Eigen::VectorXd input_offset, input_scale;
  double target_offset = 0, target_scale = 1;
};

/// A fitted thermal-error model: it knows the names and the order of its inputs, and refuses others.
struct ErrorModel {
  std::string method;               ///< name in the catalogue
  std::vector<std::string> inputs;  ///< sensors, in the order of the form's columns
  double sample_period = 0;         ///< [s] of the data it was fitted to; lags count in it; 0 where there are none
  double parameters = 0;  ///< numbers that the fit determined, effective ones where a penalty or a kernel binds them
  std::variant<LinearForm, KernelForm, NetworkForm> form;
  std::string remark;  ///< what the fit found out: order of lags, penalty, components, (C, g)

  /// N errors [µm] for the batch's readings, found by name; a batch that lacks an input is refused by name, as is one
  /// whose sample period differs from the model's where lags count (std::invalid_argument).
  [[nodiscard]] Eigen::VectorXd predict(Batch const& batch) const;

  /// How many of a batch's first instants the method does not claim to predict, as the papers of distributed lags leave
  /// them out (N − n rows): what predict() says of them rests on ΔT = 0 before the run.
  [[nodiscard]] int unclaimed_instants() const;
};

struct FitOptions {
  std::uint64_t seed = 1;  ///< of starts and genetic search
  int folds = 5;           ///< of the blocked cross-validation (folds_of_runs)
};

/// A way of fitting. The catalogue below is what studies, files and the command line read.
struct ModelMethod {
  std::string_view name;     ///< as written in files, snake_case
  std::string_view meaning;  ///< one line
  std::string_view source;   ///< paper and section, or literature
  /// A model on all sensors of the batches (select columns before); refuses fewer samples than regressors, unless a
  /// penalty binds them, and sensors that do not move, by name (std::invalid_argument).
  ErrorModel (*fit)(std::span<Batch const>, FitOptions const&);
};

/// The methods of the papers in their order, then the ones that they lacked.
std::span<ModelMethod const> model_methods();

/// The method of that name; refuses others with the nearest known name (std::invalid_argument).
ModelMethod const& model_method(std::string_view name);

}  // namespace thermotwin::models
