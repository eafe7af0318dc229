#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace thermotwin::twin {

/// `work` for 0, 1, … count − 1, on all threads in any order; each must touch nothing but its own. Within such work, a
/// thread that has run out of its own takes up what the others still have. The first exception by number is thrown
/// again when all are done, one of `progress` too, which gets the share done. Interrupted when `stop` is set.
void in_parallel(std::size_t count, std::function<void(double)> const& progress, std::atomic<bool> const* stop,
                 std::function<void(std::size_t)> const& work);
inline void in_parallel(std::size_t count, std::function<void(std::size_t)> const& work) {
  in_parallel(count, {}, nullptr, work);
}

/// `work(first, end)` for `count` things, in parts that are as equal as can be, of `at_once` at most.
void in_parts(std::size_t count, std::size_t at_once,
              std::function<void(std::size_t first, std::size_t end)> const& work);
/// `work(run, first, end)` for `count` things in each run, likewise.
void in_parts(std::size_t runs, std::size_t count, std::size_t at_once,
              std::function<void(std::size_t run, std::size_t first, std::size_t end)> const& work);

}  // namespace thermotwin::twin
