#pragma once

#include <optional>
#include <string>
#include <vector>

#include "twin/diagnosis/amended_file.h"
#include "twin/diagnosis/axis_friction.h"
#include "twin/diagnosis/disagreement.h"
#include "twin/diagnosis/effect_search.h"
#include "twin/diagnosis/faulty_sensor.h"
#include "twin/diagnosis/free_heat.h"
#include "twin/diagnosis/remedy.h"

namespace thermotwin::twin {

/// A zero that changed (changed_zero.h), for people.
struct FoundZero {
  std::string run, channel, unit;
  double from = 0.0;  ///< [s]
  bool midway = false;
  double change = 0.0, standard_error = 0.0;  ///< [SI]
};

/// What measured runs say about a machine file (physics.md 8).
struct Diagnosis {
  enum class Verdict {
    nothing,     ///< the machine explains the data
    effect,      ///< each missing thing has one name
    either,      ///< at least one has two or three
    sensor,      ///< an instrument is at fault, not the machine
    none_known,  ///< heat, or a displacement, that none of the effects tried explains, or not in runs held out
  };
  Verdict verdict = Verdict::nothing;
  /// Of the calibrated machine, before any effect was added, beside the noise that the amended one leaves.
  std::vector<Disagreement> disagreement;
  std::vector<Disagreement> disagreement_left;      ///< of the amended one; empty where nothing was added
  std::vector<Disagreement> disagreement_held_out;  ///< of the machine that is written, with the runs held out
  std::vector<Explanation> explanations;            ///< of `none_known`: what stands in for it, and does not suffice
  /// Bodies that the missing heat enters, and whether it does so while the machine moves or while it stands.
  std::vector<std::pair<std::string, std::string>> where;
  std::optional<FreeHeat> unknown_heat;  ///< of `none_known`, where it is heat
  HeatBySpeed unknown_heat_by_speed;
  std::optional<Suspicion> suspicion;  ///< of `nothing`
  /// Experiments that would tell the first either/or apart, or what is suspected; best first.
  std::vector<Remedy> proposals;
  std::optional<FaultySensor> faulty_sensor;
  std::vector<FoundZero> zeros;        ///< of instruments, that changed between runs or in one
  std::vector<FreeHeat> scan;          ///< before any effect was added, best first
  std::vector<FreeHeat> left;          ///< with the effects, best first
  bool heat_beside = false;            ///< the best of them is evident, and yet too little to contradict the effects
  std::vector<Hypothesis> hypotheses;  ///< those that were tried, once for each amplitude about which they were
  Fit calibrated;                      ///< without any effect
  Fit amended;                         ///< with those found, the best alternative of each
  Fit written;  ///< the same where lumps are lumps, as they are in a file: what the amended file gets
  std::vector<Hypothesis> effects;    ///< of `amended`
  std::vector<Unknown> unknowns;      ///< of `amended`
  Value document;                     ///< the machine as amended: calibrated values and the effects
  std::vector<ChangedValue> changes;  ///< of the user's numbers, of sensors and loops, to what that has
  Value calibrated_document;          ///< with calibrated values alone
  /// 2 ln of how much likelier the runs held out are by the amended machine than by the calibrated one.
  std::optional<double> vote;
  std::optional<FrictionWhileMoving> friction;              ///< where the machine has it so, and its file does not
  std::vector<std::pair<std::string, double>> noise_heard;  ///< of every channel, over what was expected
  /// Runs held out speak against the effects by more than the fitted ones speak for them.
  [[nodiscard]] bool is_refuted() const;
  std::size_t visible = 0;                 ///< hypotheses that would have been seen at half of their largest amplitude
  std::vector<DetectionLimit> could_hide;  ///< what these data could not have shown, beside what was found
};

[[nodiscard]] std::string name_of(Diagnosis::Verdict verdict);

/// Calibrates, scans, names. `machine`: its document. `held_out`: runs that take no part in any fit, and have a vote on
/// what was found.
[[nodiscard]] Diagnosis diagnose(Value const& machine, std::vector<BinnedRun> const& runs,
                                 DiagnosisOptions const& options, std::vector<BinnedRun> const& held_out = {});

}  // namespace thermotwin::twin
