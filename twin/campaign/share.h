#pragma once

#include <string>

namespace thermotwin::twin {

/// The parts of a campaign that a process makes: those whose number leaves `index` when divided by `count`.
struct Share {
  int index = 0, count = 1;
};

/// "3/16": share 3 of 16, counted from 0. InputError otherwise.
[[nodiscard]] Share share_of(std::string const& text);

/// The share of a process that `mpirun` or `srun` started beside others: its rank of so many, which Open MPI, MPICH and
/// Slurm leave in the environment. The whole for a process that was started alone; InputError if they left nonsense.
[[nodiscard]] Share share_of_rank();

}  // namespace thermotwin::twin
