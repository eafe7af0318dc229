#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "twin/diagnosis/measured_run.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// Root mean square of measured minus predicted for two machines; NaN where there is no sample.
struct GapPair {
  double before = 0.0, after = 0.0;
  Eigen::Index samples = 0;
};

/// One channel of one run.
struct ComparedChannel {
  std::string name, unit;      ///< "K", "um", "urad"
  GapPair whole;               ///< [unit]
  std::vector<GapPair> parts;  ///< one per regime of the run [unit]
  double offset_before = 0.0;  ///< constant that was taken off [unit]
  double offset_after = 0.0;
};

/// One run: gaps per channel, whole and per regime. A regime is a speed of the spindle: idle, 2500 rpm; where there are
/// more than eight, idle and quarters of the fastest; none, where all of the run is one.
struct ComparedRun {
  std::string name;
  std::vector<std::string> regimes;
  std::vector<ComparedChannel> channels;
  std::vector<std::string> remarks;
};

/// Two machines along the same measured runs. Of each channel and run the mean of measured minus predicted is taken
/// off, for each machine its own: an instrument's offset and a displacement's zero belong to no machine.
struct Comparison {
  std::string before, after;  ///< names of the machines
  std::vector<ComparedRun> runs;
};

[[nodiscard]] Comparison compare(Machine const& before, Machine const& after, std::vector<MeasuredRun> const& runs);
/// The same from files, for the channels that both machines have; a remark of the run names those of the first only.
[[nodiscard]] Comparison compare_files(std::filesystem::path const& before, std::filesystem::path const& after,
                                       std::vector<std::filesystem::path> const& data);

/// Over all channels of a unit, and all runs: √(mean of the channels' squares).
[[nodiscard]] GapPair total(Comparison const& comparison, std::string const& unit);

[[nodiscard]] std::string comparison_table(Comparison const& comparison);
[[nodiscard]] std::string comparison_json(Comparison const& comparison);

}  // namespace thermotwin::twin
