#include "twin/diagnosis/verdict.h"

#include <algorithm>
#include <utility>

#include "models/quantile.h"

namespace thermotwin::twin {
namespace {

constexpr double most_of_a_fault = 2.0;  // noise that a sensor may leave whose fault is known, over that of the others

/// More noise, over what was expected, than the median of the other channels: where all err, the machine is rough.
bool errs(Diagnosis const& diagnosis, std::string const& channel) {
  double own = 0.0;
  std::vector<double> others;
  for (auto const& [name, times] : diagnosis.noise_heard)
    if (name == channel)
      own = times;
    else
      others.push_back(times);
  if (others.empty()) return false;
  return own >= most_of_a_fault * models::upper_median(std::move(others));
}

/// A film on a lump may be anything above what is plausible, and a broken sensor do anything.
bool stands_in(Diagnosis const& diagnosis, Finding const& finding) {
  if (finding.hypothesis.is_about("sensor")) return errs(diagnosis, finding.hypothesis.body);
  return finding.is_at_end() && !finding.at_least;
}

/// Whether all that may be one of the things does.
bool stands_in(Diagnosis const& diagnosis) {
  return std::any_of(diagnosis.explanations.begin(), diagnosis.explanations.end(), [&](auto const& explanation) {
    auto const& all = explanation.alternatives;
    return std::all_of(all.begin(), all.end(), [&](auto const& finding) { return stands_in(diagnosis, finding); });
  });
}

}  // namespace

bool only_sensors(Diagnosis const& diagnosis) {
  return std::all_of(diagnosis.explanations.begin(), diagnosis.explanations.end(),
                     [](auto const& explanation) { return explanation.alternatives[0].hypothesis.is_about("sensor"); });
}

Diagnosis::Verdict verdict_on(Diagnosis const& diagnosis, bool heat_left) {
  using Verdict = Diagnosis::Verdict;
  auto const& found = diagnosis.explanations;
  if (diagnosis.faulty_sensor && found.empty()) return Verdict::sensor;
  if (heat_left || stands_in(diagnosis)) return Verdict::none_known;
  if (found.empty()) return Verdict::nothing;
  bool const sensors = only_sensors(diagnosis);
  if (diagnosis.is_refuted() && !(sensors && diagnosis.faulty_sensor)) return Verdict::none_known;
  if (sensors) return Verdict::sensor;
  bool const single =
      std::all_of(found.begin(), found.end(), [](auto const& one) { return one.alternatives.size() == 1; });
  return single ? Verdict::effect : Verdict::either;
}

bool Diagnosis::is_refuted() const {
  double evidence = vote.value_or(0.0);
  for (auto const& explanation : explanations) evidence += explanation.alternatives[0].strength;
  return evidence < 0.0;
}

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

}  // namespace thermotwin::twin
