#include "twin/diagnosis/binned_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "scenarios/course.h"
#include "scenarios/signal.h"

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

void add_sample(BinStep& step, double t) {
  double const share = (t - step.begin) / step.length(), rest = 1.0 - share;
  step.at_begin += rest;
  step.at_end += share;
  step.bend_at_begin += step.length() * share * rest * rest;
  step.bend_at_end -= step.length() * share * share * rest;
  step.samples.push_back(t - step.begin);
}

/// A channel's readings, with straight lines between them.
scenarios::Signal readings_of(Eigen::VectorXd const& time, Eigen::VectorXd const& values) {
  std::vector<double> times, readings;
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    if (std::isnan(values[i])) continue;
    times.push_back(time[i]);
    readings.push_back(values[i]);
  }
  return {std::move(times), std::move(readings), scenarios::Interpolation::linear};
}

/// Over those of the times that lie between the first reading and the last; there must be one.
double mean(scenarios::Signal const& readings, std::vector<double> const& times) {
  double sum = 0.0, count = 0.0;
  for (double const t : times) {
    if (t < readings.times().front() || t > readings.times().back()) continue;
    sum += readings.at(t);
    count += 1.0;
  }
  return sum / count;
}

void divide(BinStep& step, int samples) {
  for (double* weight : {&step.at_begin, &step.at_end, &step.bend_at_begin, &step.bend_at_end}) *weight /= samples;
  step.share = 1.0 / samples;
}

}  // namespace

BinnedRun bin(MeasuredRun const& run, double interval, double first_step) {
  auto const rows = rows_of(run, interval);
  auto const channels = Eigen::Index(run.channels.size());
  BinnedRun binned{&run, {}, {}, {}, {}};
  binned.time.setZero(Eigen::Index(rows.size()));
  binned.values.setZero(Eigen::Index(rows.size()), channels);
  binned.samples.setZero(Eigen::Index(rows.size()), channels);
  std::vector<scenarios::Signal> readings;
  for (auto const& channel : run.channels) readings.push_back(readings_of(run.time, channel.values));
  Eigen::Index sample = 0;
  std::size_t first_of_row = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    add_steps(binned, rows[r], int(r), first_step);
    auto const row = Eigen::Index(r);
    bool const last = r + 1 == rows.size();
    std::vector<double> times;
    std::size_t step = first_of_row;
    for (; sample < run.time.size() && (run.time[sample] < rows[r].end || last); ++sample) {
      double const t = run.time[sample];
      if (is_doubtful(run, t)) continue;
      times.push_back(t);
      while (step + 1 < binned.steps.size() && binned.steps[step].end <= t) ++step;
      add_sample(binned.steps[step], t);
      binned.time[row] += t;
      for (Eigen::Index c = 0; c < channels; ++c)
        if (double const value = run.channels[std::size_t(c)].values[sample]; !std::isnan(value)) {
          binned.values(row, c) += value;
          binned.samples(row, c) += 1.0;
        }
    }
    for (Eigen::Index c = 0; c < channels; ++c)
      if (double const own = binned.samples(row, c); own > 0.0 && own < double(times.size()))
        binned.values(row, c) = own * mean(readings[std::size_t(c)], times);
    if (times.empty()) {  // between two samples: the row has no data
      add_sample(binned.steps[first_of_row], rows[r].begin);
      binned.time[row] = rows[r].begin;
    }
    int const count = std::max(1, int(times.size()));
    for (std::size_t s = first_of_row; s < binned.steps.size(); ++s) divide(binned.steps[s], count);
    binned.time[row] /= count;
    first_of_row = binned.steps.size();
  }
  binned.values =
      (binned.samples.array() > 0.0)
          .select(binned.values.cwiseQuotient(binned.samples.cwiseMax(1.0)), std::numeric_limits<double>::quiet_NaN());
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
