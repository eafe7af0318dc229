#include "models/batch_statistics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Mean and standard deviation (divisor n − 1) of each row.
void describe_rows(MatrixXd const& values, VectorXd& mean, VectorXd& deviation) {
  mean = values.rowwise().mean();
  deviation = ((values.colwise() - mean).rowwise().squaredNorm() / static_cast<double>(values.cols() - 1)).cwiseSqrt();
}

}  // namespace

double residual_deviation(VectorXd const& truth, VectorXd const& prediction, double parameters) {
  if (truth.size() != prediction.size())
    throw std::invalid_argument(fmt::format("{} true values and {} predicted ones", truth.size(), prediction.size()));
  auto const samples = static_cast<double>(truth.size());
  double const freedom = parameters < samples ? samples - parameters : samples;
  return std::sqrt((truth - prediction).squaredNorm() / freedom);
}

MatrixXd deviation_matrix(std::span<VectorXd const> errors, std::vector<std::vector<VectorXd>> const& predictions,
                          std::span<double const> parameters) {
  if (predictions.size() != parameters.size() || predictions.size() > errors.size())
    throw std::invalid_argument(fmt::format("{} models, {} numbers of parameters, {} batches", predictions.size(),
                                            parameters.size(), errors.size()));
  MatrixXd deviations(static_cast<Index>(predictions.size()), static_cast<Index>(errors.size()));
  for (std::size_t l = 0; l < predictions.size(); ++l) {
    if (predictions[l].size() != errors.size())
      throw std::invalid_argument(
          fmt::format("model {} predicts {} batches; there are {}", l + 1, predictions[l].size(), errors.size()));
    for (std::size_t k = 0; k < errors.size(); ++k) {
      auto const& prediction = predictions[l][k];
      VectorXd const truth = errors[k].tail(std::min(prediction.size(), errors[k].size()));
      deviations(static_cast<Index>(l), static_cast<Index>(k)) =
          residual_deviation(truth, prediction, k == l ? parameters[l] : 0.0);
    }
  }
  return deviations;
}

BatchStatistics batch_statistics(MatrixXd const& deviations) {
  Index const models = deviations.rows(), unseen = deviations.cols() - models;
  if (models < 3 || unseen < 0 || unseen == 1)
    throw std::invalid_argument(
        fmt::format("{} models on {} batches; needed are at least three models, one for each "
                    "of the first batches, and none or at least two batches more",
                    models, deviations.cols()));
  MatrixXd others(models, models - 1);
  for (Index l = 0; l < models; ++l)
    others.row(l) << deviations.row(l).head(l), deviations.row(l).segment(l + 1, models - 1 - l);
  BatchStatistics result;
  result.S = deviations.leftCols(models).diagonal();
  describe_rows(others, result.Mn, result.Sd);
  if (unseen > 0) describe_rows(deviations.rightCols(unseen), result.verification_Mn, result.verification_Sd);
  return result;
}

}  // namespace thermotwin::models
