#pragma once

#include <cmath>
#include <fmt/format.h>
#include <random>

#include "models/batch.h"

namespace thermotwin::models {

/// Even in [0, 1).
inline double uniform(std::mt19937_64& generator) { return double(generator() >> 11) * 0x1p-53; }

/// Nearly normal with variance 1: the sum of twelve.
inline double normal(std::mt19937_64& generator) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += uniform(generator);
  return sum;
}

/// Names T1, T2, …, instants every minute.
inline Batch batch_of(Eigen::MatrixXd const& temperature_rise, Eigen::VectorXd const& error) {
  Batch batch{
      "test", Eigen::VectorXd::LinSpaced(error.size(), 0, 60.0 * double(error.size() - 1)), {}, {}, temperature_rise,
      error};
  for (Eigen::Index j = 0; j < temperature_rise.cols(); ++j) {
    batch.sensors.push_back(fmt::format("T{}", j + 1));
    batch.components.push_back("spindle");
  }
  return batch;
}

/// Independent random walks; the error is 3 × the second sensor − 2 × the last, and a little noise.
inline Batch random_walks(std::uint64_t seed, Eigen::Index instants, Eigen::Index sensors) {
  std::mt19937_64 generator(seed);
  Eigen::MatrixXd rise = Eigen::MatrixXd::Zero(instants, sensors);
  for (Eigen::Index row = 1; row < instants; ++row)
    for (Eigen::Index j = 0; j < sensors; ++j) rise(row, j) = rise(row - 1, j) + 0.3 * normal(generator);
  Eigen::VectorXd error = 3 * rise.col(1) - 2 * rise.col(sensors - 1);
  for (auto& e : error) e += 0.1 * normal(generator);
  return batch_of(rise, error);
}

/// Warm-up ΔT = rise (1 − exp(−t/τ)), t in minutes, read with noise and rounded.
inline Eigen::VectorXd warm_up(double rise, double minutes, Eigen::Index instants, double noise,
                               std::mt19937_64& generator) {
  Eigen::VectorXd readings(instants);
  for (Eigen::Index t = 0; t < instants; ++t)
    readings(t) = rise * (1 - std::exp(-double(t) / minutes)) + (t > 0 ? noise * normal(generator) : 0.0);
  return readings;
}

}  // namespace thermotwin::models
