#include "twin/node_cores.h"

#include <algorithm>
#include <cstdlib>
#include <omp.h>

namespace thermotwin::twin {
namespace {

/// Of this node; 1 where the launcher does not tell.
int ranks() {
  for (auto const* variable : {"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS", "SLURM_NTASKS_PER_NODE"})
    if (char const* value = std::getenv(variable)) return std::max(1, std::atoi(value));
  return 1;
}

}  // namespace

NodeCores::NodeCores() : threads_(omp_get_max_threads()) {
  int const count = ranks();
  if (count == 1 || sched_getaffinity(0, sizeof cores_, &cores_) != 0) return;
  cpu_set_t all;
  CPU_ZERO(&all);
  for (int core = 0; core < CPU_SETSIZE; ++core) CPU_SET(core, &all);  // those that the node does not give are ignored
  if (sched_setaffinity(0, sizeof all, &all) != 0 || sched_getaffinity(0, sizeof all, &all) != 0) return;
  widened_ = true;
  omp_set_num_threads(std::clamp(count * threads_, threads_, std::max(threads_, CPU_COUNT(&all))));
}

NodeCores::~NodeCores() {
  if (!widened_) return;
  omp_set_num_threads(threads_);
  sched_setaffinity(0, sizeof cores_, &cores_);
}

}  // namespace thermotwin::twin
