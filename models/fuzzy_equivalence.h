#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/batch.h"
#include "models/selection.h"

namespace thermotwin::models {

/// r_ij = |correlation| of columns i and j; 1 on the diagonal. A column that never moves is like no other (0).
Eigen::MatrixXd correlation_similarity(Eigen::MatrixXd const& columns);

/// t(R): the least relation above R with t_ij ≥ max_k min(t_ik, t_kj), by squaring R ∘ R in max-min composition until
/// nothing changes (methods.md §3.8). Throws std::invalid_argument unless R is square, symmetric, within 0 to 1, and 1
/// on its diagonal.
Eigen::MatrixXd transitive_closure(Eigen::MatrixXd similarity);

/// The classes of i ~ j ⇔ t_ij ≥ λ (less 1e-12, for rounding), each ascending, in the order of their first members.
std::vector<std::vector<Eigen::Index>> classes_at(Eigen::MatrixXd const& closure, double lambda);

/// The values of λ at which classes change, falling: the different off-diagonal values of the closure. λ = 1 and above
/// parts what is not the same.
std::vector<double> levels_of(Eigen::MatrixXd const& closure);

/// The partition, of those that some λ gives, whose number of classes is nearest to `count`; of two the finer. A sweep
/// of λ can jump over a number: several levels may coincide.
std::vector<std::vector<Eigen::Index>> classes_nearest(Eigen::MatrixXd const& closure, int count);

/// The partition with the largest F − F_α(c − 1, n − c), α = 0.05, among those of 2 to n − 1 classes:
///
///     F = [Σ_g n_g ‖x̄_g − x̄‖²/(c − 1)] / [Σ_g Σ_{i∈g} ‖x_i − x̄_g‖²/(n − c)]
///
/// with one object x_i per row of `objects`. A partition whose classes hold identical objects only has no F: it stands
/// back behind all others, of which there may be none. The coarsest partition where no level gives 2 to n − 1 classes.
std::vector<std::vector<Eigen::Index>> classes_by_F(Eigen::MatrixXd const& closure, Eigen::MatrixXd const& objects);

/// Grey relation with fuzzy clustering (FC-GRD; papers 000 and 004): the sensors' fuzzy equivalence classes by |r|, and
/// of each class the sensor of the highest grey relational grade. With a count, the nearest number of classes, then cut
/// or filled up by grade; without one, λ by F on the standardised readings, turned towards the error's sign.
Selection select_by_grey_fuzzy_clustering(std::span<Batch const> batches, SelectionOptions const& options);

}  // namespace thermotwin::models
