#pragma once

#include <cstddef>
#include <random>

namespace thermotwin::models {

/// Even in [0, 1) from 53 bits: the same bytes with every library, unlike std::uniform_real_distribution.
inline double uniform_draw(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

/// Even in 0, 1, …, count − 1.
inline std::size_t index_draw(std::mt19937_64& random, std::size_t count) {
  return static_cast<std::size_t>(uniform_draw(random) * static_cast<double>(count));
}

}  // namespace thermotwin::models
