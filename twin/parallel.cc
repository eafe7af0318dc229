#include "twin/parallel.h"

#include <exception>
#include <vector>

#include "twin/run.h"

namespace thermotwin::twin {

void in_parallel(std::size_t count, std::function<void(double)> const& progress, std::atomic<bool> const* stop,
                 std::function<void(std::size_t)> const& work) {
  std::vector<std::exception_ptr> thrown(count);
  std::size_t done = 0;
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < count; ++i) {
    if (stop && *stop) continue;
    try {
      work(i);
    } catch (...) {
      thrown[i] = std::current_exception();
    }
#pragma omp critical(thermotwin_progress)
    if (progress) progress(double(++done) / double(count));
  }
  for (auto const& exception : thrown)
    if (exception) std::rethrow_exception(exception);
  if (stop && *stop) throw Interrupted("stopped; nothing was written");
}

}  // namespace thermotwin::twin
