#include "twin/parallel.h"

#include <chrono>
#include <condition_variable>
#include <gtest/gtest.h>
#include <mutex>
#include <numeric>
#include <omp.h>
#include <stdexcept>
#include <vector>

#include "twin/run.h"

namespace thermotwin::twin {
namespace {

/// Where two have to be at the same time.
class Meeting {
 public:
  /// Whether the other came.
  bool arrive() {
    std::unique_lock lock(mutex_);
    ++present_;
    both_.notify_all();
    return both_.wait_for(lock, std::chrono::seconds(20), [&] { return present_ >= 2; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable both_;
  int present_ = 0;
};

TEST(InParallel, DoesEveryPieceOnceAlsoWithinPieces) {
  std::vector<std::vector<int>> done(7, std::vector<int>(50, 0));
  in_parallel(done.size(), [&](std::size_t i) { in_parallel(done[i].size(), [&](std::size_t k) { ++done[i][k]; }); });
  for (auto const& row : done) EXPECT_EQ(row, std::vector<int>(50, 1));
}

/// The first piece is done at once; of the second, two parts wait for each other.
TEST(InParallel, WhoHasNothingLeftTakesUpPartsOfWhatOthersHave) {
  if (omp_get_max_threads() < 2) GTEST_SKIP() << "one thread";
  Meeting meeting;
  std::vector<int> met(2, 0);
  in_parallel(2, [&](std::size_t i) {
    if (i == 1) in_parallel(2, [&](std::size_t k) { met[k] = meeting.arrive() ? 1 : 0; });
  });
  EXPECT_EQ(met, std::vector<int>(2, 1));
}

TEST(InParallel, ThrowsTheFirstExceptionByNumberWhenAllAreDone) {
  std::vector<int> done(20, 0);
  auto const work = [&](std::size_t i) {
    done[i] = 1;
    if (i % 5 == 3) throw std::runtime_error(std::to_string(i));
  };
  try {
    in_parallel(done.size(), work);
    FAIL() << "nothing was thrown";
  } catch (std::runtime_error const& error) {
    EXPECT_STREQ(error.what(), "3");
  }
  EXPECT_EQ(std::accumulate(done.begin(), done.end(), 0), 20);
}

TEST(InParallel, ThrowsWhatProgressThrows) {
  std::vector<int> done(20, 0);
  auto const full = [](double) { throw std::runtime_error("nobody can be told"); };
  EXPECT_THROW(in_parallel(done.size(), full, nullptr, [&](std::size_t i) { done[i] = 1; }), std::runtime_error);
  EXPECT_EQ(std::accumulate(done.begin(), done.end(), 0), 20);
}

TEST(InParallel, LeavesOutTheRestWhenStopped) {
  std::atomic<bool> stop = false;
  std::atomic<int> done = 0;
  double share = 0.0;
  auto const work = [&](std::size_t) {
    ++done;
    stop = true;
  };
  EXPECT_THROW(in_parallel(
                   1000, [&](double s) { share = s; }, &stop, work),
               Interrupted);
  EXPECT_LE(done, omp_get_max_threads());
  EXPECT_LE(share, 0.1);
}

TEST(InParts, HaveEveryThingOfEveryRunOnceAndNeverTooManyTogether) {
  for (std::size_t const count : {0, 1, 4, 5, 13}) {
    std::vector<std::vector<int>> done(3, std::vector<int>(count, 0));
    in_parts(3, count, 4, [&](std::size_t run, std::size_t first, std::size_t end) {
      EXPECT_GT(end, first);
      EXPECT_LE(end - first, 4u);
      for (std::size_t k = first; k < end; ++k) ++done[run][k];
    });
    for (auto const& row : done) EXPECT_EQ(row, std::vector<int>(count, 1));
  }
}

}  // namespace
}  // namespace thermotwin::twin
