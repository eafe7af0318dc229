#include "models/information_screen.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

#include "models/mutual_information.h"
#include "models/ranking.h"
#include "models/shared_screen.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The cross-check by nearest neighbours costs the square of the samples; it looks at no more than about these.
constexpr Index cross_checked_samples = 400;
constexpr int neighbours = 4;
constexpr double dependent_below = 0.05;
constexpr Index fewest_blocks = 5;  // four have 24 orders: of those, one in 20 hardly stands out

std::vector<std::string> names(Batch const& batch, std::vector<Index> const& columns) {
  std::vector<std::string> result;
  for (Index const i : columns) result.push_back(batch.sensors[static_cast<std::size_t>(i)]);
  return result;
}

VectorXd information_by_neighbours(Batch const& all) {
  Index const samples = all.time.size();
  VectorXd information = VectorXd::Zero(all.temperature_rise.cols());
  if (samples <= neighbours) return information;
  Index const step = (samples + cross_checked_samples - 1) / cross_checked_samples;
  auto const thinned = Eigen::seq(0, samples - 1, step);
  for (Index i = 0; i < information.size(); ++i)
    information(i) = nearest_neighbour_information(all.temperature_rise(thinned, i), all.error(thinned), neighbours);
  return information;
}

std::string doubts(Batch const& all, InformationScreen const& screen, std::vector<Index> const& saturated) {
  std::vector<std::string> remarks;
  if (saturated.size() > 1)
    remarks.push_back(
        fmt::format("as coarse as the bins are, each of {} tells the error's bin wholly: their information "
                    "ranks nothing",
                    fmt::join(names(all, saturated), ", ")));
  Index const block = screen.block, samples = screen.samples;
  bool const tells = samples > (fewest_blocks - 1) * block;
  auto const& p = tells ? screen.block_p_value : screen.p_value;
  std::vector<Index> doubtful;
  for (Index const i : screen.kept)
    if (p(i) >= dependent_below) doubtful.push_back(i);
  if (!doubtful.empty())
    remarks.push_back(fmt::format("perhaps independent of the error (p >= 0.05 by permutation of {}): {}",
                                  tells ? fmt::format("blocks of {} samples", block) : "samples",
                                  fmt::join(names(all, doubtful), ", ")));
  if (!tells)
    remarks.push_back(
        fmt::format("too short a record to tell more of what is independent of the error: its {} samples "
                    "are {} blocks of {} that are",
                    samples, (samples + block - 1) / block, block));
  auto const otherwise = best_within_components(all.components, screen.by_neighbours);
  if (otherwise != screen.kept)
    remarks.push_back(
        fmt::format("by nearest neighbours the components would keep {}", fmt::join(names(all, otherwise), ", ")));
  return fmt::format("{}", fmt::join(remarks, "; "));
}

}  // namespace

InformationScreen screen_by_information(Candidates const& from, std::uint64_t seed,
                                        MutualInformationOptions const& options) {
  Index const sensors = from.count();
  InformationScreen screen;
  for (auto* figure : {&screen.information, &screen.p_value, &screen.block_p_value, &screen.bins})
    figure->resize(sensors);
  screen.samples = from.all.error.size();
  screen.block = independent_block(from.all.error);
  screen.by_neighbours = information_by_neighbours(from.all);
  MutualInformationOptions single = options, blocks = options;
  single.seed = blocks.seed = seed;
  single.block = 1;
  blocks.block = screen.block;
  std::vector<Index> saturated;
  for (Index i = 0; i < sensors; ++i) {
    auto const found = mutual_information(from.all.temperature_rise.col(i), from.all.error, single);
    screen.information(i) = found.value;
    screen.p_value(i) = found.p_value;
    screen.bins(i) = found.bins_x;
    screen.block_p_value(i) = mutual_information(from.all.temperature_rise.col(i), from.all.error, blocks).p_value;
    if (found.saturated) saturated.push_back(i);
  }
  screen.kept = best_within_components(from.all.components, screen.information);
  screen.remark = doubts(from.all, screen, saturated);
  return screen;
}

std::vector<Evidence> evidence_of(Candidates const& from, InformationScreen const& screen) {
  std::vector<Evidence> evidence;
  for (Index i = 0; i < from.count(); ++i)
    evidence.push_back({from.all.sensors[static_cast<std::size_t>(i)],
                        {{"information", screen.information(i)},
                         {"information_by_neighbours", screen.by_neighbours(i)},
                         {"bins", screen.bins(i)},
                         {"samples", double(screen.samples)},
                         {"p", screen.p_value(i)},
                         {"p_of_blocks", screen.block_p_value(i)},
                         {"block", double(screen.block)}}});
  return evidence;
}

std::vector<Index> best_within_components(std::vector<std::string> const& components, VectorXd const& information,
                                          int keep) {
  std::map<std::string, std::vector<Index>> members;
  for (std::size_t i = 0; i < components.size(); ++i) members[components[i]].push_back(static_cast<Index>(i));
  std::vector<Index> kept;
  for (auto const& [component, columns] : members) {
    auto const order = ranked(information, columns);
    kept.insert(kept.end(), order.begin(), order.begin() + std::min<Index>(keep, std::ssize(order)));
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

Index memory_of(VectorXd const& record) {
  VectorXd const centred = record.array() - record.mean();
  double const level = centred.squaredNorm() / std::exp(1.0);
  Index lag = 1;
  while (lag < record.size() / 2 && centred.head(record.size() - lag).dot(centred.tail(record.size() - lag)) >= level)
    ++lag;
  return lag;
}

Index independent_block(VectorXd const& record) { return std::min(3 * memory_of(record), record.size()); }

Selection select_by_mutual_information(std::span<Batch const> batches, SelectionOptions const& options) {
  auto const from = candidates(batches, options);
  require_error_that_moves(from);
  auto const shared = shared_screen(options);
  auto const& screen = shared->screen(from, options);
  auto chosen = ranked(screen.information, screen.kept);
  if (options.count) chosen = completed(chosen, *options.count, screen.information);
  auto result = selection(from, chosen, screen.information, screen.remark);
  result.evidence = evidence_of(from, screen);
  return result;
}

}  // namespace thermotwin::models
