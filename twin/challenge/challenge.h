#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "twin/challenge/hidden_world.h"

namespace thermotwin::twin {

/// `thermotwin challenge`: a machine, measurements of it that it does not explain, and the truth.
struct ChallengeOptions {
  std::optional<std::string> machine;  ///< name or file of the nominal machine; default: v450
  std::optional<std::uint64_t> seed;   ///< default: 1
  std::optional<CaseKind> kind;        ///< default: what the seed stands for
  std::filesystem::path folder;
  /// Instead of a new challenge: one more run of the one in the folder, through this experiment. Machine, seed and kind
  /// are the folder's; given ones must agree with them.
  std::optional<std::filesystem::path> further_run;
};

/// Writes into the folder:
///
/// | file | holds |
/// |---|---|
/// | machine.toml | the nominal machine, as its file stands |
/// | run1.h5, run2.h5 | inputs, readings and displacements of the two runs to diagnose with; nothing else |
/// | unseen.h5 | those of the run that is held out |
/// | sealed_unseen.h5 | the same run before noise: what the hidden machine did, as its sensors would show it without |
/// | sealed.json | kind, effects, sites, amplitudes, heat per body and run, displacement moved, parameters drawn |
///
/// The same options write the same bytes. OutputError if the folder is there and not empty; InputError, before anything
/// is written, for a machine that needs other inputs than those of challenge_runs.h, or whose finer form
/// (refined_form.h) has blocks without elastic solutions: it names the shipped machine that is meant, or those there
/// are. A further run is written beside the others as <name of the experiment's file>.h5; InputError if that is there,
/// and for options that are not the folder's. Returns one line for people, which does not tell what is hidden.
std::string write_challenge(ChallengeOptions const& options);

/// What the options' challenge would hide: the first keys of sealed.json, one line of JSON, without the runs. The same
/// InputError.
[[nodiscard]] std::string challenge_key(ChallengeOptions const& options);

}  // namespace thermotwin::twin
