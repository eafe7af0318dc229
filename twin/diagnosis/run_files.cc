#include "twin/diagnosis/run_files.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "twin/file/distinct_names.h"

namespace thermotwin::twin {

std::vector<MeasuredRun> read_runs(RunFiles const& files, Machine const& machine, std::vector<std::string>& remarks,
                                   RunFiles const& beside) {
  RunFiles every = files;
  every.insert(every.end(), beside.begin(), beside.end());
  auto const names = distinct_names(every);
  std::vector<MeasuredRun> runs;
  for (auto const& file : files) {
    runs.push_back(read_measured_run(file, machine));
    runs.back().name = name_of_run(names[runs.size() - 1]);
  }
  let_begin_alike(runs, machine);
  std::vector<std::pair<std::string, std::vector<std::string>>> said;  // once, of whatever files
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (auto const& remark : runs[r].remarks) {
      auto const same =
          std::find_if(said.begin(), said.end(), [&](auto const& known) { return known.first == remark; });
      (same == said.end() ? said.emplace_back(remark, std::vector<std::string>()) : *same)
          .second.push_back(names[r].string());
    }
  for (auto const& [remark, of] : said) remarks.push_back(fmt::format("{}: {}", fmt::join(of, ", "), remark));
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
  for (auto const& name : distinct_names(files)) names.push_back(name.string());
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace thermotwin::twin
