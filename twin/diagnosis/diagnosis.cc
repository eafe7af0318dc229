#include "twin/diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <set>

#include "thermal/error.h"
#include "twin/diagnosis/excitation.h"
#include "twin/diagnosis/expected_noise.h"

namespace thermotwin::twin {
namespace {

constexpr std::size_t most_refits = 24;
constexpr std::size_t most_alternatives = 3;
constexpr double confusable = 0.6;  // cosine of two signatures (physics.md 8.6)

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

/// The model error that the residuals of a fit have: how much over minutes, how much over hours. Never below
/// what was expected: residuals of a fit are smaller than the noise.
std::vector<ChannelNoise> observed_noise(Estimation const& estimation, Eigen::VectorXd const& x,
                                         std::vector<ChannelNoise> const& expected) {
  auto const residuals = estimation.residuals_at(x);
  std::vector<ChannelNoise> noise = expected;
  for (std::size_t c = 0; c < noise.size(); ++c) {
    double best = INFINITY;
    for (double const fast : {1.0, 1.5, 2.5, 4.0})
      for (double const slow : {1.0, 2.0, 4.0}) {
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

/// The most promising hypotheses, one per effect and site, strongest first: all within `behind` of the strongest.
std::vector<std::size_t> promising(std::vector<Score> const& scores, std::vector<Hypothesis> const& hypotheses,
                                   double least, double behind) {
  std::vector<double> evidence;
  for (std::size_t k = 0; k < scores.size(); ++k) evidence.push_back(evidence_of(scores[k], hypotheses[k], 0.5));
  std::vector<std::size_t> order(scores.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return evidence[a] > evidence[b]; });
  std::vector<std::size_t> chosen;
  std::map<std::string, int> seen;
  for (std::size_t const k : order) {
    if (evidence[k] < std::max(least, evidence[order[0]] - behind) || chosen.size() == most_refits) break;
    if (seen[hypotheses[k].label()]++ == 0) chosen.push_back(k);
  }
  return chosen;
}

Eigen::VectorXd shorter(Eigen::VectorXd const& x, Eigen::Index gone) {
  Eigen::VectorXd rest(x.size() - 1);
  rest << x.head(gone), x.tail(x.size() - gone - 1);
  return rest;
}

/// A fit with one effect more.
struct Refit {
  Hypothesis hypothesis;
  double amplitude = 0.0, standard_error = 0.0;  ///< in units of the trial's largest
  Eigen::VectorXd x;
  double strength = -INFINITY;
};

class Diagnostician {
 public:
  Diagnostician(Value const& machine, std::vector<BinnedRun> const& runs, DiagnosisOptions const& options)
      : options_(options), document_(machine), runs_(runs), machine_(Machine::build(machine)) {}
  Diagnosis operator()();

 private:
  void say(std::string const& what) const {
    if (options_.progress) options_.progress(what);
  }
  void calibrate();
  [[nodiscard]] bool add_effect(int round);
  [[nodiscard]] std::vector<Refit> refits(Fit const& about, std::vector<std::size_t> const& chosen,
                                          std::vector<Score> const& scores) const;
  [[nodiscard]] std::vector<std::size_t> most_promising(std::vector<Score> const& scores) const;
  [[nodiscard]] std::vector<Refit> instead_of(std::size_t effect, double strength) const;
  [[nodiscard]] Eigen::MatrixXd whitened_signatures(std::vector<Hypothesis> const& hypotheses) const;
  [[nodiscard]] Explanation explanation_of(std::vector<Refit> const& refits) const;
  void listen_to_noise();
  [[nodiscard]] double further_threshold() const {
    return std::max(options_.further_threshold, options_.least_share * strongest_);
  }
  [[nodiscard]] std::vector<double> strengths_beside_others() const;
  [[nodiscard]] Estimation with_effects(std::vector<Hypothesis> const& effects) const;
  void drop_superfluous();
  void exchange();
  void take_joint_estimates();
  void find_where();
  using HeatAt = std::map<std::pair<std::string, std::string>, double>;  ///< body and regime, watts
  void tell_where(HeatAt const& heat);
  void propose();
  [[nodiscard]] bool is_unknown() const;
  [[nodiscard]] Diagnosis::Verdict verdict() const;

  DiagnosisOptions const& options_;
  Value const& document_;
  std::vector<BinnedRun> const& runs_;
  Machine machine_;
  std::vector<ChannelNoise> expected_;
  std::vector<Hypothesis> hypotheses_;
  std::optional<Estimation> plain_;  ///< without any effect
  std::optional<Estimation> estimation_;
  double strongest_ = 0.0;  ///< of the effects found so far
  Fit fit_;
  Diagnosis diagnosis_;
};

void Diagnostician::calibrate() {
  estimation_.emplace(expected_estimation(document_, runs_));
  expected_ = estimation_->noise();
  fit_ = estimation_->fit(estimation_->prior_mean(), 12);
  listen_to_noise();
}

/// The noise that the present fit leaves, and the fit with it.
void Diagnostician::listen_to_noise() {
  estimation_ = estimation_->with(observed_noise(*estimation_, fit_.x, expected_));
  fit_ = estimation_->fit(fit_.x, 10);
}

Eigen::MatrixXd Diagnostician::whitened_signatures(std::vector<Hypothesis> const& hypotheses) const {
  Eigen::MatrixXd columns = signatures(*estimation_, fit_, hypotheses);
  estimation_->whiten(columns);
  return columns;
}

/// One effect more, each of those chosen, about a fit without it.
std::vector<Refit> Diagnostician::refits(Fit const& about, std::vector<std::size_t> const& chosen,
                                         std::vector<Score> const& scores) const {
  std::vector<Refit> result(chosen.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    auto& refit = result[i];
    refit.hypothesis = hypotheses_[chosen[i]];
    Eigen::VectorXd start(about.x.size() + 1);
    start << about.x, scores[chosen[i]].amplitude;
    auto const last = about.x.size();
    bool const both = refit.hypothesis.trial->either_sign;
    start[last] = std::clamp(start[last], both ? -1.5 : 1e-3, 1.5);
    try {
      Fit const fit = estimation_->with(std::vector<Hypothesis>{refit.hypothesis}).fit(start, 4);
      refit.x = fit.x;
      refit.amplitude = fit.x[last];
      refit.standard_error = std::sqrt(fit.covariance(last, last));
      refit.strength = fit_.evidence - fit.evidence;
    } catch (std::exception const&) {
      refit.strength = -INFINITY;
    }
  }
  std::stable_sort(result.begin(), result.end(), [](auto const& a, auto const& b) { return a.strength > b.strength; });
  return result;
}

/// An effect that was added, and what could stand in its place, about the fit that has it: near enough for what looks
/// alike that the linearisation decides.
std::vector<Refit> Diagnostician::instead_of(std::size_t effect, double strength) const {
  auto const own_place = Eigen::Index(estimation_->unknowns().size() - estimation_->effects().size() + effect);
  Hypothesis const& own = estimation_->effects()[effect];
  Fit const about = without(fit_, own_place);
  std::vector<Hypothesis> tried = hypotheses_;
  tried.push_back(own);
  Eigen::MatrixXd const columns = whitened_signatures(tried);
  auto const scores = score(about, columns, tried);
  Eigen::VectorXd const alike = cosines(about, columns, columns.cols() - 1);
  double const own_evidence = evidence_of(scores.back(), own, 0.5);
  std::vector<Refit> result = {
      {own, fit_.x[own_place], std::sqrt(fit_.covariance(own_place, own_place)), fit_.x, strength}};
  for (std::size_t const k : promising(scores, tried, 0.0, INFINITY)) {
    if (tried[k].label() == own.label() || std::abs(alike[Eigen::Index(k)]) < confusable) continue;
    Refit refit{tried[k], scores[k].amplitude, 1.0 / std::sqrt(scores[k].information), fit_.x,
                strength + evidence_of(scores[k], tried[k], 0.5) - own_evidence};
    refit.x[own_place] = refit.amplitude;
    result.push_back(std::move(refit));
  }
  return result;
}

/// One per name: the best site speaks for the effect.
Explanation Diagnostician::explanation_of(std::vector<Refit> const& refits) const {
  Explanation explanation;
  double sum = 0.0;
  for (auto const& refit : refits) {
    double const behind = std::max(0.0, refits[0].strength - refit.strength);
    if (behind > options_.indistinct || explanation.alternatives.size() == most_alternatives) break;
    auto const same = [&](Finding const& f) { return f.hypothesis.effect == refit.hypothesis.effect; };
    if (std::any_of(explanation.alternatives.begin(), explanation.alternatives.end(), same)) continue;
    double const unit = refit.hypothesis.trial->largest;
    Finding finding{refit.hypothesis, refit.amplitude * unit, refit.standard_error * unit, refit.strength,
                    std::exp(-0.5 * behind)};
    sum += finding.weight;
    explanation.alternatives.push_back(std::move(finding));
  }
  for (auto& finding : explanation.alternatives) finding.weight /= sum;
  return explanation;
}

/// By the score: the strongest of each of the three strongest effects, and of two more bodies. The linearisation
/// underrates an effect beside which other numbers change their meaning: a joint through which no heat flowed before.
std::vector<std::size_t> Diagnostician::most_promising(std::vector<Score> const& scores) const {
  std::vector<std::size_t> chosen;
  std::set<Effect const*> effects;
  std::set<std::string> bodies;
  int elsewhere = 0;
  for (std::size_t const k : promising(scores, hypotheses_, 0.6 * options_.threshold, INFINITY)) {
    auto const& hypothesis = hypotheses_[k];
    bool const one_more_effect = effects.size() < 3 && !effects.contains(hypothesis.effect);
    if (!one_more_effect && (bodies.contains(hypothesis.body) || ++elsewhere > 2)) continue;
    effects.insert(hypothesis.effect);
    bodies.insert(hypothesis.body);
    chosen.push_back(k);
  }
  return chosen;
}

/// The strongest effect, if it is strong enough; then, about the fit that has it, all that could stand in its place.
bool Diagnostician::add_effect(int round) {
  say(fmt::format("{} effects at their sites, round {}", hypotheses_.size(), round));
  double const threshold = round == 1 ? options_.threshold : further_threshold();
  auto const scores = score(fit_, whitened_signatures(hypotheses_), hypotheses_);
  auto const first = refits(fit_, most_promising(scores), scores);
  if (first.empty()) return false;
  Estimation const before = *estimation_;
  Fit const base = fit_;
  std::vector<Refit> all;
  Refit best = first[0], former;
  Fit former_fit;
  for (int attempt = 0; attempt < 2; ++attempt) {
    estimation_ = before.with(std::vector<Hypothesis>{best.hypothesis});
    fit_ = estimation_->fit(best.x, 15);
    best.strength = base.evidence - fit_.evidence;
    if (attempt == 1 && best.strength < former.strength) {  // it only seemed better
      best = former;
      fit_ = former_fit;
      estimation_ = before.with(std::vector<Hypothesis>{best.hypothesis});
    }
    all = instead_of(estimation_->effects().size() - 1, best.strength);
    auto const strongest = std::max_element(all.begin(), all.end(),
                                            [](Refit const& a, Refit const& b) { return a.strength < b.strength; });
    if (strongest->strength < best.strength + 2.0 || attempt == 1) break;
    former = best;
    former_fit = fit_;
    best = Refit(*strongest);
  }
  if (best.strength < threshold) {
    estimation_ = before;
    fit_ = base;
    return false;
  }
  strongest_ = std::max(strongest_, best.strength);
  diagnosis_.explanations.push_back(explanation_of(all));
  std::erase_if(hypotheses_, [&](Hypothesis const& h) { return h.label() == best.hypothesis.label(); });
  listen_to_noise();
  return true;
}

/// The machine without any effect found, with these instead, and with the noise heard last.
Estimation Diagnostician::with_effects(std::vector<Hypothesis> const& effects) const {
  return plain_->with(estimation_->noise()).with(effects);
}

/// 2 ln of the evidence for each effect found, beside all the others.
std::vector<double> Diagnostician::strengths_beside_others() const {
  auto const effects = estimation_->effects();
  auto const first = fit_.x.size() - Eigen::Index(effects.size());
  std::vector<double> strengths;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    auto others = effects;
    others.erase(others.begin() + std::ptrdiff_t(e));
    strengths.push_back(with_effects(others).fit(shorter(fit_.x, first + Eigen::Index(e)), 10).evidence -
                        fit_.evidence);
  }
  return strengths;
}

/// Backward check (physics.md 8.6): an effect that those found after it have made superfluous goes, the weakest first.
void Diagnostician::drop_superfluous() {
  while (estimation_->effects().size() > 1) {
    auto const strengths = strengths_beside_others();
    strongest_ = *std::max_element(strengths.begin(), strengths.end());
    auto const weakest = std::min_element(strengths.begin(), strengths.end()) - strengths.begin();
    for (std::size_t e = 0; e < strengths.size(); ++e) {
      auto& alternatives = diagnosis_.explanations[e].alternatives;
      double const change = strengths[e] - alternatives[0].strength;
      for (auto& alternative : alternatives) alternative.strength += change;
    }
    if (strengths[std::size_t(weakest)] >= further_threshold()) return;
    auto effects = estimation_->effects();
    effects.erase(effects.begin() + weakest);
    diagnosis_.explanations.erase(diagnosis_.explanations.begin() + weakest);
    estimation_ = with_effects(effects);
    fit_ = estimation_->fit(shorter(fit_.x, fit_.x.size() - Eigen::Index(strengths.size()) + weakest), 10);
  }
}

/// What was found first was found without the others: each effect is held anew against what could stand in its place.
void Diagnostician::exchange() {
  for (std::size_t e = 0; estimation_->effects().size() > 1 && e < estimation_->effects().size(); ++e) {
    auto const& explanation = diagnosis_.explanations[e];
    double strength = explanation.alternatives[0].strength;
    auto all = instead_of(e, strength);
    auto const best = *std::max_element(all.begin(), all.end(),
                                        [](Refit const& a, Refit const& b) { return a.strength < b.strength; });
    if (best.strength > strength + 2.0) {
      auto effects = estimation_->effects();
      effects[e] = best.hypothesis;
      Estimation const changed = with_effects(effects);
      Fit const fit = changed.fit(best.x, 10);
      if (fit.evidence < fit_.evidence - 2.0) {
        strength += fit_.evidence - fit.evidence;
        estimation_ = changed;
        fit_ = fit;
        all = instead_of(e, strength);
      }
    }
    diagnosis_.explanations[e] = explanation_of(all);
  }
}

Diagnosis Diagnostician::operator()() {
  say("calibrating");
  calibrate();
  diagnosis_.calibrated = fit_;
  hypotheses_ = hypotheses(document_, machine_, options_.without);
  std::erase_if(hypotheses_, [&](auto const& h) { return !is_excited(h, document_, machine_, runs_); });
  diagnosis_.hypotheses = hypotheses_;
  say("scanning for heat that the machine does not know");
  diagnosis_.scan = scan_for_free_heat(*estimation_, fit_);
  plain_ = estimation_;
  for (int round = 1; round <= options_.most_effects && add_effect(round); ++round) continue;
  drop_superfluous();
  exchange();
  drop_superfluous();
  if (!diagnosis_.explanations.empty()) diagnosis_.left = scan_for_free_heat(*estimation_, fit_);
  diagnosis_.faulty_sensor = faulty_sensor(machine_, runs_);
  diagnosis_.verdict = verdict();
  if (diagnosis_.verdict == Diagnosis::Verdict::none_known) diagnosis_.unknown_heat = diagnosis_.scan[0];
  diagnosis_.amended = fit_;
  diagnosis_.effects = estimation_->effects();
  diagnosis_.disagreement = disagreements(plain_->with(estimation_->noise()), diagnosis_.calibrated.x, machine_);
  if (!diagnosis_.effects.empty()) diagnosis_.disagreement_left = disagreements(*estimation_, fit_.x, machine_);
  diagnosis_.unknowns = estimation_->unknowns();
  diagnosis_.document = estimation_->document_at(fit_.x);
  take_joint_estimates();
  find_where();
  if (diagnosis_.verdict == Diagnosis::Verdict::either) propose();
  return diagnosis_;
}

/// Heat of free course is still evident, or it took two effects on the body of the first, which is about heat: the
/// catalogue does not have what acts there.
bool Diagnostician::is_unknown() const {
  auto const& found = diagnosis_.explanations;
  auto const& left = found.empty() ? diagnosis_.scan : diagnosis_.left;
  if (!left.empty() && left[0].gain > options_.heat_left) return true;
  if (found.empty()) return false;
  auto const& first = found[0].alternatives[0].hypothesis;
  auto const about_heat = [&](std::string const& what) {
    return first.effect->changes.find(what) != std::string::npos;
  };
  if (!about_heat("source") && !about_heat("film") && !about_heat("boundary")) return false;
  return std::any_of(found.begin() + 1, found.end(),
                     [&](Explanation const& other) { return other.alternatives[0].hypothesis.body == first.body; });
}

/// The best alternative of each explanation as the last fit has it, with all the others.
void Diagnostician::take_joint_estimates() {
  auto const first = diagnosis_.calibrated.x.size();
  for (std::size_t e = 0; e < diagnosis_.explanations.size(); ++e) {
    auto const u = first + Eigen::Index(e);
    auto& best = diagnosis_.explanations[e].alternatives[0];
    double const unit = best.hypothesis.trial->largest;
    best.amplitude = fit_.x[u] * unit;
    best.standard_error = std::sqrt(fit_.covariance(u, u)) * unit;
  }
}

/// Bodies and regimes that receive the heat that is missing.
void Diagnostician::find_where() {
  HeatAt heat;
  auto const add = [&](std::string const& body, LinearisedRun::MeanHeat const& mean) {
    auto& while_moving = heat[{body, "moving"}];
    auto& while_standing = heat[{body, "standing"}];
    while_moving = std::max(while_moving, std::abs(mean.moving));
    while_standing = std::max(while_standing, std::abs(mean.standing));
  };
  if (auto const& unknown = diagnosis_.unknown_heat) {
    for (std::size_t r = 0; r < runs_.size(); ++r) add(unknown->site.body, mean_heat(*unknown, r, runs_[r]));
    return tell_where(heat);
  }
  Eigen::VectorXd x = fit_.x;
  x.tail(Eigen::Index(estimation_->effects().size())).setConstant(1e-8);  // as good as none
  Machine const machine = estimation_->machine_at(fit_.x), plain = estimation_->machine_at(x);
  for (auto const& run : runs_) {
    auto const more = LinearisedRun(machine, run).more_heat_than(plain);
    for (auto const& range : machine_.network().ranges()) add(range.name, more.at(range.name));
  }
  tell_where(heat);
}

/// Those above a fifth of the largest.
void Diagnostician::tell_where(HeatAt const& heat) {
  double largest = 0.0;
  for (auto const& [place, watts] : heat) largest = std::max(largest, watts);
  for (auto const& [place, watts] : heat)
    if (watts > 0.2 * largest) diagnosis_.where.push_back(place);
}

/// What would tell the first of the either/ors apart.
void Diagnostician::propose() {
  say("looking for an experiment that would tell them apart");
  for (auto const& explanation : diagnosis_.explanations) {
    if (explanation.alternatives.size() < 2) continue;
    Rivals rivals;
    for (auto const& finding : explanation.alternatives) {
      rivals.hypotheses.push_back(finding.hypothesis);
      rivals.amplitudes.push_back(finding.amplitude / finding.hypothesis.trial->largest);
    }
    diagnosis_.proposals = remedies(document_, runs_, {rivals})[0];
    return;
  }
}

Diagnosis::Verdict Diagnostician::verdict() const {
  using Verdict = Diagnosis::Verdict;
  if (diagnosis_.faulty_sensor && diagnosis_.explanations.empty()) return Verdict::sensor;
  if (diagnosis_.explanations.empty()) return Verdict::nothing;
  if (is_unknown()) return Verdict::none_known;
  bool const sensors =
      std::all_of(diagnosis_.explanations.begin(), diagnosis_.explanations.end(), [](Explanation const& explanation) {
        return explanation.alternatives[0].hypothesis.effect->changes.find("sensor") != std::string::npos;
      });
  if (sensors) return Verdict::sensor;
  bool const single = std::all_of(diagnosis_.explanations.begin(), diagnosis_.explanations.end(),
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

Diagnosis diagnose(Value const& machine, std::vector<BinnedRun> const& runs, DiagnosisOptions const& options) {
  return Diagnostician(machine, runs, options)();
}

}  // namespace thermotwin::twin
