#include "twin/parallel.h"

#include <exception>
#include <omp.h>
#include <vector>

#include "twin/run.h"

namespace thermotwin::twin {

void in_parallel(std::size_t count, std::function<void(double)> const& progress, std::atomic<bool> const* stop,
                 std::function<void(std::size_t)> const& work) {
  std::vector<std::exception_ptr> thrown(count);
  std::size_t done = 0;
  auto const one = [&](std::size_t i) {
    if (stop && *stop) return;
    try {
      work(i);
    } catch (...) {
      thrown[i] = std::current_exception();
    }
#pragma omp critical(thermotwin_progress)
    {
      try {
        if (progress) progress(double(++done) / double(count));
      } catch (...) {
        if (!thrown[i]) thrown[i] = std::current_exception();
      }
    }
  };
  auto const tasks = [&] {
    for (std::size_t i = 0; i < count; ++i) {
#pragma omp task firstprivate(i) shared(one)
      one(i);
    }
  };
  if (omp_in_parallel()) {
#pragma omp taskgroup
    tasks();
  } else {
    // Ends at the barrier, where a thread takes any task; at the end of a group only one of that group's own.
#pragma omp parallel
#pragma omp single
    tasks();
  }
  for (auto const& exception : thrown)
    if (exception) std::rethrow_exception(exception);
  if (stop && *stop) throw Interrupted("stopped; nothing was written");
}

void in_parts(std::size_t count, std::size_t at_once,
              std::function<void(std::size_t first, std::size_t end)> const& work) {
  in_parts(1, count, at_once, [&](std::size_t, std::size_t first, std::size_t end) { work(first, end); });
}

void in_parts(std::size_t runs, std::size_t count, std::size_t at_once,
              std::function<void(std::size_t run, std::size_t first, std::size_t end)> const& work) {
  std::size_t const parts = (count + at_once - 1) / at_once;
  in_parallel(runs * parts, [&](std::size_t i) {
    std::size_t const part = i % parts;
    work(i / parts, count * part / parts, count * (part + 1) / parts);
  });
}

}  // namespace thermotwin::twin
