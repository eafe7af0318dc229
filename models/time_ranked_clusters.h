#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <utility>

#include "models/candidates.h"

namespace thermotwin::models {

/// What a sensor's course is before it is clustered: the temperature rise itself (clusters by amplitude), or that
/// brought to [0, 1] (clusters by shape). The patent does not say which (methods.md §4.3).
enum class ClusterScale { raw, shape };

/// One row per candidate: its course, turned into as many coordinates as there are candidates. Distances are those of
/// the courses.
Eigen::MatrixXd course_points(Candidates const& from, ClusterScale scale);

/// options.count, or the number of fuzzy clusters by Xie and Beni's index and a sentence that says so.
std::pair<int, std::string> count_or_clusters(Candidates const& from, SelectionOptions const& options,
                                              ClusterScale scale);

/// Fuzzy c-means of the sensors' courses, and in each cluster the sensor that is longest at its maximum
/// (TimeRank::at_maximum; patent CN 2019106849236, claims 1-4; methods.md §4.2-4.3). The error is never looked at.
/// Where clusters stay empty (sensors that read the same) the best ranks among the rest fill the count, and the remark
/// says so.
Selection select_by_fuzzy_amplitude(std::span<Batch const> batches, SelectionOptions const& options);
Selection select_by_fuzzy_shape(std::span<Batch const> batches, SelectionOptions const& options);

}  // namespace thermotwin::models
