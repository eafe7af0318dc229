#include "twin/diagnosis/diagnosis_report.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>

#include "twin/diagnosis/estimate_text.h"
#include "twin/diagnosis/separation.h"

namespace thermotwin::twin {
namespace {

constexpr std::size_t most_places = 6, most_keys = 3, most_hidden = 6, most_held_out = 4;
constexpr double worth_telling = 1.0;  // of what could hide [um, 0.1 K]
constexpr double loud = 4.0;
constexpr double large_share_of_growth = 0.2;

/// "coefficient = 27 W/(m2 K) ± 10 W/(m2 K), with area = 0.5 m2": few keys are told, many stand in the amended file.
std::string amplitude_text(Finding const& finding) {
  auto const& hypothesis = finding.hypothesis;
  std::string const unit = readable_unit(finding.amplitude, hypothesis.dimension());
  std::string text = fmt::format("{} = {} {}", hypothesis.trial->amplitude, written_value(finding.amplitude, unit, 3),
                                 finding.interval_text(unit));
  auto const is_site = [&](std::string const& key) {
    return std::any_of(hypothesis.trial->sites.begin(), hypothesis.trial->sites.end(),
                       [&](auto const& site) { return key == site.key || key == site.other || key == "axis"; });
  };
  std::vector<std::string> others;
  for (auto const& [key, value] : hypothesis.keys)
    if (!is_site(key)) others.push_back(key + " = " + value);
  if (!others.empty() && others.size() <= most_keys) text += fmt::format(", with {}", fmt::join(others, ", "));
  return text;
}

/// "40.0 ± 6.1 W", with the half of its 95 % interval.
std::string words_of(Watts const& watts) {
  return fmt::format("{:.1f} ± {:.1f} W", watts.mean, two_sided_95 * watts.standard_error);
}

/// Of a column that holds these names.
template <class Rows, class Name>
std::size_t widest(Rows const& rows, std::size_t least, Name const& name) {
  for (auto const& row : rows) least = std::max(least, name(row).size());
  return least;
}

/// A number of a table, or "-" where a dead channel has none.
std::string in_column(double number) { return std::isnan(number) ? "-" : fmt::format("{:.3f}", number); }

/// Of each channel that disagrees significantly, the speed at which it does so most; where there is none, the hours.
/// The worst first.
std::vector<Disagreement const*> worst_of_channels(std::vector<Disagreement> const& cells) {
  std::map<std::string, Disagreement const*> worst;
  for (bool const hours : {false, true}) {
    std::map<std::string, Disagreement const*> here;
    for (auto const& cell : cells) {
      if (!cell.significant || (cell.cut == "time") != hours) continue;
      auto& most = here[cell.channel];
      if (!most || cell.power > most->power) most = &cell;
    }
    worst.merge(here);
  }
  std::vector<Disagreement const*> order;
  for (auto const& [channel, cell] : worst) order.push_back(cell);
  std::stable_sort(order.begin(), order.end(), [](auto const* a, auto const* b) { return a->power > b->power; });
  return order;
}

/// Where and when.
std::string words_of(std::vector<Disagreement> const& cells, bool something_is_missing) {
  auto order = worst_of_channels(cells);
  if (order.empty())
    return something_is_missing
               ? "No channel at any speed alone contradicts the calibrated twin: what was found is evident only in all "
                 "channels and times together.\n\n"
               : "The calibrated twin disagrees significantly with no channel at any time.\n\n";
  order.resize(std::min(order.size(), most_places));
  auto const channel_width = widest(order, 12, [](auto const* cell) { return cell->channel; });
  auto const run_width = widest(order, 10, [](auto const* cell) { return cell->run; });
  std::string text = fmt::format(
      "Where and when the calibrated twin disagrees most (measured minus twin; power of noise alone: 1):\n"
      "  {:<{}} {:<{}} {:<16} {:>9} {:>9} {:<4} {:>7}\n",
      "channel", channel_width, "run", run_width, "part", "mean", "RMS", "", "power");
  for (auto const* cell : order)
    text += fmt::format("  {:<{}} {:<{}} {:<16} {:>+9.3f} {:>9.3f} {:<4} {:>7.1f}\n", cell->channel, channel_width,
                        cell->run, run_width, cell->part, in_unit(cell->unit, cell->mean),
                        in_unit(cell->unit, cell->rms), cell->unit, cell->power);
  return text + "\n";
}

/// What the effects gain at the tool, or at a sensor if no displacement was measured.
std::string words_of_gain(Diagnosis const& diagnosis, std::vector<ChannelGap> const& gaps, std::string const& data) {
  auto const worth = [](ChannelGap const& gap) { return std::pair(gap.unit == "um", gap.before); };
  ChannelGap const* most = nullptr;
  for (auto const& gap : gaps)
    if (!std::isnan(gap.before) && (!most || worth(*most) < worth(gap))) most = &gap;  // a dead channel has none
  if (diagnosis.explanations.empty() || !most) return "";
  return fmt::format(
      "With {}, the error of the twin at {} on {} data {} from {:.3g} to {:.3g} {} RMS; calibration alone leaves "
      "{:.3g}.\n\n",
      diagnosis.explanations.size() == 1 ? "it" : "them", most->channel, data,
      most->after < most->before ? "falls" : "grows", in_unit(most->unit, most->before),
      in_unit(most->unit, most->after), most->unit, in_unit(most->unit, most->calibrated));
}

std::string table_of(std::vector<ChannelGap> const& gaps) {
  auto const run_width = widest(gaps, 20, [](auto const& gap) { return gap.run; });
  auto const channel_width = widest(gaps, 10, [](auto const& gap) { return gap.channel; });
  std::string text = fmt::format("  {:<{}} {:<{}} {:>10} {:>10} {:>10}\n", "run", run_width, "channel", channel_width,
                                 "file", "calibrated", "amended");
  for (auto const& gap : gaps)
    text += fmt::format("  {:<{}} {:<{}} {:>10} {:>10} {:>10} {}\n", gap.run, run_width, gap.channel, channel_width,
                        in_column(in_unit(gap.unit, gap.before)), in_column(in_unit(gap.unit, gap.calibrated)),
                        in_column(in_unit(gap.unit, gap.after)), gap.unit);
  return text;
}

std::string words_of(Explanation const& explanation) {
  auto const& all = explanation.alternatives;
  std::string text;
  if (all.size() > 1) text += fmt::format("One of {}; these data do not tell them apart:\n", all.size());
  for (auto const& finding : all) {
    text += fmt::format("  {} at {}: {}", finding.hypothesis.effect->meaning, finding.hypothesis.site,
                        amplitude_text(finding));
    if (all.size() > 1) text += fmt::format("  ({:.0f} %)", 100.0 * finding.weight);
    text += fmt::format("\n      [[{}]], 2 ln evidence {:.0f}\n", finding.hypothesis.effect->name, finding.strength);
  }
  if (all.size() > 1 && !all[0].hypothesis.effect->separated_by.empty())
    text += fmt::format("  What would tell them apart: {}\n", all[0].hypothesis.effect->separated_by);
  return text;
}

std::string words_of_proposal(Diagnosis const& diagnosis) {
  auto const* proposal = proposal_of(diagnosis);
  if (!proposal) return "";
  auto const& best = diagnosis.proposals[0];
  bool const tells = proposal->distance >= wanted_distance;
  std::string text =
      fmt::format("Experiment that would {}{}: {} ({:.0f} h), {:.1f} σ{}.", tells ? "" : "best ",
                  diagnosis.suspicion ? "show it" : "tell them apart", proposal->schedule, proposal->hours,
                  proposal->distance, tells ? "" : fmt::format(" of {:g} that are wanted", wanted_distance));
  if (!best.sensor.empty() && best.distance > 1.5 * proposal->distance)
    text += fmt::format(" With one more sensor on {}: {}, {:.1f} σ.", best.sensor, best.schedule, best.distance);
  return text + "\n\n";
}

/// Of each effect the site at which it moves most without being named.
std::vector<DetectionLimit const*> largest_that_could_hide(Diagnosis const& diagnosis) {
  std::vector<DetectionLimit const*> largest;
  std::set<std::string> told;
  for (auto const& limit : diagnosis.could_hide) {
    bool const counts = in_unit(limit.unit, limit.swing) >= worth_telling * (limit.unit == "K" ? 0.1 : 1.0);
    if (counts && largest.size() < most_hidden && told.insert(limit.hypothesis.effect->name).second)
      largest.push_back(&limit);
  }
  return largest;
}

std::string words_of_what_could_hide(Diagnosis const& diagnosis) {
  auto const largest = largest_that_could_hide(diagnosis);
  if (largest.empty()) return "";
  std::string text =
      "What could hide, as calibration takes it for numbers of the file (19 of 20 such records show more):\n";
  for (auto const* limit : largest) {
    auto const& hypothesis = limit->hypothesis;
    text += fmt::format(
        "  {} at {}: {}, {:.1f} {} of {} in these runs\n", hypothesis.effect->name, hypothesis.site,
        limit->any_size
            ? "of any plausible size"
            : fmt::format("{} up to {}", hypothesis.trial->amplitude,
                          written_value(limit->amplitude, readable_unit(limit->amplitude, hypothesis.dimension()), 2)),
        in_unit(limit->unit, limit->swing), limit->unit, limit->channel);
  }
  return text + "\n";
}

/// What comes nearest, and what the data could not have shown.
std::string words_of_silence(Diagnosis const& diagnosis) {
  if (diagnosis.verdict != Diagnosis::Verdict::nothing) return "";
  std::string text;
  if (auto const& suspicion = diagnosis.suspicion)
    text += fmt::format("Suspected, of 2 ln evidence {:.1f} where {:.1f} is asked for:\n{}\n",
                        suspicion->explanation.alternatives[0].strength, suspicion->asked,
                        words_of(suspicion->explanation));
  return text +
         fmt::format(
             "Of {} shapes of effects at their sites, {} would have been seen at half of their largest "
             "size.\n\n",
             diagnosis.hypotheses.size(), diagnosis.visible) +
         words_of_what_could_hide(diagnosis);
}

/// Where they speak against what was found.
std::string words_of_vote(Diagnosis const& diagnosis) {
  if (diagnosis.vote.value_or(0.0) > -1.0) return "";
  return fmt::format(
      "The runs held out speak against it, {}: they are likelier by calibration alone, by {:.0f} of 2 ln.\n\n",
      diagnosis.is_refuted() ? "more than the others for it" : "though less than the others for it", -*diagnosis.vote);
}

/// Where they contradict the machine that was found, or found to lack nothing.
std::string words_of_held_out(Diagnosis const& diagnosis) {
  std::vector<std::string> places;
  for (auto const* cell : worst_of_channels(diagnosis.disagreement_held_out))
    if (cell->power >= loud && places.size() < most_held_out)
      places.push_back(fmt::format("{} in {}, {}, by {:.3g} {} RMS (power {:.0f})", cell->channel, cell->run,
                                   cell->part, in_unit(cell->unit, cell->rms), cell->unit, cell->power));
  if (places.empty()) return "";
  return fmt::format(
      "The runs held out contradict the machine {}: {}. Something is other there than in the runs that "
      "were fitted.\n\n",
      diagnosis.effects.empty() ? "as calibrated" : "as amended", fmt::join(places, "; "));
}

/// "Were it the air at the machine, warmer than its record by −1.2 to 0.8 K".
std::string words_of_air(FreeHeat const& air) {
  double least = INFINITY, most = -INFINITY;
  for (auto const& heat : air.heat) {
    least = std::min(least, heat.minCoeff());
    most = std::max(most, heat.maxCoeff());
  }
  double const per_kelvin = air.per_kelvin.at(air.site.body);
  return fmt::format("Were it the air at the machine, warmer than its record by {:+.1f} to {:+.1f} K",
                     least / per_kelvin, most / per_kelvin);
}

/// "5.1 ± 6.9 W on average into bed, of the air".
std::string words_of_place(FreeHeat const& heat) {
  return fmt::format("{} on average into {}{}", words_of(heat.mean_of_all()), heat.site.body,
                     heat.site.is_air() ? ", of the air" : "");
}

std::string words_of_heat(Diagnosis const& diagnosis) {
  if (!diagnosis.unknown_heat) return "";
  auto const& all = *diagnosis.unknown_heat;
  std::string text = fmt::format("{}: {} on average into {}.\n",
                                 all.site.is_air() ? words_of_air(all)
                                 : all.gain > 0.0  ? "Were it one heat of free course"
                                                   : "What stands in for it brings",
                                 words_of(all.mean_of_all()), all.site.body);
  auto const& by_speed = diagnosis.unknown_heat_by_speed;
  if (by_speed.mean.size() > 1) {
    std::vector<std::string> parts;
    for (auto const& [name, watts] : by_speed.mean) parts.push_back(name + ' ' + words_of(watts));
    text += fmt::format("By speed: {}; about these it swings by {:.1f} W (root mean square).\n", fmt::join(parts, ", "),
                        by_speed.swing);
  }
  if (!diagnosis.left.empty())
    text += "Beside what stands in for it, still: " + words_of_place(diagnosis.left[0]) + ".\n";
  return text + "\n";
}

std::string words_of_heat_beside(Diagnosis const& diagnosis) {
  if (!diagnosis.heat_beside) return "";
  return fmt::format(
      "Heat of free course is left, {}, 2 ln evidence {:.0f}: an effect whose course is not quite the catalogue's "
      "leaves as much, or the form of the machine.\n\n",
      words_of_place(diagnosis.left[0]), diagnosis.left[0].gain);
}

/// Numbers that no longer are what the file says: "bearing.front.grease_factor = 2.04 (5.5)".
std::vector<std::string> far_numbers(Diagnosis const& diagnosis) {
  std::vector<std::string> far;
  for (std::size_t u = 0; u < diagnosis.unknowns.size(); ++u) {
    auto const& unknown = diagnosis.unknowns[u];
    double const departure = unknown.departure(diagnosis.written.x[Eigen::Index(u)]);
    if (unknown.kind != Unknown::Kind::number || departure < far_from_file) continue;
    for (auto const& change : diagnosis.changes)
      if (change.path == unknown.name)
        far.push_back(fmt::format("{} = {} ({:.1f})", change.path, change.text, departure));
  }
  return far;
}

std::string words_of_numbers(Diagnosis const& diagnosis) {
  auto const far = far_numbers(diagnosis);
  if (far.empty()) return "";
  return fmt::format(
      "Numbers that had to leave the file, by more than {:g} of their prior deviations: {}. Is the file right "
      "there?\n\n",
      far_from_file, fmt::join(far, ", "));
}

/// "offset of T14 = -1.20 K (4.0)".
std::string words_of_offsets(Diagnosis const& diagnosis) {
  std::vector<std::string> far;
  for (std::size_t u = 0; u < diagnosis.unknowns.size(); ++u) {
    auto const& unknown = diagnosis.unknowns[u];
    bool const of_sensor = unknown.kind == Unknown::Kind::offset && unknown.run < 0;
    double const offset = diagnosis.amended.x[Eigen::Index(u)], departure = unknown.departure(offset);
    if (of_sensor && departure >= far_from_file)
      far.push_back(fmt::format("{} = {:.2f} K ({:.1f})", unknown.name, offset, departure));
  }
  if (far.empty()) return "";
  return fmt::format(
      "Larger than is usual, by more than {:g} of their prior deviations: {}. Was what they touch as warm as the air "
      "when the runs began?\n\n",
      far_from_file, fmt::join(far, ", "));
}

/// "T8 stands +0.56 ± 0.04 K otherwise in B.csv than in the other runs".
std::string words_of(FoundZero const& zero) {
  auto const when = zero.midway ? fmt::format("from {:.2f} h of {} on than before", zero.from / 3600.0, zero.run)
                                : fmt::format("in {} than in the other runs", zero.run);
  return fmt::format(
      "{} stands {:+.2f} ± {:.2f} {} otherwise {}, which was taken for the instrument's doing: was {}?\n\n",
      zero.channel, in_unit(zero.unit, zero.change), in_unit(zero.unit, two_sided_95 * zero.standard_error), zero.unit,
      when,
      zero.unit == "K" ? "the sensor exchanged, moved or calibrated anew" : "the probe knocked, or set to zero anew");
}

/// "E_Y by bed (+45 %)": shares of free growth that a displacement follows beyond its loop, evident and large.
std::string words_of_loop(Diagnosis const& diagnosis) {
  std::vector<std::string> steps;
  for (std::size_t u = 0; u < diagnosis.unknowns.size(); ++u) {
    auto const& unknown = diagnosis.unknowns[u];
    auto const i = Eigen::Index(u);
    double const share = diagnosis.amended.x[i], error = std::sqrt(diagnosis.amended.covariance(i, i));
    if (unknown.kind == Unknown::Kind::loop && std::abs(share) > std::max(large_share_of_growth, 3.0 * error))
      steps.push_back(fmt::format("{} ({:+.0f} %)", unknown.name, 100.0 * share));
  }
  if (steps.empty()) return "";
  return fmt::format(
      "The file's structural loop leaves out, in shares of a solid's free growth: {}. The file that is written has it "
      "as 'beyond'.\n\n",
      fmt::join(steps, ", "));
}

/// Channels that err by much more than was expected of them: "T3 (4 times)".
std::string loud_channels(Diagnosis const& diagnosis) {
  std::vector<std::string> names;
  for (auto const& [channel, times] : diagnosis.noise_heard)
    if (times >= loud) names.push_back(fmt::format("{} ({:g} times)", channel, times));
  return fmt::format("{}", fmt::join(names, ", "));
}

bool disagrees(Diagnosis const& diagnosis) {
  return std::any_of(diagnosis.disagreement.begin(), diagnosis.disagreement.end(),
                     [](Disagreement const& cell) { return cell.significant; });
}

/// That are missing, or suspected. A daily cycle is one, whether cosine, sine or both were found.
std::size_t things_of(Diagnosis const& diagnosis) {
  std::set<std::string> labels;
  for (auto const& explanation : diagnosis.explanations) labels.insert(explanation.alternatives[0].hypothesis.label());
  return diagnosis.suspicion ? 1 : labels.size();
}

}  // namespace

Remedy const* proposal_of(Diagnosis const& diagnosis) {
  auto const it = std::find_if(diagnosis.proposals.begin(), diagnosis.proposals.end(),
                               [](Remedy const& remedy) { return remedy.sensor.empty(); });
  return it == diagnosis.proposals.end() ? nullptr : &*it;
}

std::vector<std::string> cautions(Diagnosis const& diagnosis) {
  std::vector<std::string> texts, result;
  for (auto const& zero : diagnosis.zeros) texts.push_back(words_of(zero));
  for (auto const& words : {words_of_numbers(diagnosis), words_of_offsets(diagnosis), words_of_loop(diagnosis),
                            words_of_heat_beside(diagnosis), words_of_vote(diagnosis), words_of_held_out(diagnosis)})
    texts.push_back(words);
  for (auto const& words : texts)
    if (!words.empty()) result.push_back(words.substr(0, words.find_last_not_of('\n') + 1));
  return result;
}

std::string headline(Diagnosis const& diagnosis) {
  auto const things = things_of(diagnosis);
  switch (diagnosis.verdict) {
    case Diagnosis::Verdict::nothing:
      if (things > 0) return "No effect is evident, but one is suspected.";
      if (!far_numbers(diagnosis).empty())
        return "No effect is evident, but numbers had to go far from what the file says.";
      return disagrees(diagnosis)
                 ? "No effect is evident, though the machine leaves more than noise in parts of the data."
                 : "Nothing is missing: the machine explains these data to within their noise.";
    case Diagnosis::Verdict::none_known:
      return std::string(no_name) + (things == 0 ? "" : " What stands in for it is named below.");
    case Diagnosis::Verdict::sensor:
      return "An instrument is at fault, not the machine.";
    case Diagnosis::Verdict::effect:
    case Diagnosis::Verdict::either:
      break;
  }
  return fmt::format("Missing: {} effect{}.", things, things == 1 ? "" : "s");
}

std::string report_text(DiagnosisReport const& report) {
  auto const& diagnosis = report.diagnosis;
  std::string text = doubt_lines(report.doubts) + "\n" + headline(diagnosis) + "\n\n";
  for (auto const& explanation : diagnosis.explanations) text += words_of(explanation) + "\n";
  text += words_of_silence(diagnosis);
  if (auto const loudest = loud_channels(diagnosis); !loudest.empty())
    text += fmt::format("More error than expected was taken for noise at {}.\n\n", loudest);
  for (auto const& zero : diagnosis.zeros) text += words_of(zero);
  text += words_of_numbers(diagnosis) + words_of_offsets(diagnosis) + words_of_loop(diagnosis);
  text += words_of_proposal(diagnosis);
  if (auto const& sensor = diagnosis.faulty_sensor) text += fmt::format("{} {}.\n\n", sensor->name, sensor->what);
  text += words_of_heat_beside(diagnosis) + words_of_vote(diagnosis) + words_of_held_out(diagnosis);
  text += words_of_heat(diagnosis);
  auto const& shown = report.held_out.empty() ? report.fitted : report.held_out;
  std::string const data = report.held_out.empty() ? "the fitted" : "unseen";
  text += words_of_gain(diagnosis, shown, data);
  text += words_of(diagnosis.disagreement, diagnosis.verdict != Diagnosis::Verdict::nothing);
  text += fmt::format("Error of the twin on {} data, RMS:\n{}", data, table_of(shown));
  for (auto const& remark : report.remarks) text += "note: " + remark + "\n";
  return text;
}

}  // namespace thermotwin::twin
