#include "twin/diagnosis/zero_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "models/quantile.h"
#include "twin/diagnosis/score.h"

namespace thermotwin::twin {
namespace {

constexpr std::size_t rows_of_start = 3;                    // whose median is where a run begins
constexpr double least_kelvin = 0.15, least_length = 2e-6;  // [K, m]
constexpr double about_a_jump = 600.0;    // of the inputs: what answers it at once, is none of this [s]
constexpr double standing_out = 5.0;      // times the usual change from one sample to the next
constexpr std::size_t most_midway = 2;    // of a channel in a run
constexpr Eigen::Index fewest_alike = 4;  // sensors
constexpr double most_alike = 1.5;        // standard deviations that their mean is from none
constexpr double kelvin_deviation = 1.0, length_deviation = 20e-6;  // of the priors [K, m]

std::vector<Eigen::Index> measured_rows(Eigen::VectorXd const& values) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < values.size(); ++row)
    if (!std::isnan(values[row])) rows.push_back(row);
  return rows;
}

/// Less is told neither from noise nor from what a model gets wrong.
double least_zero(bool displacement) { return displacement ? least_length : least_kelvin; }

/// A change from one sample to the next.
struct Leap {
  double time = 0.0;  ///< between them [s]
  double by = 0.0;
};

/// The largest one of a channel from one time to another.
Leap largest_leap(MeasuredRun const& run, std::size_t channel, double from, double to) {
  auto const& values = run.channels[channel].values;
  Leap largest;
  Eigen::Index before = -1;
  for (auto i = std::lower_bound(run.time.begin(), run.time.end(), from) - run.time.begin();
       i < run.time.size() && run.time[i] <= to; ++i) {
    if (std::isnan(values[i])) continue;
    if (before >= 0 && std::abs(values[i] - values[before]) > std::abs(largest.by))
      largest = {0.5 * (run.time[before] + run.time[i]), values[i] - values[before]};
    before = i;
  }
  return largest;
}

/// The median change from one sample to the next.
double usual_change(Eigen::VectorXd const& values) {
  std::vector<double> changes;
  double before = std::nan("");
  for (double const value : values) {
    if (std::isnan(value)) continue;
    if (!std::isnan(before)) changes.push_back(std::abs(value - before));
    before = value;
  }
  return changes.empty() ? 0.0 : models::upper_median(std::move(changes));
}

/// From which row on a channel may stand otherwise in a run, and what its readings show of that.
struct Moment {
  Eigen::Index row = 0;
  Leap shown;
};

/// All of the run: its first rows show it.
std::vector<Moment> from_the_start(Eigen::VectorXd const& residual, BinnedRun const& run) {
  auto measured = measured_rows(residual);
  if (measured.size() < rows_of_start) return {};
  measured.resize(rows_of_start);
  Eigen::VectorXd const first = residual(measured);
  double const shown = models::upper_median({first.begin(), first.end()});
  return {{0, {run.run->time[0], shown}}};
}

/// In its midst, where the inputs do not jump: two samples show it.
std::vector<Moment> midway(Eigen::VectorXd const& residual, BinnedRun const& run, std::size_t channel) {
  auto const measured = measured_rows(residual);
  double const usual = usual_change(run.run->channels[channel].values);
  std::vector<Moment> moments;
  for (std::size_t k = 1; k + 1 < measured.size(); ++k) {
    auto const row = measured[k], before = measured[k - 1];
    if (run.run->course->next_jump(run.time[before] - about_a_jump) < run.time[row]) continue;
    auto const leap = largest_leap(*run.run, channel, run.time[before], run.time[measured[k + 1]]);
    if (std::abs(leap.by) > standing_out * usual) moments.push_back({row, leap});
  }
  return moments;
}

/// Shares of an estimate that the readings show. Of two runs with one offset between them, either shows half; a fit
/// that knows nothing of the change has bent numbers around it.
struct Shares {
  double least, most;
  [[nodiscard]] bool hold(double shown, double estimate) const {
    return shown / estimate >= least && shown / estimate <= most;
  }
};
constexpr Shares before_it_is_known{0.25, 4.0}, of_sensor{0.25, 2.0}, of_displacement{0.6, 1.6};

/// Of which channels how many runs have readings.
std::size_t runs_with(std::string const& channel, std::vector<BinnedRun> const& runs) {
  return std::size_t(std::count_if(runs.begin(), runs.end(), [&](BinnedRun const& run) {
    auto const& all = run.run->channels;
    return std::any_of(all.begin(), all.end(), [&](auto const& own) { return own.name == channel; });
  }));
}

/// Where a channel's zero may have changed in a run, and what data say of it.
struct Tried {
  ChangedZero zero;
  double statistic = 0.0;  ///< T
};

/// The most evident of these moments that the readings show.
std::optional<Tried> clearest(std::vector<Moment> moments, std::size_t r, std::size_t c, Estimation const& estimation,
                              Fit const& fit) {
  auto const& run = estimation.data()[r];
  auto const rows = run.time.size();
  bool const displacement = run.run->channels[c].displacement;
  std::erase_if(moments, [&](Moment const& m) {
    return std::abs(m.shown.by) < (displacement ? of_displacement : of_sensor).least * least_zero(displacement);
  });
  if (moments.empty()) return std::nullopt;
  Eigen::MatrixXd signatures = Eigen::MatrixXd::Zero(rows, Eigen::Index(moments.size()));
  for (Eigen::Index k = 0; k < signatures.cols(); ++k)
    signatures.col(k).tail(rows - moments[std::size_t(k)].row).setOnes();
  estimation.whiten(r, c, signatures);
  auto const scores = Remainder(fit, signatures, estimation.first_row(r) + Eigen::Index(c) * rows).scores();
  std::optional<Tried> best;
  for (std::size_t k = 0; k < scores.size(); ++k)
    if (before_it_is_known.hold(moments[k].shown.by, scores[k].amplitude) &&
        (!best || scores[k].statistic > best->statistic))
      best = Tried{{.run = r,
                    .channel = c,
                    .from = moments[k].shown.time,
                    .deviation = displacement ? length_deviation : kelvin_deviation,
                    .shown = moments[k].shown.by},
                   scores[k].statistic};
  return best;
}

/// In two runs, one of them stands otherwise: which, only a third tells.
std::vector<ChangedZero> clearest_of_each_channel(std::vector<Tried> found, std::vector<BinnedRun> const& runs) {
  std::stable_sort(found.begin(), found.end(),
                   [](Tried const& a, Tried const& b) { return a.statistic > b.statistic; });
  std::vector<ChangedZero> zeros;
  std::set<std::string> channels;
  for (auto const& one : found)
    if (channels.insert(runs[one.zero.run].run->channels[one.zero.channel].name).second) zeros.push_back(one.zero);
  return zeros;
}

/// How many of a channel's zeros changed in the midst of a run, so far.
std::size_t changed_midway(ChangedZero const& like, Estimation const& estimation) {
  auto const& zeros = estimation.zeros();
  return std::size_t(std::count_if(zeros.begin(), zeros.end(), [&](ChangedZero const& zero) {
    return zero.run == like.run && zero.channel == like.channel && !zero.is_in_all_of(estimation.data()[zero.run]);
  }));
}

/// Of each channel the most evident one. A probe is not knocked again and again: it follows what the twin does not.
std::vector<ChangedZero> changed_zeros(Estimation const& estimation, Fit const& fit, double threshold) {
  auto const residuals = estimation.residuals_at(fit.x);
  std::vector<Tried> found;
  std::size_t tried = 0;
  for (std::size_t r = 0; r < residuals.size(); ++r) {
    auto const& run = estimation.data()[r];
    for (std::size_t c = 0; c < run.run->channels.size(); ++c) {
      auto const& channel = run.run->channels[c];
      if (!channel.displacement && runs_with(channel.name, estimation.data()) < 2) continue;
      Eigen::VectorXd const residual = residuals[r].col(Eigen::Index(c));
      auto moments = channel.displacement ? midway(residual, run, c) : from_the_start(residual, run);
      tried += moments.size();
      if (auto best = clearest(std::move(moments), r, c, estimation, fit)) found.push_back(*best);
    }
  }
  double const asked = threshold + 2.0 * std::log(double(std::max<std::size_t>(tried, 1)));
  std::erase_if(found, [&](Tried const& one) {
    return one.statistic < asked || changed_midway(one.zero, estimation) >= most_midway;
  });
  return clearest_of_each_channel(std::move(found), estimation.data());
}

/// Those of the last zeros of a question that their fit makes three standard errors at least, more than a model gets
/// wrong, and what the readings show: what others pull with them is not.
std::vector<ChangedZero> confirmed_of(std::vector<ChangedZero> const& zeros, Estimation const& freed, Fit const& fit) {
  auto const first = Eigen::Index(freed.unknowns().size() - freed.effects().size() - zeros.size());
  std::vector<ChangedZero> confirmed;
  for (std::size_t z = 0; z < zeros.size(); ++z) {
    auto const u = first + Eigen::Index(z);
    bool const displacement = freed.data()[zeros[z].run].run->channels[zeros[z].channel].displacement;
    double const least = std::max(least_zero(displacement), 3.0 * std::sqrt(fit.covariance(u, u)));
    bool const shown = (displacement ? of_displacement : of_sensor).hold(zeros[z].shown, fit.x[u]);
    if (shown && std::abs(fit.x[u]) >= least) confirmed.push_back(zeros[z]);
  }
  return confirmed;
}

/// Whether the sensors of a run stand off all alike, by those of its zeros that changed: so does a machine that was not
/// at rest. Of two runs, one stands off as the other does with the other sign.
bool stand_off_alike(Estimation const& freed, Fit const& fit) {
  auto const& unknowns = freed.unknowns();
  auto const& runs = freed.data();
  std::map<std::size_t, std::vector<double>> changes;
  for (std::size_t u = 0; u < unknowns.size(); ++u) {
    if (unknowns[u].kind != Unknown::Kind::zero) continue;
    auto const& zero = freed.zeros()[unknowns[u].index];
    if (!zero.is_in_all_of(runs[zero.run])) continue;
    bool const mirrored = runs.size() == 2 && zero.run == 0;
    changes[mirrored ? 1 : zero.run].push_back((mirrored ? -1.0 : 1.0) * fit.x[Eigen::Index(u)]);
  }
  return std::any_of(changes.begin(), changes.end(), [](auto const& of_run) {
    Eigen::Map<Eigen::VectorXd const> const values(of_run.second.data(), Eigen::Index(of_run.second.size()));
    if (values.size() < fewest_alike) return false;
    double const mean = values.mean();
    double const deviation = std::sqrt((values.array() - mean).square().sum() / double(values.size() - 1));
    return std::abs(mean) > most_alike * deviation;
  });
}

}  // namespace

std::optional<Fitted> with_changed_zeros(Estimation const& estimation, Fit const& fit, double threshold) {
  auto zeros = changed_zeros(estimation, fit, threshold);
  while (!zeros.empty()) {
    Estimation const freed = estimation.with_zeros(zeros);
    Fit better = freed.fit(estimation.with_zeros(fit.x, zeros.size()), Estimation::to_the_end);
    auto const confirmed = confirmed_of(zeros, freed, better);
    if (confirmed.size() == zeros.size()) {
      if (better.evidence >= fit.evidence || stand_off_alike(freed, better)) break;
      return Fitted{freed, std::move(better)};
    }
    zeros = confirmed;
  }
  return std::nullopt;
}

}  // namespace thermotwin::twin
