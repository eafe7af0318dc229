#include "models/time_ranked_clusters.h"

#include <Eigen/QR>
#include <fmt/format.h>
#include <set>

#include "models/shared_screen.h"
#include "models/time_characteristic.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;

/// In the order of rank: the first of each cluster, and then, if these are not enough, the first of the others.
std::vector<Index> best_of_clusters(std::vector<Index> const& order, std::vector<Index> const& labels,
                                    std::size_t count) {
  std::vector<Index> best, others;
  std::set<Index> seen;
  for (auto sensor : order)
    (seen.insert(labels[static_cast<std::size_t>(sensor)]).second ? best : others).push_back(sensor);
  for (std::size_t i = 0; best.size() < count; ++i) best.push_back(others[i]);
  return best;
}

Selection select(std::span<Batch const> batches, SelectionOptions options, ClusterScale scale) {
  auto const from = candidates(batches, options);
  options.shared = shared_screen(options);
  auto [count, remark] = count_or_clusters(from, options, scale);
  auto const labels = options.shared->fuzzy(from, options.seed, scale).clusters(count).labels();
  auto const characteristic = time_characteristic(from.batches, options.resolution, TimeRank::at_maximum);
  auto const filled = std::set<Index>(labels.begin(), labels.end()).size();
  if (filled < static_cast<std::size_t>(count))
    remark += fmt::format("{}only {} of {} clusters have a sensor; the next best ranks fill the rest",
                          remark.empty() ? "" : "; ", filled, count);
  return selection(from, best_of_clusters(order_of(characteristic), labels, static_cast<std::size_t>(count)),
                   score_of(characteristic), remark);
}

}  // namespace

Eigen::MatrixXd course_points(Candidates const& from, ClusterScale scale) {
  Eigen::MatrixXd courses = from.all.temperature_rise;
  if (scale == ClusterScale::shape) {
    Eigen::RowVectorXd const low = courses.colwise().minCoeff(), high = courses.colwise().maxCoeff();
    courses = (courses.rowwise() - low).array().rowwise() / (high - low).array();
  }
  if (courses.rows() <= courses.cols()) return courses.transpose();
  Eigen::HouseholderQR<Eigen::MatrixXd> const factors(courses);
  Eigen::MatrixXd const upper = factors.matrixQR().topRows(courses.cols()).triangularView<Eigen::Upper>();
  return upper.transpose();
}

std::pair<int, std::string> count_or_clusters(Candidates const& from, SelectionOptions const& options,
                                              ClusterScale scale) {
  if (options.count) return {*options.count, ""};
  int const count = shared_screen(options)->fuzzy(from, options.seed, scale).number();
  return {count, fmt::format("{} clusters by Xie and Beni's index", count)};
}

Selection select_by_fuzzy_amplitude(std::span<Batch const> batches, SelectionOptions const& options) {
  return select(batches, options, ClusterScale::raw);
}

Selection select_by_fuzzy_shape(std::span<Batch const> batches, SelectionOptions const& options) {
  return select(batches, options, ClusterScale::shape);
}

}  // namespace thermotwin::models
