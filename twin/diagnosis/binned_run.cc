#include "twin/diagnosis/binned_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "scenarios/course.h"

namespace thermotwin::twin {
namespace {

/// Between two jumps, rows of equal length.
struct Stretch {
  double begin, end;
  bool after_jump;
};

/// Whether the inputs may have been others than the course has.
bool is_doubtful(MeasuredRun const& run, double t) {
  return std::any_of(run.changes.begin(), run.changes.end(),
                     [&](InputChange const& change) { return change.time - change.earlier < t && t <= change.time; });
}

/// Of the course or of what may have been given instead.
double next_jump(MeasuredRun const& run, double t) {
  double next = run.course->next_jump(t);
  for (auto const& alternative : run.alternatives) next = std::min(next, alternative.course->next_jump(t));
  return next;
}

/// The next jump, or the run's end; of jumps that are one the last. No stretch is as short as they are apart.
double end_of_stretch(MeasuredRun const& run, double from, double end) {
  double to = std::min(next_jump(run, from + scenarios::same_jump), end);
  for (double next = next_jump(run, to); next - to <= scenarios::same_jump; next = next_jump(run, to)) to = next;
  return to < end - scenarios::same_jump ? to : end;
}

std::vector<Stretch> rows_of(MeasuredRun const& run, double interval) {
  std::vector<Stretch> rows;
  double const end = run.time[run.time.size() - 1];
  for (double from = run.time[0]; from < end;) {
    double const to = end_of_stretch(run, from, end);
    int const count = std::max(1, int(std::ceil((to - from) / interval - 1e-9)));
    for (int i = 0; i < count; ++i)
      rows.push_back({from + (to - from) * i / count, from + (to - from) * (i + 1) / count, i == 0});
    from = to;
  }
  return rows;
}

void add_steps(BinnedRun& binned, Stretch const& row, int index, double first_step) {
  double const length = row.end - row.begin;
  double step = row.after_jump ? std::min(first_step, length) : length;
  double at = row.begin;
  do {  // at least one
    double const left = row.end - at;
    double const taken = left < 1.5 * step ? left : step;
    binned.steps.push_back({.begin = at, .end = at + taken, .row = index});
    at += taken;
    step *= 2.0;
  } while (at < row.end - 1e-6);
}

/// Of a channel that was read at these times of a row, which begins with that step.
void add_readings(std::vector<BinStep> const& steps, std::size_t step, Eigen::VectorXd const& times,
                  std::vector<StepReadings>& readings) {
  double const share = 1.0 / double(times.size());
  for (double const t : times) {
    while (step + 1 < steps.size() && steps[step].end <= t) ++step;
    double const length = steps[step].length();
    double const way = (t - steps[step].begin) / length, rest = 1.0 - way;
    auto& here = readings[step];
    here.at_begin += share * rest;
    here.at_end += share * way;
    here.bend_at_begin += share * length * way * rest * rest;
    here.bend_at_end -= share * length * way * way * rest;
    here.samples.push_back(t - steps[step].begin);
    here.share = share;
  }
}

}  // namespace

BinnedRun bin(MeasuredRun const& run, double interval, double first_step) {
  auto const rows = rows_of(run, interval);
  auto const count = Eigen::Index(rows.size()), channels = Eigen::Index(run.channels.size());
  BinnedRun binned{&run, {}, {}, {}, {}, {}};
  binned.readings.resize(run.channels.size());
  binned.time.resize(count);
  binned.values.resize(count, channels);
  binned.samples.resize(count, channels);
  Eigen::Index sample = 0;
  for (Eigen::Index row = 0; row < count; ++row) {
    auto const& stretch = rows[std::size_t(row)];
    auto const first_of_row = binned.steps.size();
    add_steps(binned, stretch, int(row), first_step);
    std::vector<Eigen::Index> samples;
    for (; sample < run.time.size() && (run.time[sample] < stretch.end || row + 1 == count); ++sample)
      if (!is_doubtful(run, run.time[sample])) samples.push_back(sample);
    Eigen::VectorXd times = run.time(samples);
    if (samples.empty()) times.setConstant(1, stretch.begin);  // between two samples: the row has no data
    binned.time[row] = times.mean();
    for (Eigen::Index c = 0; c < channels; ++c) {
      auto const& values = run.channels[std::size_t(c)].values;
      auto own = samples;
      std::erase_if(own, [&](Eigen::Index s) { return std::isnan(values[s]); });
      auto& readings = binned.readings[std::size_t(c)];
      readings.resize(binned.steps.size());
      add_readings(binned.steps, first_of_row, own.empty() ? times : run.time(own), readings);
      binned.values(row, c) = own.empty() ? std::numeric_limits<double>::quiet_NaN() : values(own).mean();
      binned.samples(row, c) = double(own.size());
    }
  }
  return binned;
}

Whitening whitening_of(ChannelNoise const& noise, BinnedRun const& run, Eigen::Index channel) {
  return {noise, run.time, run.samples.col(channel), noise.slow_along(run.time, run.values.col(channel))};
}

std::vector<std::string> channels_of(std::vector<BinnedRun> const& runs) {
  std::vector<std::string> names;
  for (auto const& run : runs)
    for (auto const& channel : run.run->channels)
      if (std::find(names.begin(), names.end(), channel.name) == names.end()) names.push_back(channel.name);
  return names;
}

double fitting_interval(MeasuredRun const& run, int rows) {
  double const duration = run.time[run.time.size() - 1] - run.time[0];
  double const sampling = duration / double(std::max<Eigen::Index>(run.time.size() - 1, 1));
  return std::max({sampling, std::min(300.0, duration / 60.0), duration / rows});
}

}  // namespace thermotwin::twin
