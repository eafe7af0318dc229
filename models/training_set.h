#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "models/batch.h"
#include "models/error_model.h"

namespace thermotwin::models {

/// The instants of all batches one below the other, each with the readings of earlier instants of its own run: what a
/// method fits.
struct TrainingSet {
  std::vector<std::string> inputs;        ///< p
  double sample_period = 0;               ///< [s]; 0 without lags
  std::vector<int> lags;                  ///< [samples]
  Eigen::MatrixXd regressors;             ///< N × (p lags): column l p + j is input j, lags[l] samples ago [K]
  Eigen::VectorXd error;                  ///< N [µm]
  std::vector<Eigen::Index> run_lengths;  ///< rows of each run
  int dropped = 0;                        ///< first instants of each run that are only history
};

/// What stands for the readings before a run's first instant. (Those before a batch that was cut out of a run are
/// known: Batch::before.)
enum class History {
  dropped,  ///< nothing: the first max(lags) instants serve only as history (methods.md §7.1, N − n rows)
  rest,     ///< the first row: before a run the machine rests
};

/// Refuses by name (std::invalid_argument): batches that fail check(), whose sensors differ, or, where lags count,
/// whose sample periods differ or vary; sensors that do not move in any batch; batches no longer than the lags drop.
TrainingSet training_set(std::span<Batch const> batches, std::vector<int> const& lags = {0},
                         History history = History::dropped);

/// Column l p + j: readings of sensor j, lags[l] instants before; the first of the run where there is none.
Eigen::MatrixXd with_lags(Batch const& batch, std::vector<int> const& lags);

/// How many of the batch's first instants lack the readings `lag` instants before.
Eigen::Index without_history(Batch const& batch, int lag);

/// The time between samples [s]; refuses one instant and times whose steps differ from their upper median by more than
/// 1 %.
double sample_period(Batch const& batch);

/// "T3" or "T3, 2 samples ago": the regressors in order, for messages.
std::vector<std::string> regressor_names(TrainingSet const& set);

/// Refuses a set with fewer than `needed` samples.
void require_samples(TrainingSet const& set, Eigen::Index needed);

/// The model that these coefficients of the set's regressors are. The remark says so where samples are fewer than
/// regressors and intercept, and a penalty or the choice of components decides between them.
ErrorModel linear_model(std::string method, TrainingSet const& set, double intercept,
                        Eigen::VectorXd const& coefficients, double parameters, std::string remark);

}  // namespace thermotwin::models
