#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "thermal/error.h"
#include "twin/diagnosis/binned_run.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// Something in the data that a mistake in them explains better than a machine would: a wrong unit, sign or clock. What
/// was seen, in numbers, and what to look at. It changes no verdict.
struct Doubt {
  std::string run;
  std::string channel;  ///< of the machine, or of the inputs; empty: the whole run
  std::string text;     ///< one sentence
};

/// What speaks against the data, run by run, beside the machine as its file says. The file's numbers may be wrong by
/// half and a large effect may be missing: thresholds lie far beyond what either does.
///
///   time unit   a run of minutes or months, samples that lie hours apart
///   start       three sensors or more are 3 K from where the machine begins; one alone reads 1.8 T + 32: Fahrenheit
///   clock       one shift in time brings the changes of most channels onto the predicted ones (lateness.h)
///   motion      the sensors go through three times of what they should, in a run that is short or in which the spindle
///               crawls: the unit of time, or of speed
///   room        hotter than any, or up and down with the spindle, as a sensor on the machine is; or steady, where a
///               sensor in the air is not
///   sign, unit  a displacement follows the mirror image of its prediction, or a thousand times or a thousandth of it
///   swap        of two sensors on bodies, each follows the other's prediction four times as well as its own
///   offset      a sensor on a body stands 0.5 K otherwise against the others at the start of a run than of the first
///   twice       two of the runs hold the same readings
///
/// What stays hidden: two neighbours swapped that are equally warm, and a run that is cut off where nothing moves.
[[nodiscard]] std::vector<Doubt> doubts(Machine const& machine, std::vector<BinnedRun> const& runs);

/// List of {run, channel, text}, for programs.
[[nodiscard]] nlohmann::ordered_json doubts_json(std::vector<Doubt> const& doubts);

/// One line each, for people; empty if there are none.
[[nodiscard]] std::string doubt_lines(std::vector<Doubt> const& doubts);

/// Runs a fit; where it cannot be had, what speaks against the data may be why, and follows the complaint.
template <class Action>
auto with_doubts(std::vector<Doubt> const& doubts, Action action) {
  try {
    return action();
  } catch (thermal::InputError const& error) {
    if (doubts.empty()) throw;
    throw thermal::InputError(error.what() + ("\n" + doubt_lines(doubts)));
  }
}

}  // namespace thermotwin::twin
