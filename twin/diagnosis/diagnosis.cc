#include "twin/diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "twin/diagnosis/drifting_sensor.h"
#include "twin/diagnosis/estimate_text.h"
#include "twin/diagnosis/excitation.h"
#include "twin/diagnosis/expected_noise.h"
#include "twin/diagnosis/gap.h"
#include "twin/diagnosis/jumping_sensor.h"
#include "twin/diagnosis/seen_form.h"
#include "twin/diagnosis/uncertain_number.h"
#include "twin/diagnosis/verdict.h"
#include "twin/parallel.h"

namespace thermotwin::twin {
namespace {

constexpr int fine = 48;  // knots of a scan: half an hour tells from another body what is switched by its own clock
// What heat of a free course needs where no effect was found, of what an effect does: it follows what the form of a
// machine gets wrong, too.
constexpr double free_heat_alone = 2.5;
// What it needs beside effects on heat, of the strongest one's evidence, to contradict them: less is left of an effect
// whose course is not quite the catalogue's. Weights of a machine without drawings leave little of any heat.
constexpr double free_heat_beside = 0.1;

/// Of the best place; nothing where none was tried.
double gain_of(std::vector<FreeHeat> const& scan) { return scan.empty() ? 0.0 : scan[0].gain; }

bool is_about_heat(Hypothesis const& effect) {
  return effect.is_about("source") || effect.is_about("film") || effect.is_about("boundary");
}

class Diagnostician {
 public:
  Diagnostician(Value const& machine, std::vector<BinnedRun> const& runs, std::vector<BinnedRun> const& held_out,
                DiagnosisOptions const& options)
      : options_(options),
        document_(machine),
        runs_(runs),
        held_out_(held_out),
        machine_(Machine::build(machine)),
        hypotheses_(excited_hypotheses()),
        search_(best_search(machine, runs, hypotheses_, options)) {}
  Diagnosis operator()();
  [[nodiscard]] double misfit() const { return search_.misfit(); }

 private:
  void say(std::string const& what) const {
    if (options_.progress) options_.progress(what);
  }
  [[nodiscard]] std::vector<Hypothesis> excited_hypotheses() const;
  [[nodiscard]] FreeHeat unknown_heat() const;
  [[nodiscard]] Estimation on_held_out(Value const& document) const;
  void ask_held_out();
  struct Written;
  void write_down();
  bool write_down_and_reject();
  void find_where();
  void find_zeros();
  using HeatAt = std::map<std::pair<std::string, std::string>, double>;  ///< body and regime, watts
  void tell_where(HeatAt const& heat);
  void propose();
  [[nodiscard]] Explanation const* unsettled() const;
  [[nodiscard]] double strongest_on_heat() const;
  [[nodiscard]] bool is_heat_left() const;
  [[nodiscard]] std::optional<std::string> first_warmed() const;

  DiagnosisOptions const& options_;
  Value const& document_;
  std::vector<BinnedRun> const& runs_;
  std::vector<BinnedRun> const& held_out_;
  Machine machine_;
  std::vector<Hypothesis> hypotheses_;
  EffectSearch search_;
  std::optional<Value> calibrated_;  ///< what a file can say of the machine without effects
  Diagnosis diagnosis_;
};

/// Those that would show in these runs at all, in all shapes that are tried.
std::vector<Hypothesis> Diagnostician::excited_hypotheses() const {
  auto all = hypotheses(document_, machine_, options_.without);
  std::erase_if(all, [&](auto const& h) { return !is_excited(h, document_, machine_, runs_); });
  share_probability(all, machine_);
  return with_those_of_some_size(std::move(all));
}

Diagnosis Diagnostician::operator()() {
  auto& d = diagnosis_;
  d.calibrated = search_.calibrated();
  d.hypotheses = hypotheses_;
  say("scanning for heat that the machine does not know");
  d.scan = scan_for_free_heat(search_.plain(), d.calibrated);
  while (write_down_and_reject()) search_();
  auto const& amended = search_.estimation();
  if (!held_out_.empty()) ask_held_out();
  d.visible = search_.visible();
  d.could_hide = search_.detection_limits();
  d.noise_heard = search_.noise_heard();
  if (!d.effects.empty()) d.left = scan_for_free_heat(amended, d.amended);
  d.faulty_sensor = faulty_sensor(machine_, runs_);
  if (!d.faulty_sensor && d.effects.empty() && !is_heat_left()) {
    d.faulty_sensor = jumping_sensor(machine_, search_.plain(), d.calibrated, options_.threshold);
    if (!d.faulty_sensor) d.faulty_sensor = drifting_sensor(search_.plain(), d.calibrated, d.hypotheses);
  }
  d.verdict = verdict_on(d, is_heat_left());
  d.heat_beside = gain_of(d.left) > search_.evident_beside() && d.verdict != Diagnosis::Verdict::none_known;
  if (d.verdict == Diagnosis::Verdict::none_known) {
    bool const scanned = gain_of(d.scan) > search_.evident_beside();
    if (auto const body = first_warmed(); body && !is_heat_left())
      d.unknown_heat = heat_of_effects(amended, d.amended, *body);
    else if (is_heat_left() || scanned)
      d.unknown_heat = unknown_heat();
    if (d.unknown_heat) d.unknown_heat_by_speed = heat_by_speed(*d.unknown_heat, runs_);
  }
  d.disagreement = disagreements(search_.plain().with(amended.noise()), d.calibrated.x, machine_);
  if (!d.effects.empty()) d.disagreement_left = disagreements(amended, d.amended.x, machine_);
  find_where();
  find_zeros();
  if (d.verdict == Diagnosis::Verdict::nothing) d.suspicion = search_.suspicion();
  propose();
  return std::move(diagnosis_);
}

/// What a file can say of these unknowns: the fit for lumps that hide nothing.
struct Diagnostician::Written {
  Written(Estimation const& estimation, Fit const& whole)
      : seen(seen_of_form(estimation, whole)),
        fit(estimation.with_form_of_file(seen).about(whole.x).fit(whole.x)),
        form(estimation, seen, fit.x),
        document(estimation.document_at(fit.x)) {
    form.put_into(document);
  }
  std::vector<std::size_t> seen;
  Fit fit;  ///< about the whole one: places and steps beyond a loop act as the calibrated bodies warm
  SeenForm form;
  Value document;
};

/// Takes back what a machine in the form of its file has next to nothing of: what lumps hide was bent around it.
/// Whether anything was.
bool Diagnostician::write_down_and_reject() {
  write_down();
  auto const& found = diagnosis_.explanations;
  auto const rejected = std::find_if(found.begin(), found.end(), [](Explanation const& explanation) {
    return explanation.alternatives[0].is_negligible();
  });
  if (rejected == found.end()) return false;
  search_.reject(std::size_t(rejected - found.begin()));
  return true;
}

/// Amplitudes are those of what files get; their errors are those of the fit that knows what lumps may hide.
void Diagnostician::write_down() {
  auto& d = diagnosis_;
  auto const& amended = search_.estimation();
  d.explanations = search_.explanations();
  d.amended = search_.fit();
  d.effects = amended.effects();
  d.unknowns = amended.unknowns();
  std::optional<Written> written;
  in_parallel(d.effects.empty() || calibrated_ ? 1 : 2, [&](std::size_t i) {
    if (i == 0)
      written.emplace(amended, d.amended);
    else
      calibrated_ = Written(search_.plain(), d.calibrated).document;
  });
  d.changes = changed_numbers(amended, written->fit);
  for (auto& lag : changed_lags(amended, written->fit)) d.changes.push_back(std::move(lag));
  for (auto& change : written->form.changes()) d.changes.push_back(std::move(change));
  d.written = std::move(written->fit);
  d.document = std::move(written->document);
  d.calibrated_document = d.effects.empty() ? d.document : *calibrated_;
  auto const first = d.amended.x.size() - Eigen::Index(d.effects.size());
  for (std::size_t e = 0; e < d.effects.size(); ++e) {
    auto const u = first + Eigen::Index(e);
    d.explanations[e].alternatives[0].take(d.written.x[u], std::sqrt(d.amended.covariance(u, u)), machine_.geometry);
  }
}

/// The runs that had no say so far, asked of a machine as it was fitted. A channel that the fitted runs lack has the
/// noise that is expected of it.
Estimation Diagnostician::on_held_out(Value const& document) const {
  auto const& amended = search_.estimation();
  auto channels = amended.channels();
  auto noise = amended.noise();
  for (auto const& channel : channels_of(held_out_)) {
    if (std::find(channels.begin(), channels.end(), channel) != channels.end()) continue;
    channels.push_back(channel);
    noise.push_back(expected_noise(machine_, channel, held_out_));
  }
  return {document, held_out_, channels, noise};
}

/// What they say of the machine that is written, and where effects were found, of the calibrated one beside it: what is
/// linear is at its best for either.
void Diagnostician::ask_held_out() {
  auto& d = diagnosis_;
  double amended = 0.0, calibrated = 0.0;
  in_parallel(d.effects.empty() ? 1 : 2, [&](std::size_t i) {
    if (i == 1) {
      calibrated = on_held_out(d.calibrated_document).cost_of_document();
      return;
    }
    Estimation const asked = on_held_out(d.document);
    d.disagreement_held_out = disagreements(asked, asked.fit(asked.prior_mean(), 0).x, machine_);
    if (!d.effects.empty()) amended = asked.cost_of_document();
  });
  if (!d.effects.empty()) d.vote = calibrated - amended;
}

double Diagnostician::strongest_on_heat() const {
  double strongest = 0.0;
  for (auto const& explanation : diagnosis_.explanations)
    if (auto const& best = explanation.alternatives[0]; is_about_heat(best.hypothesis))
      strongest = std::max(strongest, best.strength);
  return strongest;
}

/// Heat of free course that no name accounts for: too evident for those that were found, or where there are none.
bool Diagnostician::is_heat_left() const {
  if (diagnosis_.explanations.empty()) return gain_of(diagnosis_.scan) > free_heat_alone * search_.evident_beside();
  double const share = has_drawings(search_.plain().numbers()) ? free_heat_beside : 0.0;
  return gain_of(diagnosis_.left) > std::max(search_.evident_beside(), share * strongest_on_heat());
}

/// By the first effect that is about heat; what acts on the machine as a whole warms no one body.
std::optional<std::string> Diagnostician::first_warmed() const {
  auto const& bodies = machine_.network().ranges();
  auto const& effects = diagnosis_.effects;
  for (std::size_t e = 0; e < effects.size(); ++e)
    if (is_about_heat(effects[e]) &&
        std::any_of(bodies.begin(), bodies.end(), [&](auto const& range) { return range.name == effects[e].body; }))
      return warmed_most(search_.estimation(), diagnosis_.amended, e);
  return std::nullopt;
}

/// About the numbers of the file: those that were calibrated without the heat have taken part of it. So has the noise
/// that was heard where no effect stands in for it.
FreeHeat Diagnostician::unknown_heat() const {
  bool const bare = only_sensors(diagnosis_);
  Estimation const plain = search_.plain().with(bare ? search_.expected_noise() : search_.estimation().noise());
  return scan_for_free_heat(plain, plain.fit(plain.prior_mean(), 0), fine)[0];
}

void Diagnostician::find_zeros() {
  auto const& amended = search_.estimation();
  auto const& d = diagnosis_;
  for (std::size_t u = 0; u < d.unknowns.size(); ++u) {
    if (d.unknowns[u].kind != Unknown::Kind::zero) continue;
    auto const& zero = amended.zeros()[d.unknowns[u].index];
    auto const& run = runs_[zero.run];
    auto const& channel = run.run->channels[zero.channel];
    auto const i = Eigen::Index(u);
    diagnosis_.zeros.push_back({run.run->name, channel.name, unit_of(channel, machine_), zero.from,
                                !zero.is_in_all_of(run), d.amended.x[i], std::sqrt(d.amended.covariance(i, i))});
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
  if (auto const& unknown = diagnosis_.unknown_heat; unknown && unknown->gain > 0.0) {
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      auto const [moving, standing] = mean_heat(*unknown, r, runs_[r]);
      for (auto const& [body, share] : unknown->shares()) add(body, {share * moving, share * standing});
    }
    return tell_where(heat);
  }
  if (diagnosis_.effects.empty()) return;
  auto const& amended = search_.estimation();
  Eigen::VectorXd x = diagnosis_.amended.x;
  x.tail(Eigen::Index(diagnosis_.effects.size())).setConstant(as_good_as_none);
  Machine const machine = amended.machine_at(diagnosis_.amended.x), plain = amended.machine_at(x);
  for (auto const& run : runs_) {
    LinearisedRun const twin(machine, run);
    auto const more = twin.more_heat_than(plain);
    for (auto const& range : machine_.network().ranges()) add(range.name, twin.mean(more.at(range.name)));
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

/// What would settle the first of the either/ors, or a suspicion.
void Diagnostician::propose() {
  auto const* open = unsettled();
  if (!open) return;
  say("looking for an experiment that would tell");
  Rivals rivals;
  for (auto const& finding : open->alternatives) {
    rivals.hypotheses.push_back(finding.hypothesis);
    rivals.amplitudes.push_back(finding.amplitude / finding.hypothesis.largest);
  }
  diagnosis_.proposals = remedies(document_, runs_, {rivals})[0];
}

Explanation const* Diagnostician::unsettled() const {
  auto const& d = diagnosis_;
  if (d.suspicion) return &d.suspicion->explanation;
  if (d.verdict != Diagnosis::Verdict::either) return nullptr;
  auto const several = [](Explanation const& explanation) { return explanation.alternatives.size() > 1; };
  return &*std::find_if(d.explanations.begin(), d.explanations.end(), several);
}

}  // namespace

Diagnosis diagnose(Value const& machine, std::vector<BinnedRun> const& runs, DiagnosisOptions const& options,
                   std::vector<BinnedRun> const& held_out) {
  Diagnostician as_written(machine, runs, held_out, options);
  auto friction = friction_while_moving(machine, runs, options.threshold, options.watch);
  if (!friction) return as_written();
  Diagnostician other(friction->document, runs, held_out, options);
  friction->gain = as_written.misfit() - other.misfit();
  if (friction->gain < options.threshold) return as_written();
  Diagnosis diagnosis = other();
  for (auto& change : friction->changes()) diagnosis.changes.push_back(std::move(change));
  diagnosis.friction = std::move(friction);
  return diagnosis;
}

}  // namespace thermotwin::twin
