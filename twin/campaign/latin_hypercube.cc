#include "twin/campaign/latin_hypercube.h"

#include <fmt/format.h>

#include "twin/instruments/random_stream.h"

namespace thermotwin::twin {
namespace {

constexpr int rounds = 4;

/// Even among 0 … 2^bits − 1.
std::uint64_t drawn(std::uint64_t seed, std::string_view name, int round, std::uint64_t half, int bits) {
  RandomStream stream(seed ^ (half << 8U) ^ std::uint64_t(round), name);
  return std::uint64_t(stream.uniform() * double(std::uint64_t(1) << unsigned(bits)));
}

}  // namespace

std::int64_t permuted(std::int64_t index, std::int64_t count, std::uint64_t seed, std::string_view name) {
  int bits = 1;
  while ((std::int64_t(1) << unsigned(2 * bits)) < count) ++bits;
  std::uint64_t const mask = (std::uint64_t(1) << unsigned(bits)) - 1;
  auto at = std::uint64_t(index);
  do {
    std::uint64_t left = at >> unsigned(bits), right = at & mask;
    for (int round = 0; round < rounds; ++round) {
      std::uint64_t const next = left ^ drawn(seed, name, round, right, bits);
      left = right;
      right = next;
    }
    at = (left << unsigned(bits)) | right;
  } while (at >= std::uint64_t(count));
  return std::int64_t(at);
}

double latin_hypercube(std::int64_t sample, std::int64_t count, std::uint64_t seed, std::string_view name) {
  auto const strip = permuted(sample, count, seed, name);
  RandomStream within(seed, fmt::format("{}[{}]", name, sample));
  return (double(strip) + within.uniform()) / double(count);
}

}  // namespace thermotwin::twin
