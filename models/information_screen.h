#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "models/candidates.h"
#include "models/mutual_information.h"
#include "models/selection.h"

namespace thermotwin::models {

/// The candidates by what they tell about the error, and those that each component of the machine keeps: the local
/// pre-screen of methods.md §3.1-3.2.
struct InformationScreen {
  Eigen::VectorXd information;    ///< of each candidate, all batches pooled [nats]; histogram, less its shuffle null
  Eigen::VectorXd p_value;        ///< by permutation of single samples
  Eigen::VectorXd block_p_value;  ///< by permutation of blocks (independent_block): the honest one
  Eigen::VectorXd by_neighbours;  ///< information by nearest neighbours [nats], the cross-check
  Eigen::VectorXd bins;           ///< on the axis of each candidate
  Eigen::Index samples = 0, block = 1;
  std::vector<Eigen::Index> kept;  ///< ascending
  std::string remark;  ///< what to distrust: saturated bins, p ≥ 0.05 or no p, other sensors by nearest neighbours
};

/// Seed: of the permutations; the same for every sensor, so that equal sensors have equal information.
InformationScreen screen_by_information(Candidates const& from, std::uint64_t seed,
                                        MutualInformationOptions const& options = {});

/// Its figures, of each candidate.
std::vector<Evidence> evidence_of(Candidates const& from, InformationScreen const& screen);

/// In each component the `keep` columns of most information, all where it has no more; ascending.
std::vector<Eigen::Index> best_within_components(std::vector<std::string> const& components,
                                                 Eigen::VectorXd const& information, int keep = 2);

/// The first lag at which the autocorrelation of the record falls below 1/e [samples]; at least 1.
Eigen::Index memory_of(Eigen::VectorXd const& record);

/// How many samples stay together in a permutation: three times the record's memory, for the ends of two blocks must
/// not depend on each other either. Of independent AR(1) records, ρ = 0.9, 200 samples, 94 % then have p > 0.05, but 87
/// % with blocks of one memory (600 draws). A record of less than five blocks cannot tell: its p stays large.
Eigen::Index independent_block(Eigen::VectorXd const& record);

/// The screened sensors by falling information. With a count, as many of these; where they are too few, then the best
/// of the others.
Selection select_by_mutual_information(std::span<Batch const> batches, SelectionOptions const& options);

}  // namespace thermotwin::models
