#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

namespace thermotwin::twin {

/// Random numbers that belong to a seed and a name, so that one channel's numbers do not depend on which others exist.
///
///   x_k = mix(key + (k + 1) γ),   key = mix(mix(seed) xor FNV-1a(name)),   γ = 2^64/golden ratio
///
/// `mix` is the finaliser of SplitMix64 (Steele, Lea & Flood, OOPSLA 2014). Integers alone until the last step: the
/// same bytes with every compiler, library and number of threads.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name) : counter_(mix(mix(seed) ^ hash(name))) {}

  /// Even in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(next() >> 11U) * 0x1p-53; }

  /// Even in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Even in the logarithm, within [low, high); `low` where both are equal.
  double log_uniform(double low, double high) { return low < high ? low * std::pow(high / low, uniform()) : low; }

  /// Normal with mean 0 and variance 1. (Box & Muller 1958)
  double normal() {
    double const radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

  /// Normal with this standard deviation, drawn again while beyond ±limit: what a maker delivers who guarantees a
  /// limit.
  double within(double deviation, double limit) {
    double x = deviation * normal();
    while (std::abs(x) > limit) x = deviation * normal();
    return x;
  }

 private:
  static constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U;

  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  static constexpr std::uint64_t hash(std::string_view name) {
    std::uint64_t h = 0xcbf29ce484222325U;
    for (char const c : name) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return h;
  }
  std::uint64_t next() { return mix(counter_ += golden); }

  std::uint64_t counter_;
};

}  // namespace thermotwin::twin
