#include "twin/diagnosis/run_files.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace thermotwin::twin {

namespace fs = std::filesystem;

std::vector<MeasuredRun> read_runs(RunFiles const& files, Machine const& machine, std::vector<std::string>& remarks) {
  std::vector<MeasuredRun> runs;
  for (auto const& file : files) runs.push_back(read_measured_run(file, machine));
  let_begin_alike(runs, machine);
  std::vector<std::pair<std::string, RunFiles>> said;  // once, of whatever files
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (auto const& remark : runs[r].remarks) {
      auto const same =
          std::find_if(said.begin(), said.end(), [&](auto const& known) { return known.first == remark; });
      (same == said.end() ? said.emplace_back(remark, RunFiles{}) : *same).second.push_back(files[r]);
    }
  for (auto const& [remark, of] : said) remarks.push_back(names_of(of) + ": " + remark);
  return runs;
}

void let_begin_alike(std::vector<MeasuredRun>& runs, Machine const& machine) {
  if (std::none_of(runs.begin(), runs.end(), [](auto const& run) { return run.warm_start.has_value(); })) return;
  for (auto& run : runs)
    if (!run.warm_start) run.begin_with(warm_start(machine, run, true));
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

}  // namespace thermotwin::twin
