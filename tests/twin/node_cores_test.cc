#include "twin/node_cores.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <omp.h>

namespace thermotwin::twin {
namespace {

int cores() {
  cpu_set_t set;
  sched_getaffinity(0, sizeof set, &set);
  return CPU_COUNT(&set);
}

/// Bound to one core and one thread, as a launcher leaves a rank.
class NodeCoresOfARank : public testing::Test {
 protected:
  void SetUp() override {
    sched_getaffinity(0, sizeof before_, &before_);
    threads_ = omp_get_max_threads();
    cpu_set_t one;
    CPU_ZERO(&one);
    int first = 0;
    while (!CPU_ISSET(first, &before_)) ++first;
    CPU_SET(first, &one);
    ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
    omp_set_num_threads(1);
  }
  void TearDown() override {
    unsetenv("OMPI_COMM_WORLD_LOCAL_SIZE");
    sched_setaffinity(0, sizeof before_, &before_);
    omp_set_num_threads(threads_);
  }
  cpu_set_t before_{};
  int threads_ = 1;
};

TEST_F(NodeCoresOfARank, AreThoseOfAllItsRanksWhileTheyWait) {
  int const there = CPU_COUNT(&before_);
  setenv("OMPI_COMM_WORLD_LOCAL_SIZE", "3", 1);
  {
    NodeCores const all;
    EXPECT_GE(cores(), there);
    EXPECT_EQ(omp_get_max_threads(), std::min(3, cores()));
  }
  EXPECT_EQ(cores(), 1);
  EXPECT_EQ(omp_get_max_threads(), 1);
}

TEST_F(NodeCoresOfARank, StayItsOwnWithoutALauncher) {
  NodeCores const all;
  EXPECT_EQ(cores(), 1);
  EXPECT_EQ(omp_get_max_threads(), 1);
}

}  // namespace
}  // namespace thermotwin::twin
