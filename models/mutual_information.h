#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace thermotwin::models {

enum class BinEdges {
  equal_width,      ///< between the least and the largest value
  equal_frequency,  ///< by ranks; equal values share a bin
};

/// Bins on each axis for N samples; at least 2.
enum class BinCount {
  sturges,            ///< ⌈log2 N⌉ + 1
  square_root,        ///< ⌊√N⌋
  cellucci,           ///< ⌊√(N/5)⌋: five samples expected per cell if x and y were independent
  freedman_diaconis,  ///< ⌈range / (2 IQR N^(−1/3))⌉ on each axis by itself, at most N
};

enum class BiasCorrection {
  none,          ///< plug-in: of independent data it is about (B − 1)²/(2N), not 0
  miller_madow,  ///< less (B_xy − B_x − B_y + 1)/(2N) with the numbers of occupied cells and bins
  shuffle_null,  ///< less the mean of what permutations of y give
};

struct MutualInformationOptions {
  BinEdges edges = BinEdges::equal_width;
  BinCount count = BinCount::cellucci;
  std::optional<int> bins{};  ///< on each axis, in place of the rule
  BiasCorrection bias = BiasCorrection::shuffle_null;
  int permutations = 199;
  Eigen::Index block = 1;  ///< samples that stay together in a permutation; of an autocorrelated record some memories
  std::uint64_t seed = 1;
};

/// I(x; y) = Σ_a Σ_b p_ab ln(p_ab / (p_a p_b)) [nats] from a histogram (methods.md §3.2).
struct MutualInformation {
  double value = 0;       ///< bias corrected
  double plug_in = 0;     ///< as counted
  double normalised = 0;  ///< value / √(H_x H_y), to compare sensors across runs
  double p_value = 1;     ///< (1 + permutations that give at least as much) / (1 + permutations)
  int bins_x = 0, bins_y = 0;
  Eigen::Index samples = 0;
  /// The bins of x tell those of y and conversely, I = H_x = H_y: no sensor could have more. Always so with bins of
  /// equal frequency on monotone records (I = ln B whatever the sensor); then the value ranks nothing.
  bool saturated = false;
};

/// A variable that never moves has I = 0, p = 1. Throws std::invalid_argument for different lengths, fewer than
/// 4 samples, values that are no numbers, fewer than 2 bins, a block of less than 1 sample.
MutualInformation mutual_information(Eigen::VectorXd const& x, Eigen::VectorXd const& y,
                                     MutualInformationOptions const& options = {});

/// The same without bins, from k nearest neighbours in the maximum norm [nats]:
///
///     I = ψ(k) + ψ(N) − ⟨ψ(n_x + 1) + ψ(n_y + 1)⟩,   n: samples nearer on that axis than the k-th neighbour in the
///     plane
///
/// Kraskov, Stögbauer, Grassberger, Phys. Rev. E 69 (2004) 066138, eq. 8. Both axes are scaled to unit deviation; ties
/// of quantised readings are broken by noise of 1e-9 of it. O(N²).
double nearest_neighbour_information(Eigen::VectorXd const& x, Eigen::VectorXd const& y, int neighbours = 4);

}  // namespace thermotwin::models
