#include "twin/diagnosis/run_files.h"

#include <fmt/format.h>
#include <fstream>
#include <sstream>

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

std::string text_of_file(fs::path const& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw thermal::InputError(fmt::format("'{}' cannot be read", path.string()));
  return text.str();
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

}  // namespace thermotwin::twin
