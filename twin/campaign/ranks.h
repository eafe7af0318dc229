#pragma once

#include "twin/campaign/share.h"

namespace thermotwin::twin {

/// The processes that `mpirun` or `srun` started together. MPI is not touched unless one of them did: the program
/// starts as fast as without it. A process that dies, or leaves by an exception, takes the others with it; what is done
/// by then stays.
class Ranks {
 public:
  Ranks();
  ~Ranks();
  Ranks(Ranks const&) = delete;
  Ranks& operator=(Ranks const&) = delete;

  /// This process and how many there are; 0 of 1 without MPI.
  [[nodiscard]] Share share() const { return share_; }
  /// Over all, on all; returns when all have come here.
  [[nodiscard]] double sum(double value) const;

 private:
  bool started_ = false;
  int exceptions_;  ///< in flight when this was made
  Share share_;
};

}  // namespace thermotwin::twin
