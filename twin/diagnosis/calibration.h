#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "twin/diagnosis/amended_file.h"
#include "twin/diagnosis/axis_friction.h"
#include "twin/diagnosis/estimation.h"
#include "twin/diagnosis/gap.h"
#include "twin/diagnosis/plausibility.h"

namespace thermotwin::twin {

/// Posterior over prior deviation above which a number is not identified.
inline constexpr double still_uncertain = 0.5;
/// Correlation above which numbers are inseparable.
inline constexpr double tied = 0.95;

/// A number of the machine file after calibration. A priori ln(value/nominal) ~ N(0, number.deviation²).
struct CalibratedNumber {
  UncertainNumber number;
  double logarithm = 0.0;  ///< ln(estimate/nominal); of either sign: estimate − nominal
  double deviation = 0.0;  ///< its posterior standard deviation
  /// The data have at least halved what was uncertain: deviation ≤ still_uncertain · number.deviation (physics.md 8.9).
  /// If not, the estimate is mostly the prior's and the number keeps its nominal value.
  bool identified = false;
  /// ln(value/nominal) in the calibrated file: 0 if not identified; if so, the most probable value given that those are
  /// at 0, found by a fit of its own: a smaller gap than `logarithm` leaves beside numbers that did not move with it.
  double written = 0.0;

  [[nodiscard]] double estimate() const;
  [[nodiscard]] double standard_error() const;  ///< in the number's unit [SI]
  [[nodiscard]] double departure() const;       ///< of the estimate from the file, in prior standard deviations
  /// Identified, and yet what is written is not the number that its name says: further than `far_from_file` prior
  /// deviations from the file, or of the other sign than an estimate that is as many standard errors from 0. The number
  /// stands in for others, which are at nominal there, or for what is missing.
  [[nodiscard]] bool implausible() const;
};

/// What belongs to the instruments and the runs, not to the machine: an offset, a lag, a warm start.
struct CalibratedInstrument {
  Unknown unknown;
  double estimate = 0.0, standard_error = 0.0;  ///< in the unit of the unknown
  std::string unit;                             ///< in which people read it: K, s, um, urad, 1
};

/// What measured runs say about the uncertain numbers of a machine that is supposed to lack nothing (physics.md 8.1,
/// 8.9). The noise is the expected one.
struct Calibration {
  std::string machine;
  std::vector<CalibratedNumber> numbers;
  std::vector<CalibratedInstrument> instruments;
  /// Unknowns that are tied to each other by a correlation above 0.95 in size: the data know a combination only.
  std::vector<std::vector<std::string>> inseparable;
  /// γ = 1/√λ_min(S̃ᵀS̃), S̃: whitened sensitivities to the identified numbers, scaled to unit norm. 1: independent;
  /// above 10 to 15 they are not identified together (Brun, Reichert & Künsch 2001). 0 if none is identified.
  double collinearity = 0.0;
  std::vector<std::string> weakest;  ///< numbers that make up most of that λ_min's direction
  double misfit = 0.0;  ///< mean square of the whitened residuals; 1: as expected, though an effect may be missing
  bool converged = false;
  double expected_gap = 0.0;       ///< of a machine that is right: what `whole` makes of its expected noise
  std::vector<ChannelGap> gaps;    ///< of the nominal machine and of `document`
  Value document;                  ///< the machine with the numbers as written
  std::vector<ChangedValue> lags;  ///< of the sensors, in that
  std::optional<FrictionWhileMoving> friction;  ///< where that has it so, and the file does not
  std::vector<Doubt> doubts;                    ///< of calibrate_files
  std::vector<std::string> remarks;

  /// Why something is missing, for people: residuals are larger than noise, numbers had to leave the file by more than
  /// three prior standard deviations, or what would be written leaves more than the machine did, and than noise would.
  /// Empty: numbers alone may explain the data.
  [[nodiscard]] std::vector<std::string> shortcomings() const;
  [[nodiscard]] bool falls_short() const { return !shortcomings().empty(); }
};

/// `machine`: its document. InputError when it has no uncertain number, or cannot be run on the data.
[[nodiscard]] Calibration calibrate(Value const& machine, std::vector<BinnedRun> const& runs, FitWatch watch = {});

/// `thermotwin calibrate`.
struct CalibrateFiles {
  std::filesystem::path machine;
  std::vector<std::filesystem::path> data;
  std::filesystem::path output;  ///< of the calibrated machine; empty: none
  FitWatch watch{};
  std::function<void(Calibration const&)> show{};  ///< before the machine is written: no lack of room takes it away
};

/// Reads machine and data, calibrates, and writes the user's file with the identified numbers in place. InputError for
/// files that cannot serve, and for an output that is one of them.
[[nodiscard]] Calibration calibrate_files(CalibrateFiles const& files);

[[nodiscard]] std::string calibration_table(Calibration const& calibration);
[[nodiscard]] std::string calibration_json(Calibration const& calibration);

}  // namespace thermotwin::twin
