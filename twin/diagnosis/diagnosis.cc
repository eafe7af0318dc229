#include "twin/diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

constexpr std::size_t most_refits = 5;
constexpr double worth_a_refit = 12.0;  // score statistic

std::vector<std::string> channels_of(std::vector<BinnedRun> const& runs) {
  std::vector<std::string> names;
  for (auto const& run : runs)
    for (auto const& channel : run.run->channels)
      if (std::find(names.begin(), names.end(), channel.name) == names.end()) names.push_back(channel.name);
  return names;
}

/// −2 ln likelihood of one channel's residuals in all runs.
double misfit(ChannelNoise const& noise, std::string const& channel, std::vector<BinnedRun> const& runs,
              std::vector<Eigen::MatrixXd> const& residuals) {
  double sum = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (std::size_t c = 0; c < runs[r].run->channels.size(); ++c) {
      if (runs[r].run->channels[c].name != channel) continue;
      Whitening const whitening(noise, runs[r].time, runs[r].samples.col(Eigen::Index(c)));
      Eigen::MatrixXd signal = residuals[r].col(Eigen::Index(c));
      whitening.apply(signal);
      sum += signal.squaredNorm() + 2.0 * whitening.log_scale();
    }
  return sum;
}

/// The model error that the residuals of a fit have: how much over minutes, how much over hours. Never below a fifth of
/// what was expected: residuals of a fit are smaller than the noise.
std::vector<ChannelNoise> observed_noise(Estimation const& estimation, Eigen::VectorXd const& x,
                                         std::vector<ChannelNoise> const& expected) {
  auto const residuals = estimation.residuals_at(x);
  std::vector<ChannelNoise> noise = expected;
  for (std::size_t c = 0; c < noise.size(); ++c) {
    double best = INFINITY;
    for (double const fast : {1.0, 1.5, 2.5, 4.0})
      for (double const slow : {1.0, 1.5, 2.5, 4.0}) {
        ChannelNoise trial = expected[c];
        trial.fast *= fast;
        trial.slow *= slow;
        double const value = misfit(trial, estimation.channels()[c], estimation.data(), residuals);
        if (value < best) {
          best = value;
          noise[c] = trial;
        }
      }
  }
  return noise;
}

/// 2 ln of the evidence for an effect from its score alone.
double evidence_of(Score const& score, Hypothesis const& hypothesis, double deviation) {
  if (score.statistic <= 0.0) return 0.0;
  double const a = score.information, b = score.amplitude * a;
  double const gain = b * b / (a + 1.0 / (deviation * deviation)) - std::log1p(a * deviation * deviation);
  return hypothesis.trial->either_sign ? gain : gain + 2.0 * std::log(2.0);
}

/// The most promising hypotheses, one shape per effect and site.
std::vector<std::size_t> promising(std::vector<Score> const& scores, std::vector<Hypothesis> const& hypotheses) {
  std::vector<std::size_t> order(scores.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return evidence_of(scores[a], hypotheses[a], 0.5) > evidence_of(scores[b], hypotheses[b], 0.5);
  });
  std::vector<std::size_t> chosen;
  std::map<std::string, int> seen;
  for (std::size_t const k : order) {
    if (scores[k].statistic < worth_a_refit || chosen.size() == most_refits) break;
    if (seen[hypotheses[k].label()]++ == 0) chosen.push_back(k);
  }
  return chosen;
}

/// A fit with one effect more.
struct Refit {
  Hypothesis hypothesis;
  Fit fit;
  double strength = -INFINITY;
};

class Diagnostician {
 public:
  Diagnostician(Value const& machine, std::vector<BinnedRun> const& runs, DiagnosisOptions const& options)
      : options_(options), machine_(machine), runs_(runs) {}
  Diagnosis operator()();

 private:
  void say(std::string const& what) const {
    if (options_.progress) options_.progress(what);
  }
  [[nodiscard]] std::vector<Refit> refits(Estimation const& estimation, Fit const& fit);
  [[nodiscard]] Explanation explanation_of(std::vector<Refit> const& refits) const;
  [[nodiscard]] Diagnosis::Verdict verdict_of(Diagnosis const& diagnosis) const;

  DiagnosisOptions const& options_;
  Value const& machine_;
  std::vector<BinnedRun> const& runs_;
  std::vector<Hypothesis> hypotheses_;
};

std::vector<Refit> Diagnostician::refits(Estimation const& estimation, Fit const& fit) {
  auto const scores = score(fit, signatures(estimation, fit, hypotheses_), hypotheses_);
  auto const chosen = promising(scores, hypotheses_);
  std::vector<Refit> result(chosen.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    auto& refit = result[i];
    refit.hypothesis = hypotheses_[chosen[i]];
    Eigen::VectorXd start(fit.x.size() + 1);
    start << fit.x, scores[chosen[i]].amplitude;
    bool const both = refit.hypothesis.trial->either_sign;
    start[fit.x.size()] = std::clamp(start[fit.x.size()], both ? -1.0 : 1e-3, 1.0);
    try {
      refit.fit = estimation.with(std::vector<Hypothesis>{refit.hypothesis}).fit(start, 8, &fit);
      refit.strength = fit.evidence - refit.fit.evidence;
    } catch (std::exception const&) {
      refit.strength = -INFINITY;
    }
  }
  std::stable_sort(result.begin(), result.end(), [](auto const& a, auto const& b) { return a.strength > b.strength; });
  return result;
}

Explanation Diagnostician::explanation_of(std::vector<Refit> const& refits) const {
  Explanation explanation;
  double sum = 0.0;
  for (auto const& refit : refits) {
    double const behind = refits[0].strength - refit.strength;
    if (behind > options_.indistinct) break;
    auto const last = refit.fit.x.size() - 1;
    double const unit = refit.hypothesis.trial->largest;
    Finding finding{refit.hypothesis, refit.fit.x[last] * unit, std::sqrt(refit.fit.covariance(last, last)) * unit,
                    refit.strength,   std::exp(-0.5 * behind),  0.0};
    sum += finding.weight;
    explanation.alternatives.push_back(std::move(finding));
  }
  for (auto& finding : explanation.alternatives) finding.weight /= sum;
  return explanation;
}

Diagnosis Diagnostician::operator()() {
  Diagnosis diagnosis;
  Machine const machine = Machine::build(machine_);
  auto const channels = channels_of(runs_);
  std::vector<ChannelNoise> expected;
  for (auto const& channel : channels) expected.push_back(expected_noise(machine, channel, runs_));
  say("calibrating");
  Estimation estimation(machine_, runs_, channels, expected);
  Fit fit = estimation.fit(estimation.prior_mean());
  estimation = estimation.with(observed_noise(estimation, fit.x, expected));
  fit = estimation.fit(fit.x);
  diagnosis.calibrated = fit;
  hypotheses_ = hypotheses(machine_, machine, options_.without);
  diagnosis.hypotheses = hypotheses_;
  say("scanning for heat that the machine does not know");
  diagnosis.scan = scan_for_free_heat(estimation, fit);
  for (int round = 0; round < options_.most_effects; ++round) {
    say(fmt::format("{} effects at their sites, round {}", hypotheses_.size(), round + 1));
    auto found = refits(estimation, fit);
    if (found.empty() || found[0].strength < options_.threshold) break;
    diagnosis.explanations.push_back(explanation_of(found));
    estimation = estimation.with(std::vector<Hypothesis>{found[0].hypothesis});
    estimation = estimation.with(observed_noise(estimation, found[0].fit.x, expected));
    fit = estimation.fit(found[0].fit.x);
  }
  diagnosis.amended = fit;
  diagnosis.effects = estimation.effects();
  diagnosis.unknowns = estimation.unknowns();
  diagnosis.document = estimation.document_at(fit.x);
  diagnosis.verdict = verdict_of(diagnosis);
  return diagnosis;
}

Diagnosis::Verdict Diagnostician::verdict_of(Diagnosis const& diagnosis) const {
  using Verdict = Diagnosis::Verdict;
  if (diagnosis.explanations.empty()) return Verdict::nothing;
  bool const sensors =
      std::all_of(diagnosis.explanations.begin(), diagnosis.explanations.end(), [](Explanation const& explanation) {
        return explanation.alternatives[0].hypothesis.effect->changes.find("sensor") != std::string::npos;
      });
  if (sensors) return Verdict::sensor;
  bool const single = std::all_of(diagnosis.explanations.begin(), diagnosis.explanations.end(),
                                  [](Explanation const& explanation) { return explanation.alternatives.size() == 1; });
  return single ? Verdict::effect : Verdict::either;
}

}  // namespace

std::string name_of(Diagnosis::Verdict verdict) {
  switch (verdict) {
    case Diagnosis::Verdict::nothing:
      return "nothing";
    case Diagnosis::Verdict::effect:
      return "effect";
    case Diagnosis::Verdict::either:
      return "either";
    case Diagnosis::Verdict::sensor:
      return "sensor";
    case Diagnosis::Verdict::none_known:
      return "none_known";
  }
  return "";
}

ChannelNoise expected_noise(Machine const& machine, std::string const& channel, std::vector<BinnedRun> const& runs) {
  double low = INFINITY, high = -INFINITY;
  bool displacement = false;
  for (auto const& run : runs)
    for (std::size_t c = 0; c < run.run->channels.size(); ++c) {
      if (run.run->channels[c].name != channel) continue;
      displacement = run.run->channels[c].displacement;
      for (double const v : run.values.col(Eigen::Index(c)))
        if (!std::isnan(v)) {
          low = std::min(low, v);
          high = std::max(high, v);
        }
    }
  ChannelNoise noise;
  noise.slow = 0.02 * std::max(0.0, high - low);
  if (displacement) {
    noise.white = 0.2e-6;
    noise.rounding = 0.05e-6;
    noise.fast = 0.3e-6;
    return noise;
  }
  noise.white = 0.03;
  noise.fast = 0.1;
  for (auto const& sensor : machine.sensors) {
    if (sensor.description.name != channel) continue;
    auto const& kind = sensor.description.kind;
    double const step =
        sensor.description.resolution.value_or(kind == "ds18b20" ? std::pow(2.0, 8 - sensor.description.bits) : 0.01);
    noise.rounding = step / std::sqrt(12.0);
    noise.white = sensor.description.noise.value_or(noise.white);
  }
  return noise;
}

Diagnosis diagnose(Value const& machine, std::vector<BinnedRun> const& runs, std::vector<BinnedRun> const&,
                   DiagnosisOptions const& options) {
  return Diagnostician(machine, runs, options)();
}

}  // namespace thermotwin::twin
