#include "twin/diagnosis/comparison.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "thermal/error.h"
#include "twin/diagnosis/gap.h"
#include "twin/diagnosis/prediction.h"
#include "twin/diagnosis/regimes.h"
#include "twin/file/distinct_names.h"

namespace thermotwin::twin {
namespace {

double mean_of_finite(Eigen::VectorXd const& values) {
  double sum = 0.0;
  int count = 0;
  for (double const value : values)
    if (std::isfinite(value)) {
      sum += value;
      ++count;
    }
  return count > 0 ? sum / count : NAN;
}

/// RMS over the rows of one regime, or over all.
GapPair gap(Eigen::VectorXd const& before, Eigen::VectorXd const& after, Regimes const& regimes,
            std::ptrdiff_t only = -1) {
  GapPair sum;
  for (Eigen::Index r = 0; r < before.size(); ++r) {
    if (!std::isfinite(before[r])) continue;
    if (only >= 0 && regimes.of_row[std::size_t(r)] != std::size_t(only)) continue;
    sum.before += before[r] * before[r];
    sum.after += after[r] * after[r];
    ++sum.samples;
  }
  if (sum.samples == 0) return {NAN, NAN, 0};
  return {std::sqrt(sum.before / double(sum.samples)), std::sqrt(sum.after / double(sum.samples)), sum.samples};
}

ComparedChannel compare_channel(MeasuredChannel const& channel, std::string const& unit, Eigen::VectorXd const& before,
                                Eigen::VectorXd const& after, Regimes const& regimes) {
  double const scale = unit == "K" ? 1.0 : 1e6;
  Eigen::VectorXd was = scale * (channel.values - before), is = scale * (channel.values - after);
  ComparedChannel result{channel.name, unit, {}, {}, mean_of_finite(was), mean_of_finite(is)};
  was.array() -= result.offset_before;
  is.array() -= result.offset_after;
  result.whole = gap(was, is, regimes);
  for (std::size_t i = 0; i < regimes.names.size(); ++i)
    result.parts.push_back(gap(was, is, regimes, std::ptrdiff_t(i)));
  return result;
}

ComparedRun compare_run(Machine const& before, Machine const& after, MeasuredRun const& run) {
  auto regimes = speed_regimes(run, run.time);
  if (regimes.names.size() == 1) regimes.names.clear();  // it is the whole run
  Eigen::MatrixXd const was = predict(before, run), is = predict(after, run);
  ComparedRun result{run.name, regimes.names, {}, run.remarks};
  for (std::size_t c = 0; c < run.channels.size(); ++c)
    result.channels.push_back(compare_channel(run.channels[c], unit_of(run.channels[c], before),
                                              was.col(Eigen::Index(c)), is.col(Eigen::Index(c)), regimes));
  return result;
}

/// The run as both machines know it.
MeasuredRun common_run(std::filesystem::path const& path, Machine const& before, Machine const& after) {
  MeasuredRun run = read_measured_run(path, before);
  MeasuredRun const other = read_measured_run(path, after);  // what only this machine needs must be there, too
  std::vector<std::string> left_out;
  std::erase_if(run.channels, [&](MeasuredChannel const& channel) {
    bool const known = std::any_of(other.channels.begin(), other.channels.end(),
                                   [&](auto const& theirs) { return theirs.name == channel.name; });
    if (!known) left_out.push_back(channel.name);
    return !known;
  });
  if (run.channels.empty())
    throw thermal::InputError(
        fmt::format("{}: it has no channel that '{}' and '{}' both have", path.string(), before.name, after.name));
  if (!left_out.empty())
    run.remarks.push_back(fmt::format("of the first machine only, so not compared: {}", fmt::join(left_out, ", ")));
  return run;
}

}  // namespace

Comparison compare(Machine const& before, Machine const& after, std::vector<MeasuredRun> const& runs) {
  Comparison comparison{before.name, after.name, {}};
  for (auto const& run : runs) comparison.runs.push_back(compare_run(before, after, run));
  return comparison;
}

Comparison compare_files(std::filesystem::path const& before, std::filesystem::path const& after,
                         std::vector<std::filesystem::path> const& data) {
  Machine const was = Machine::read(before), is = Machine::read(after);
  std::vector<MeasuredRun> runs;
  auto const names = distinct_names(data);
  for (std::size_t r = 0; r < data.size(); ++r) {
    runs.push_back(common_run(data[r], was, is));
    runs.back().name = name_of_run(names[r]);
  }
  Comparison comparison = compare(was, is, runs);
  comparison.before = before.string();
  comparison.after = after.string();
  return comparison;
}

GapPair total(Comparison const& comparison, std::string const& unit) {
  GapPair sum;
  int channels = 0;
  for (auto const& run : comparison.runs)
    for (auto const& channel : run.channels) {
      if (channel.unit != unit || channel.whole.samples == 0) continue;
      sum.before += channel.whole.before * channel.whole.before;
      sum.after += channel.whole.after * channel.whole.after;
      sum.samples += channel.whole.samples;
      ++channels;
    }
  if (channels == 0) return {NAN, NAN, 0};
  return {std::sqrt(sum.before / channels), std::sqrt(sum.after / channels), sum.samples};
}

}  // namespace thermotwin::twin
