#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace thermotwin::thermal {

/// Work on long arrays, shared among threads in blocks whose bounds depend on the length alone: a sum is that of the
/// blocks' sums in their order, so that the same bytes come out of any number of threads.
inline constexpr std::ptrdiff_t block_length = 4096;
inline constexpr std::ptrdiff_t worth_a_thread = 65536;  ///< below this many entries, waking threads costs more

/// visit(begin, end) for each block of [0, length).
template <class Visit>
void for_blocks(std::ptrdiff_t length, Visit const& visit) {
  std::ptrdiff_t const blocks = (length + block_length - 1) / block_length;
  auto const visit_block = [&](std::ptrdiff_t b) { visit(b * block_length, std::min(length, (b + 1) * block_length)); };
  if (length < worth_a_thread) {
    for (std::ptrdiff_t b = 0; b < blocks; ++b) visit_block(b);
    return;
  }
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t b = 0; b < blocks; ++b) visit_block(b);
}

/// visit(i) for each i of [begin, end), several at once: none may read what another writes.
template <class Visit>
void for_terms_within(std::ptrdiff_t begin, std::ptrdiff_t end, Visit const& visit) {
#pragma omp simd
  for (auto i = begin; i < end; ++i) visit(i);
}

/// visit(i) for each i of [0, length), likewise.
template <class Visit>
void for_terms(std::ptrdiff_t length, Visit const& visit) {
  for_blocks(length, [&](std::ptrdiff_t begin, std::ptrdiff_t end) { for_terms_within(begin, end, visit); });
}

/// Σ term(i) over [begin, end), in sixteen sums side by side: a single one would wait for itself at every term.
template <class Term>
double sum_within(std::ptrdiff_t begin, std::ptrdiff_t end, Term const& term) {
  constexpr std::ptrdiff_t lanes = 16;
  std::array<double, lanes> sums{};
  auto i = begin;
  for (; i + lanes <= end; i += lanes)
#pragma omp simd
    for (std::ptrdiff_t k = 0; k < lanes; ++k) sums[std::size_t(k)] += term(i + k);
  double sum = 0.0;
  for (double const s : sums) sum += s;
  for (; i < end; ++i) sum += term(i);
  return sum;
}

/// Σ part(begin, end) over the blocks of [0, length).
template <class Part>
double sum_of_blocks(std::ptrdiff_t length, Part const& part) {
  if (length <= block_length) return length > 0 ? part(std::ptrdiff_t(0), length) : 0.0;
  std::vector<double> sums(std::size_t((length + block_length - 1) / block_length));
  for_blocks(length, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    sums[std::size_t(begin / block_length)] = part(begin, end);
  });
  double sum = 0.0;
  for (double const s : sums) sum += s;
  return sum;
}

/// Σ term(i) over [0, length).
template <class Term>
double sum_of_terms(std::ptrdiff_t length, Term const& term) {
  return sum_of_blocks(length,
                       [&term](std::ptrdiff_t begin, std::ptrdiff_t end) { return sum_within(begin, end, term); });
}

}  // namespace thermotwin::thermal
