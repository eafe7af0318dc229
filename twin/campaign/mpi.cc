// The only file that knows MPI: its C interface.
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <mpi.h>

#include "twin/campaign/ranks.h"

namespace thermotwin::twin {
namespace {

/// What mpirun of Open MPI, MPICH's Hydra and Slurm with PMIx leave in the environment.
bool launched_together() {
  constexpr std::array names = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"};
  return std::any_of(names.begin(), names.end(), [](char const* name) { return std::getenv(name) != nullptr; });
}

}  // namespace

Ranks::Ranks() : exceptions_(std::uncaught_exceptions()) {
  int initialised = 0;
  if (!launched_together() || (MPI_Initialized(&initialised), initialised)) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  started_ = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &share_.index);
  MPI_Comm_size(MPI_COMM_WORLD, &share_.count);
}

Ranks::~Ranks() {
  if (started_ && std::uncaught_exceptions() == exceptions_) MPI_Finalize();
}

double Ranks::sum(double value) const {
  double all = value;
  if (started_) MPI_Allreduce(&value, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

}  // namespace thermotwin::twin
