// memory_bandwidth: a = b + s c, on arrays that fit no cache with all threads, and on arrays that fit the nearest cache
// of one core; the best of ten; one line of JSON.
#include <chrono>
#include <cstdio>
#include <omp.h>
#include <vector>

namespace {

double bytes_per_second(std::ptrdiff_t n, int sweeps, int threads) {
  std::vector<double> sum(std::size_t(n), 0.0), first(std::size_t(n), 1.0), second(std::size_t(n), 2.0);
  double* const a = sum.data();
  double const *const b = first.data(), *const c = second.data();
  double best = 1e300;
  for (int round = 0; round < 10; ++round) {
    auto const begin = std::chrono::steady_clock::now();
#pragma omp parallel num_threads(threads)
    for (int sweep = 0; sweep < sweeps; ++sweep)
#pragma omp for simd schedule(static)
      for (std::ptrdiff_t i = 0; i < n; ++i) a[i] = b[i] + 0.5 * c[i];
    std::chrono::duration<double> const taken = std::chrono::steady_clock::now() - begin;
    if (taken.count() < best) best = taken.count();
  }
  return 24.0 * double(n) * sweeps / best;
}

}  // namespace

int main() {
  std::printf("{\"bytes_per_second\": %.4e, \"cache_bytes_per_second\": %.4e}\n",
              bytes_per_second(60'000'000, 1, omp_get_max_threads()), bytes_per_second(1024, 20'000, 1));
}
