#pragma once

#include <cstdint>
#include <string_view>

namespace thermotwin::twin {

/// A permutation of 0 … count − 1 of which each entry is known without the others: four Feistel rounds on the smallest
/// power of four that holds `count`, walked along until it falls below `count` (Black & Rogaway, CT-RSA 2002, "cycle
/// walking"). The rounds draw from RandomStream(seed, name).
[[nodiscard]] std::int64_t permuted(std::int64_t index, std::int64_t count, std::uint64_t seed, std::string_view name);

/// Coordinate of a sample of a Latin hypercube along the dimension `name`:
///
///   x = (π(sample) + u)/count  in [0, 1),
///
/// π a permutation and u even in [0, 1), so that each of `count` strips of every dimension holds one sample. (McKay,
/// Beckman & Conover, Technometrics 21 (1979) 239.) A function of its arguments: no sample needs another.
[[nodiscard]] double latin_hypercube(std::int64_t sample, std::int64_t count, std::uint64_t seed,
                                     std::string_view name);

}  // namespace thermotwin::twin
