#pragma once

#include <Eigen/Core>
#include <vector>

namespace thermotwin::models {

/// The first of those in `among` (not empty) whose score is the largest. Scores that differ by less than 1e-9 of the
/// largest magnitude count as equal: rounding decides nothing.
Eigen::Index best(Eigen::VectorXd const& score, std::vector<Eigen::Index> const& among);

/// Those in `among`, the best first, then the best of the rest, and so on.
std::vector<Eigen::Index> ranked(Eigen::VectorXd const& score, std::vector<Eigen::Index> among);

/// `chosen` cut to `count`, or filled up to it with the best that it lacks.
std::vector<Eigen::Index> completed(std::vector<Eigen::Index> chosen, Eigen::Index count, Eigen::VectorXd const& score);

/// 0, 1, … count − 1.
std::vector<Eigen::Index> first_numbers(Eigen::Index count);

}  // namespace thermotwin::models
