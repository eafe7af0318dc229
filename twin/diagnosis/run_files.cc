#include "twin/diagnosis/run_files.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "thermal/error.h"

namespace thermotwin::twin {

namespace fs = std::filesystem;

std::vector<MeasuredRun> read_runs(RunFiles const& files, Machine const& machine, std::vector<std::string>& remarks) {
  std::vector<MeasuredRun> runs;
  for (auto const& file : files) {
    runs.push_back(read_measured_run(file, machine));
    for (auto const& remark : runs.back().remarks) remarks.push_back(file.filename().string() + ": " + remark);
  }
  return runs;
}

std::vector<BinnedRun> binned(std::vector<MeasuredRun> const& runs) {
  std::vector<BinnedRun> result;
  for (auto const& run : runs) result.push_back(bin(run, fitting_interval(run)));
  return result;
}

std::string names_of(RunFiles const& files) {
  std::vector<std::string> names;
  for (auto const& file : files) names.push_back(file.filename().string());
  return fmt::format("{}", fmt::join(names, ", "));
}

void refuse_to_overwrite(fs::path const& output, fs::path const& machine, RunFiles const& data) {
  if (output.empty() || !fs::exists(output)) return;
  RunFiles inputs = data;
  inputs.push_back(machine);
  for (auto const& input : inputs)
    if (fs::exists(input) && fs::equivalent(input, output))
      throw thermal::InputError(
          fmt::format("{}: that is one of the files to be read, which are never overwritten; "
                      "name another one",
                      output.string()));
}

void check_suffix(fs::path const& output, std::string_view what, std::vector<std::string> const& suffixes) {
  auto const suffix = output.extension().string();
  if (suffix.empty() || std::find(suffixes.begin(), suffixes.end(), suffix) != suffixes.end()) return;
  throw thermal::InputError(fmt::format("{}: {} is written as {}", output.string(), what, fmt::join(suffixes, " or ")));
}

}  // namespace thermotwin::twin
