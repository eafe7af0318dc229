#pragma once

#include <sched.h>

namespace thermotwin::twin {

/// While it lives, this process may compute on the cores of all MPI ranks of its node, for they wait for what it makes;
/// a launcher binds each to its own. Threads are OpenMP's times the number of ranks, as far as there are cores. Of a
/// process that no launcher started, nothing changes.
class NodeCores {
 public:
  NodeCores();
  ~NodeCores();
  NodeCores(NodeCores const&) = delete;
  NodeCores& operator=(NodeCores const&) = delete;

 private:
  bool widened_ = false;
  int threads_;
  cpu_set_t cores_{};
};

}  // namespace thermotwin::twin
