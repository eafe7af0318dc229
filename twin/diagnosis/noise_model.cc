#include "twin/diagnosis/noise_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace thermotwin::twin {

Eigen::VectorXd ChannelNoise::slow_along(Eigen::VectorXd const& time, Eigen::VectorXd const& values) const {
  double start = NAN, low = INFINITY, high = -INFINITY, way = 0.0;
  Eigen::VectorXd sigma = Eigen::VectorXd::Zero(values.size());
  for (Eigen::Index r = 0; r < values.size(); ++r) {
    if (r > 0) way *= std::exp(-(time[r] - time[r - 1]) / slow_time);
    if (double const v = values[r]; !std::isnan(v)) {
      if (std::isnan(start)) start = v;
      low = std::min(low, v);
      high = std::max(high, v);
      way = std::max(way, std::abs(v - start));
    }
    sigma[r] = way_share * way;
  }
  return sigma.array() + (slow + slow_share * std::max(0.0, high - low));
}

Whitening::Whitening(ChannelNoise const& noise, Eigen::VectorXd const& time, Eigen::VectorXd const& samples,
                     Eigen::VectorXd const& slow) {
  Eigen::Vector2d const stationary(noise.fast * noise.fast, 1.0);
  Eigen::Matrix2d P = stationary.asDiagonal();
  for (Eigen::Index r = 0; r < time.size(); ++r) {
    double const step = r == 0 ? 0.0 : time[r] - time[r - 1];
    Eigen::Vector2d const decay(std::exp(-step / noise.fast_time), std::exp(-step / noise.slow_time));
    P = decay.asDiagonal() * P * decay.asDiagonal();
    P.diagonal() += stationary.cwiseProduct(Eigen::Vector2d::Ones() - decay.cwiseAbs2());
    Row row{decay[0], decay[1], slow[r], 0.0, 0.0, 0.0};
    if (samples[r] > 0.0) {
      Eigen::Vector2d const seen(1.0, slow[r]);
      double const variance =
          seen.dot(P * seen) + noise.white * noise.white / samples[r] + noise.rounding * noise.rounding;
      Eigen::Vector2d const gain = P * seen / variance;
      P -= gain * gain.transpose() * variance;
      row = {decay[0], decay[1], slow[r], gain[0], gain[1], 1.0 / std::sqrt(variance)};
      log_scale_ += 0.5 * std::log(2.0 * std::numbers::pi * variance);
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
      double const innovation = value - fast - row.slow * slow;
      fast += row.fast_gain * innovation;
      slow += row.slow_gain * innovation;
      value = innovation * row.scale;
    }
  }
}

}  // namespace thermotwin::twin
