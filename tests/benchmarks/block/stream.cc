// memory_bandwidth: a = b + s c on arrays that fit no cache, all threads, the best of ten; one line of JSON.
#include <chrono>
#include <cstdio>
#include <vector>

int main() {
  std::ptrdiff_t const n = 20'000'000;
  std::vector<double> a(std::size_t(n), 0.0), b(std::size_t(n), 1.0), c(std::size_t(n), 2.0);
  double best = 1e300;
  for (int round = 0; round < 10; ++round) {
    auto const begin = std::chrono::steady_clock::now();
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i) a[std::size_t(i)] = b[std::size_t(i)] + 0.5 * c[std::size_t(i)];
    std::chrono::duration<double> const taken = std::chrono::steady_clock::now() - begin;
    if (taken.count() < best) best = taken.count();
  }
  std::printf("{\"bytes_per_second\": %.4e, \"check\": %.1f}\n", 24.0 * double(n) / best, a[std::size_t(n / 2)]);
}
