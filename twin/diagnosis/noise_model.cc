#include "twin/diagnosis/noise_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace thermotwin::twin {

ChannelNoise ChannelNoise::along(Eigen::VectorXd const& values) const {
  double low = INFINITY, high = -INFINITY;
  for (double const v : values)
    if (!std::isnan(v)) {
      low = std::min(low, v);
      high = std::max(high, v);
    }
  ChannelNoise noise = *this;
  noise.slow += slow_share * std::max(0.0, high - low);
  noise.slow_share = 0.0;
  return noise;
}

Whitening::Whitening(ChannelNoise const& noise, Eigen::VectorXd const& time, Eigen::VectorXd const& samples) {
  Eigen::Vector2d const stationary(noise.fast * noise.fast, noise.slow * noise.slow);
  Eigen::Matrix2d P = stationary.asDiagonal();
  for (Eigen::Index r = 0; r < time.size(); ++r) {
    double const step = r == 0 ? 0.0 : time[r] - time[r - 1];
    Eigen::Vector2d const decay(std::exp(-step / noise.fast_time), std::exp(-step / noise.slow_time));
    P = decay.asDiagonal() * P * decay.asDiagonal();
    P.diagonal() += stationary.cwiseProduct(Eigen::Vector2d::Ones() - decay.cwiseAbs2());
    Row row{decay[0], decay[1], 0.0, 0.0, 0.0};
    if (samples[r] > 0.0) {
      double const variance = P.sum() + noise.white * noise.white / samples[r] + noise.rounding * noise.rounding;
      Eigen::Vector2d const gain = P.rowwise().sum() / variance;
      P -= gain * gain.transpose() * variance;
      row = {decay[0], decay[1], gain[0], gain[1], 1.0 / std::sqrt(variance)};
      log_scale_ += 0.5 * std::log(2.0 * std::numbers::pi * variance);
      ++count_;
    }
    rows_.push_back(row);
  }
}

void Whitening::apply(Eigen::Ref<Eigen::MatrixXd> signals) const {
  for (Eigen::Index c = 0; c < signals.cols(); ++c) {
    double fast = 0.0, slow = 0.0;
    for (Eigen::Index r = 0; r < signals.rows(); ++r) {
      Row const& row = rows_[std::size_t(r)];
      fast *= row.fast_decay;
      slow *= row.slow_decay;
      double& value = signals(r, c);
      if (row.scale == 0.0) {
        value = 0.0;
        continue;
      }
      double const innovation = value - fast - slow;
      fast += row.fast_gain * innovation;
      slow += row.slow_gain * innovation;
      value = innovation * row.scale;
    }
  }
}

}  // namespace thermotwin::twin
