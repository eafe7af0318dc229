#include "twin/diagnosis/effect_search.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>

#include "twin/diagnosis/birge_ratio.h"
#include "twin/diagnosis/expected_noise.h"
#include "twin/diagnosis/observed_noise.h"
#include "twin/diagnosis/separation.h"
#include "twin/diagnosis/start.h"
#include "twin/parallel.h"

namespace thermotwin::twin {
namespace {

constexpr int most_effects = 8;
constexpr double open_loop = 0.2;          // share of free growth
constexpr double closed_law = 0.25;        // of the prior that laws have where they are open
constexpr double number_comes_back = 2.0;  // strictness with an effect, where one had left the file without
constexpr std::size_t most_refits = 24, most_rivals = 3, whitened_at_once = 32;
// What a fit in full may yet make enough, of a threshold: of a score's evidence, and of that after a few steps.
constexpr double hopeful_score = 0.3, hopeful_refit = 0.5;
// What a few steps may lack of a strength, and what is left of a threshold where an effect explains another away.
constexpr double as_likely = 12.0, explained = 0.5;

/// The most promising hypotheses, one per effect and site, strongest first.
std::vector<std::size_t> promising(std::vector<Score> const& scores, std::vector<Hypothesis> const& hypotheses,
                                   double least) {
  std::vector<double> evidence;
  for (std::size_t k = 0; k < scores.size(); ++k) evidence.push_back(evidence_of(scores[k], hypotheses[k]));
  std::vector<std::size_t> order(scores.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return evidence[a] > evidence[b]; });
  std::vector<std::size_t> chosen;
  std::map<std::string, int> seen;
  for (std::size_t const k : order) {
    if (evidence[k] < least || chosen.size() == most_refits) break;
    if (seen[hypotheses[k].label()]++ == 0) chosen.push_back(k);
  }
  return chosen;
}

/// Of an amplitude as it was fitted: no fault of a sensor, for instance, which good ones have as well.
bool is_ordinary(Hypothesis const& hypothesis, Fit const& fit, Eigen::Index unknown) {
  return hypothesis.is_ordinary(fit.x[unknown], std::sqrt(fit.covariance(unknown, unknown)));
}

/// Whether laws are first taken as the file has them: where there are any, and drawings.
bool has_closed_laws(std::vector<UncertainNumber> const& numbers) {
  return has_drawings(numbers) &&
         std::any_of(numbers.begin(), numbers.end(), [](auto const& number) { return number.of_law; });
}

Eigen::VectorXd shorter(Eigen::VectorXd const& x, Eigen::Index gone) {
  Eigen::VectorXd rest(x.size() - 1);
  rest << x.head(gone), x.tail(x.size() - gone - 1);
  return rest;
}

}  // namespace

/// What may join the effects found, or stand in the place of one of them.
struct EffectSearch::Candidates {
  std::vector<Hypothesis> hypotheses;
  Eigen::MatrixXd columns;          ///< their signatures, whitened
  std::vector<Eigen::Index> among;  ///< the columns of `signatures_` that these are
};

/// A fit with one effect more.
struct EffectSearch::Refit {
  Hypothesis hypothesis;
  double amplitude = 0.0, standard_error = 0.0;  ///< in units of its largest
  Eigen::VectorXd x;
  double strength = -INFINITY;

  /// As it was fitted; strength over a fit of this evidence.
  void take(Fit const& fit, Eigen::Index place, double evidence) {
    x = fit.x;
    amplitude = fit.x[place];
    standard_error = std::sqrt(fit.covariance(place, place));
    strength = is_ordinary(hypothesis, fit, place) ? -INFINITY : evidence - fit.evidence;
  }
  static bool is_weaker(Refit const& a, Refit const& b) { return a.strength < b.strength; }
};

EffectSearch::EffectSearch(Value const& document, std::vector<BinnedRun> const& runs,
                           std::vector<Hypothesis> hypotheses, DiagnosisOptions const& options, std::size_t start)
    : options_(options), geometry_(Machine::build(document).geometry), hypotheses_(std::move(hypotheses)) {
  say("calibrating");
  estimation_.emplace(expected_estimation(document, runs).watched(options.watch));
  bool const closed = has_closed_laws(estimation_->numbers());
  if (closed) estimation_ = estimation_->with_laws(closed_law);
  expected_ = estimation_->noise();
  bool const drawn = options.start && start == 0;
  fit_ = estimation_->fit(drawn ? drawn_start(*estimation_, *options.start) : starts(*estimation_)[start],
                          Estimation::to_the_end);
  while (free_zeros()) continue;
  open_loops();
  if (closed) open_laws();
  listen_to_noise();
  plain_ = estimation_;
  calibrated_ = fit_;
}

void EffectSearch::operator()() {
  search();
  while (acquit_sensor()) continue;
}

void EffectSearch::search() {
  for (int round = 1; round <= most_effects && add_effect(round); ++round) continue;
  if (estimation_->effects().size() < 2) return;  // what was found alone was held against all others then
  if (drop_superfluous()) linearise();
  if (exchange()) drop_superfluous();
  listen_to_noise();
}

/// A sensor that would have to be worse than is plausible is accused of what the machine does. Whether the search gets
/// farther where it goes on without that: that is taken then.
bool EffectSearch::acquit_sensor() {
  for (std::size_t e = 0; e < estimation_->effects().size(); ++e) {
    if (!estimation_->effects()[e].is_about("sensor") || !is_at_end(fit_.x[place_of(e)])) continue;
    say("once more without " + estimation_->effects()[e].label());
    EffectSearch other = *this;
    other.reject(e);
    other.search();
    if (other.misfit() > misfit() - 2.0) continue;
    *this = std::move(other);
    return true;
  }
  return false;
}

double EffectSearch::misfit() const { return fit_.evidence + estimation_->noise_scale(); }

void EffectSearch::reject(std::size_t effect) {
  auto effects = estimation_->effects();
  auto const rejected = effects[effect].label();
  std::erase_if(hypotheses_, [&](Hypothesis const& hypothesis) { return hypothesis.label() == rejected; });
  Eigen::VectorXd const start = shorter(fit_.x, place_of(effect));
  effects.erase(effects.begin() + std::ptrdiff_t(effect));
  explanations_.erase(explanations_.begin() + std::ptrdiff_t(effect));
  estimation_ = with_effects(effects);
  fit_ = estimation_->fit(start, Estimation::to_the_end);
  signatures_.resize(0, 0);
  listen_to_noise();
}

double EffectSearch::share_of_strongest() const {
  double strongest = 0.0;
  for (auto const& explanation : explanations_) strongest = std::max(strongest, explanation.alternatives[0].strength);
  return options_.least_share * strongest;
}

double EffectSearch::evident_beside() const {
  if (explanations_.empty()) return asked_of_name();
  return std::max(strictness(*estimation_, fit_) * options_.threshold, share_of_strongest());
}

/// The most where a number had to leave the file. What the form of the machine lacks there, an effect may stand in for;
/// so may one that brings a number back.
double EffectSearch::strictness_of_name() const {
  if (has_left_file(*estimation_, fit_)) return strictest;
  double const times = strictness(*estimation_, fit_);
  return has_left_file(*plain_, calibrated_) ? std::max(times, number_comes_back) : times;
}

/// What an effect found must have beside the others to be named [2 ln].
double EffectSearch::asked_of_name() const {
  return std::max(strictness_of_name() * options_.threshold, share_of_strongest());
}

/// Lets zeros change where that is evident, and more so than any one effect: that is the instruments' doing. Whether
/// any did.
bool EffectSearch::free_zeros() {
  auto const before = estimation_->zeros().size();
  auto freed = with_changed_zeros(*estimation_, fit_, strictness(*estimation_, fit_) * options_.threshold);
  if (!freed || !open(std::move(*freed), 0.0, [](Hypothesis const&) { return true; })) return false;
  if (!plain_) return true;
  std::vector<ChangedZero> const changed(estimation_->zeros().begin() + std::ptrdiff_t(before),
                                         estimation_->zeros().end());
  Eigen::VectorXd const start = plain_->with_zeros(calibrated_.x, changed.size());
  plain_ = plain_->with_zeros(changed);
  calibrated_ = plain_->fit(start, Estimation::to_the_end);
  return true;
}

/// Lets displacements leave their structural loops where that is evident, and more so than any one effect on a
/// displacement: the structure is another then than the file says.
void EffectSearch::open_loops() {
  open(fitted(estimation_->with_loops(open_loop)), 0.0, [](Hypothesis const& h) { return h.is_about("deformation"); });
}

/// Lets greases and rolling balls follow other laws than those of the file where data agree with that better, unless
/// one effect on heat is evident beyond it: few greases are quite what the file says.
void EffectSearch::open_laws() {
  open(fitted(estimation_->with_laws(1.0)), options_.threshold,
       [](Hypothesis const& h) { return !h.is_read_directly(); });
}

/// From the estimates so far.
Fitted EffectSearch::fitted(Estimation const& other) const {
  return {other, other.fit(fit_.x, Estimation::to_the_end)};
}

/// Asks that question instead where it has more evidence, and none of the rivals leads it by more. Whether it does.
bool EffectSearch::open(Fitted other, double lead, std::function<bool(Hypothesis const&)> const& rivals) {
  double const gain = fit_.evidence - other.fit.evidence;
  if (gain < 0.0 || any_exceeds(gain + lead, rivals)) return false;
  estimation_ = std::move(other.estimation);
  fit_ = std::move(other.fit);
  signatures_.resize(0, 0);
  return true;
}

/// Whether one of these effects has more evidence than that, about the present fit [2 ln].
bool EffectSearch::any_exceeds(double evidence, std::function<bool(Hypothesis const&)> const& rivals) {
  if (signatures_.size() == 0) linearise();
  auto const all = candidates();
  auto const scores = Remainder(fit_, all.columns).scores(all.hypotheses);
  std::size_t tried = 0;
  for (std::size_t const k : promising(scores, all.hypotheses, hopeful_score * evidence))
    if (rivals(all.hypotheses[k]) && tried++ < most_rivals && refits(fit_, {k}, all, scores)[0].strength > evidence)
      return true;
  return false;
}

/// The noise that the present fit leaves, and the fit with it.
void EffectSearch::listen_to_noise() {
  estimation_ = estimation_->with(observed_noise(*estimation_, fit_.x, expected_));
  fit_ = estimation_->fit(fit_.x, Estimation::to_the_end);
}

std::vector<std::pair<std::string, double>> EffectSearch::noise_heard() const {
  std::vector<std::pair<std::string, double>> times;
  for (std::size_t c = 0; c < expected_.size(); ++c) {
    auto const& heard = estimation_->noise()[c];
    times.emplace_back(estimation_->channels()[c],
                       std::max(heard.fast / expected_[c].fast, heard.slow_share / expected_[c].slow_share));
  }
  return times;
}

void EffectSearch::linearise() { signatures_ = signatures(*estimation_, fit_, hypotheses_); }

/// Among the unknowns.
Eigen::Index EffectSearch::place_of(std::size_t effect) const {
  return Eigen::Index(estimation_->unknowns().size() - estimation_->effects().size() + effect);
}

std::vector<DetectionLimit> EffectSearch::detection_limits() const {
  auto const others = candidates();
  return twin::detection_limits(*estimation_, fit_, others.hypotheses, signatures_(Eigen::all, others.among),
                                Remainder(fit_, others.columns).scores(others.hypotheses), asked_of_name());
}

/// All that is not there yet, in whatever shape. What they would stand in the place of is the last.
EffectSearch::Candidates EffectSearch::candidates(std::optional<std::size_t> in_place_of) const {
  auto const& effects = estimation_->effects();
  auto const is_there = [&](Hypothesis const& tried) {
    for (std::size_t e = 0; e < effects.size(); ++e)
      if (e != in_place_of && effects[e].label() == tried.label() &&
          effects[e].trial->amplitude == tried.trial->amplitude)
        return true;
    return false;
  };
  Candidates result;
  auto& open = result.among;
  for (std::size_t k = 0; k < hypotheses_.size(); ++k) {
    if (is_there(hypotheses_[k])) continue;
    open.push_back(Eigen::Index(k));
    result.hypotheses.push_back(hypotheses_[k]);
  }
  auto const count = Eigen::Index(open.size());
  result.columns.resize(signatures_.rows(), in_place_of ? count + 1 : count);
  in_parts(open.size(), whitened_at_once, [&](std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k) result.columns.col(Eigen::Index(k)) = signatures_.col(open[k]);
    estimation_->whiten(result.columns.middleCols(Eigen::Index(first), Eigen::Index(end - first)));
  });
  if (!in_place_of) return result;
  result.hypotheses.push_back(effects[*in_place_of]);
  result.columns.col(count) = -fit_.jacobian.column(place_of(*in_place_of));
  return result;
}

/// One effect more, each of those chosen, about a fit without it.
std::vector<EffectSearch::Refit> EffectSearch::refits(Fit const& about, std::vector<std::size_t> const& chosen,
                                                      Candidates const& candidates,
                                                      std::vector<Score> const& scores) const {
  std::vector<Refit> result(chosen.size());
  in_parallel(chosen.size(), [&](std::size_t i) {
    auto& refit = result[i];
    refit.hypothesis = candidates.hypotheses[chosen[i]];
    Eigen::VectorXd start(about.x.size() + 1);
    start << about.x, scores[chosen[i]].amplitude;
    auto const last = about.x.size();
    bool const both = refit.hypothesis.trial->either_sign;
    start[last] = std::clamp(start[last], both ? -most_of_largest : 1e-3, most_of_largest);
    auto const with_it = estimation_->with(std::vector<Hypothesis>{refit.hypothesis});
    if (auto fit = with_it.try_fit(start, 4)) refit.take(std::move(*fit), last, fit_.evidence);
  });
  std::stable_sort(result.begin(), result.end(), [](auto const& a, auto const& b) { return a.strength > b.strength; });
  return result;
}

/// An effect that was added, and what could stand in its place, about the fit that has it: near enough for what looks
/// alike that the linearisation decides. A rival that it explains away may look otherwise, and stands there for numbers
/// that are others then: that is fitted.
std::vector<EffectSearch::Refit> EffectSearch::instead_of(std::size_t effect, double strength,
                                                          std::set<std::string> const& rivals) const {
  auto const own_place = place_of(effect);
  Hypothesis const& own = estimation_->effects()[effect];
  Fit const about = without(fit_, own_place);
  auto const [tried, columns, among] = candidates(effect);
  Remainder const remainder(about, columns);
  auto const scores = remainder.scores(tried);
  Eigen::VectorXd const alike = remainder.cosines(columns.cols() - 1);
  double const own_evidence = evidence_of(scores.back(), own);
  std::vector<Refit> result = {
      {own, fit_.x[own_place], std::sqrt(fit_.covariance(own_place, own_place)), fit_.x, strength}};
  std::vector<std::size_t> fitted;
  for (std::size_t const k : promising(scores, tried, 0.0)) {
    auto const label = tried[k].label();
    if (label == own.label()) continue;
    if (std::abs(alike[Eigen::Index(k)]) < confusable_cosine) {
      if (rivals.contains(label) && explains_away(tried[k], columns.col(Eigen::Index(k)))) fitted.push_back(k);
      continue;
    }
    Refit refit{tried[k], probable_amplitude(scores[k]), probable_error(scores[k]), fit_.x,
                strength + evidence_of(scores[k], tried[k]) - own_evidence};
    refit.x[own_place] = refit.amplitude;
    result.push_back(std::move(refit));
  }
  for (auto& refit : refits_in_place_of(effect, strength, fitted, tried, scores)) result.push_back(std::move(refit));
  return result;
}

/// Whether the fit leaves next to nothing for an effect that it does not have. `signature`: whitened.
bool EffectSearch::explains_away(Hypothesis const& effect, Eigen::MatrixXd const& signature) const {
  return evidence_of(Remainder(fit_, signature).scores({effect})[0], effect) < explained * options_.threshold;
}

/// Each of those chosen in the place of an effect, fitted.
std::vector<EffectSearch::Refit> EffectSearch::refits_in_place_of(std::size_t effect, double strength,
                                                                  std::vector<std::size_t> const& chosen,
                                                                  std::vector<Hypothesis> const& tried,
                                                                  std::vector<Score> const& scores) const {
  auto const place = place_of(effect);
  std::vector<Refit> result(chosen.size());
  in_parallel(chosen.size(), [&](std::size_t i) {
    auto& refit = result[i];
    refit.hypothesis = tried[chosen[i]];
    Eigen::VectorXd start = fit_.x;
    start[place] = probable_amplitude(scores[chosen[i]]);
    auto effects = estimation_->effects();
    effects[effect] = refit.hypothesis;
    if (auto fit = with_effects(effects).try_fit(start, 10))
      refit.take(std::move(*fit), place, strength + fit_.evidence);
  });
  return result;
}

Explanation EffectSearch::explanation_of(std::vector<Refit> const& refits) const {
  Explanation explanation;
  double const too_large = std::sqrt(strictness_of_name());
  for (auto const& refit : refits) {
    Finding finding{.hypothesis = refit.hypothesis, .strength = refit.strength};
    finding.take(refit.amplitude, refit.standard_error, geometry_);
    explanation.add(finding, too_large);
  }
  explanation.keep_the_likely();
  return explanation;
}

/// By the score: the strongest of each of the three strongest effects, and of two more bodies. The linearisation
/// underrates an effect beside which other numbers change their meaning: a joint through which no heat flowed before.
std::vector<std::size_t> EffectSearch::most_promising(Candidates const& candidates, std::vector<Score> const& scores,
                                                      double threshold) const {
  std::vector<std::size_t> chosen;
  std::set<Effect const*> effects;
  std::set<std::string> bodies;
  int elsewhere = 0;
  double const least = std::max(0.6 * options_.threshold, hopeful_score * threshold);
  for (std::size_t const k : promising(scores, candidates.hypotheses, least)) {
    auto const& hypothesis = candidates.hypotheses[k];
    bool const one_more_effect = effects.size() < 3 && !effects.contains(hypothesis.effect);
    if (!one_more_effect && (bodies.contains(hypothesis.body) || ++elsewhere > 2)) continue;
    effects.insert(hypothesis.effect);
    bodies.insert(hypothesis.body);
    chosen.push_back(k);
  }
  return chosen;
}

/// The strongest effect, if it is strong enough; then, about the fit that has it, all that could stand in its place.
bool EffectSearch::add_effect(int round) {
  while (!estimation_->effects().empty() && free_zeros()) continue;
  if (signatures_.size() == 0) linearise();
  say(fmt::format("{} shapes of effects at their sites, round {}", hypotheses_.size(), round));
  double const threshold = std::max(options_.threshold, share_of_strongest());
  auto const all_others = candidates();
  auto const scores = Remainder(fit_, all_others.columns).scores(all_others.hypotheses);
  if (round == 1)
    visible_ = std::size_t(std::count_if(scores.begin(), scores.end(), [](Score const& score) {
      return usual_amplitude * std::sqrt(score.information) > wanted_distance;
    }));
  auto const first = refits(fit_, most_promising(all_others, scores, threshold), all_others, scores);
  if (first.empty() || first[0].strength < hopeful_refit * threshold) return false;
  std::set<std::string> rivals;
  for (auto const& refit : first)
    if (refit.strength > first[0].strength - as_likely) rivals.insert(refit.hypothesis.label());
  Estimation const before = *estimation_;
  Fit base = std::move(fit_);
  Eigen::MatrixXd base_signatures = std::move(signatures_);
  std::vector<Refit> all;
  Refit best = first[0], former;
  Fit former_fit;
  for (int attempt = 0; attempt < 2; ++attempt) {
    estimation_ = before.with(std::vector<Hypothesis>{best.hypothesis});
    fit_ = estimation_->fit(best.x, Estimation::to_the_end);
    bool const ordinary = is_ordinary(best.hypothesis, fit_, fit_.x.size() - 1);
    best.strength = ordinary ? -INFINITY : base.evidence - fit_.evidence;
    if (attempt == 1 && best.strength < former.strength) {  // it only seemed better
      best = former;
      fit_ = std::move(former_fit);
      estimation_ = before.with(std::vector<Hypothesis>{best.hypothesis});
    }
    linearise();
    all = instead_of(estimation_->effects().size() - 1, best.strength, rivals);
    auto const strongest = std::max_element(all.begin(), all.end(), Refit::is_weaker);
    if (strongest->strength < best.strength + 2.0 || attempt == 1) break;
    former = best;
    former_fit = std::move(fit_);
    best = Refit(*strongest);
  }
  if (double const asked = asked_of_name(); best.strength < asked) {
    if (explanations_.empty() && best.strength >= hopeful_refit * asked) suspicion_ = {explanation_of(all), asked};
    estimation_ = before;
    fit_ = std::move(base);
    signatures_ = std::move(base_signatures);
    return false;
  }
  explanations_.push_back(explanation_of(all));
  listen_to_noise();
  return true;
}

/// The machine without any effect found, with these instead, and with the noise heard last.
Estimation EffectSearch::with_effects(std::vector<Hypothesis> const& effects) const {
  return plain_->with(estimation_->noise()).with(effects);
}

/// 2 ln of the evidence for each effect found, beside all the others; what is ordinary has none.
std::vector<double> EffectSearch::strengths_beside_others() const {
  auto const effects = estimation_->effects();
  auto const first = fit_.x.size() - Eigen::Index(effects.size());
  std::vector<double> strengths(effects.size(), -INFINITY);
  in_parallel(effects.size(), [&](std::size_t e) {
    if (is_ordinary(effects[e], fit_, first + Eigen::Index(e))) return;
    auto others = effects;
    others.erase(others.begin() + std::ptrdiff_t(e));
    auto const without_it = with_effects(others).try_fit(shorter(fit_.x, first + Eigen::Index(e)), 10);
    strengths[e] = without_it ? without_it->evidence - fit_.evidence : explanations_[e].alternatives[0].strength;
  });
  return strengths;
}

/// Backward check (physics.md 8.6): an effect that those found after it have made superfluous goes, the weakest first.
/// Whether any did.
bool EffectSearch::drop_superfluous() {
  bool dropped = false;
  while (!estimation_->effects().empty()) {
    auto const strengths = strengths_beside_others();
    auto const weakest = std::min_element(strengths.begin(), strengths.end()) - strengths.begin();
    for (std::size_t e = 0; e < strengths.size(); ++e) {
      auto& alternatives = explanations_[e].alternatives;
      double const change = strengths[e] - alternatives[0].strength;
      for (auto& alternative : alternatives)
        if (std::isfinite(change)) alternative.strength += change;
      alternatives[0].strength = strengths[e];
    }
    if (strengths[std::size_t(weakest)] >= asked_of_name()) break;
    dropped = true;
    auto effects = estimation_->effects();
    effects.erase(effects.begin() + weakest);
    explanations_.erase(explanations_.begin() + weakest);
    estimation_ = with_effects(effects);
    fit_ = estimation_->fit(shorter(fit_.x, fit_.x.size() - Eigen::Index(strengths.size()) + weakest), 10);
  }
  return dropped;
}

/// What was found first was found without the others: each effect is held anew against what could stand in its place.
/// Whether any was exchanged.
bool EffectSearch::exchange() {
  bool exchanged = false;
  for (std::size_t e = 0; e < estimation_->effects().size(); ++e) {
    auto const& explanation = explanations_[e];
    double strength = explanation.alternatives[0].strength;
    std::set<std::string> rivals;
    for (auto const& alternative : explanation.alternatives) rivals.insert(alternative.hypothesis.label());
    auto all = instead_of(e, strength, rivals);
    auto const best = *std::max_element(all.begin(), all.end(), Refit::is_weaker);
    if (best.strength > strength + 2.0) {
      auto effects = estimation_->effects();
      effects[e] = best.hypothesis;
      Estimation const changed = with_effects(effects);
      auto fit = changed.try_fit(best.x, 10);
      auto const place = best.x.size() - Eigen::Index(effects.size() - e);
      if (fit && fit->evidence < fit_.evidence - 2.0 && !is_ordinary(best.hypothesis, *fit, place)) {
        strength += fit_.evidence - fit->evidence;
        estimation_ = changed;
        fit_ = std::move(*fit);
        linearise();
        exchanged = true;
        all = instead_of(e, strength, rivals);
      }
    }
    explanations_[e] = explanation_of(all);
  }
  return exchanged;
}

EffectSearch best_search(Value const& document, std::vector<BinnedRun> const& runs,
                         std::vector<Hypothesis> const& hypotheses, DiagnosisOptions const& options) {
  EffectSearch best(document, runs, hypotheses, options);
  best();
  std::size_t const others = starts(best.plain()).size() - 1;
  for (std::size_t start = 1; start <= others; ++start) {
    if (options.progress) options.progress(fmt::format("from a start nearby, {} of {}", start, others));
    EffectSearch other(document, runs, hypotheses, options, start);
    other();
    if (other.misfit() < best.misfit()) best = std::move(other);
  }
  return best;
}

}  // namespace thermotwin::twin
