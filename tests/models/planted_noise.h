#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <numbers>
#include <random>

namespace thermotwin::models {

/// Numbers of mean 0 and deviation 1 (Box and Muller), the same with every library.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : random_(seed) {}

  double even() { return (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53; }
  double operator()() {
    double const radius = std::sqrt(-2 * std::log(even()));
    return radius * std::cos(2 * std::numbers::pi * even());
  }
  Eigen::VectorXd series(Eigen::Index samples) {
    return Eigen::VectorXd::NullaryExpr(samples, [&] { return (*this)(); });
  }

 private:
  std::mt19937_64 random_;
};

/// x_t = memory x_{t−1} + noise, from the first sample on as it goes on.
inline Eigen::VectorXd autoregressive(Eigen::Index samples, double memory, Noise& noise) {
  Eigen::VectorXd x(samples);
  double value = noise() / std::sqrt(1 - memory * memory);
  for (auto& sample : x) sample = value = memory * value + noise();
  return x;
}

/// A body that warms up and cools down as its drive is switched at random: time constant and hold in samples.
inline Eigen::VectorXd thermal_state(Eigen::Index samples, double time_constant, int hold, Noise& noise) {
  Eigen::VectorXd state(samples);
  double value = 0, drive = 1;
  for (Eigen::Index i = 0; i < samples; ++i) {
    state(i) = value;
    if (i % hold == 0) drive = noise.even();
    value += (drive - value) / time_constant;
  }
  return state;
}

}  // namespace thermotwin::models
