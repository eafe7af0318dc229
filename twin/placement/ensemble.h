#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scenarios/experiment.h"
#include "twin/file/value.h"
#include "twin/placement/candidate_sites.h"

namespace thermotwin::twin {

/// Which machines are put through what.
struct EnsembleOptions {
  int members = 100;
  std::uint64_t seed = 1;  ///< no machine is drawn by two seeds
  int first_member = 0;    ///< of all that a seed draws
  /// What every member is put through; none: two spectra drawn for each member anew, with a room of their own
  /// (challenge_runs: 16 h with blocks of 20 min, and about 13 h with blocks of 20 to 90 min).
  std::vector<scenarios::Experiment> experiments;
  int snapshots = 40;       ///< of a run, evenly spaced
  bool every_node = false;  ///< keep the temperatures of all nodes
  std::function<void(double)> progress;
  std::atomic<bool> const* stop = nullptr;
};

/// What sites and displacements do, over machines that could be the one of the file and over spectra: rows are
/// snapshots, of one run after another.
struct Ensemble {
  /// Rows of one member under one experiment.
  struct Run {
    int member = 0;
    std::string experiment;
    Eigen::Index first = 0, rows = 0;
  };

  std::vector<Run> runs;
  std::vector<std::string> channels;    ///< of displacement
  std::size_t numbers = 0, ranged = 0;  ///< of the file: drawn, and within a range that it states
  Eigen::MatrixXd rise;                 ///< rows × sites: since the start of the run [K]
  Eigen::MatrixXd displacement;         ///< rows × channels: since the start of the run [µm]
  Eigen::MatrixXf node_rise;            ///< rows × nodes [K], or empty
};

/// Draws members of the family that a machine file stands for (vary_parameters: within the ranges that the file states;
/// other coefficients 20 %, capacities and weights of the structural loop 10 %, lognormal) and runs them; all
/// displacements in µm are kept, rotations are not. The same seed draws the same ensemble, whatever the number of
/// threads. InputError for a machine without any displacement.
[[nodiscard]] Ensemble draw_ensemble(Value const& document, std::vector<CandidateSite> const& sites,
                                     EnsembleOptions const& options);

}  // namespace thermotwin::twin
